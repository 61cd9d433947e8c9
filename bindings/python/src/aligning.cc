#include <pybind11/stl.h>

#include "arrays.h"
#include "asperity/geometry/mesh_unit.h"
#include "asperity/registration/manual_alignment.h"
#include "inputs.h"
#include "parts.h"

namespace asperity::python {

namespace {

py::tuple align_points(py::handle p_world_m, py::handle p_mesh_m) {
  const Rows world = place_rows(p_world_m, "p_world_m"), mesh = place_rows(p_mesh_m, "p_mesh_m");
  const AbsoluteOrientation found = align_picked(world.all(), mesh.all());
  return py::make_tuple(matrix_of(found.T_b_a), found.rms_m);
}

py::array_t<double> align_by_hand(py::handle shift_m, py::handle rotation_deg) {
  const Eigen::Vector3d shift = vector_of(shift_m, "shift_m"), rotation = vector_of(rotation_deg, "rotation_deg");
  for (const double coordinate_m : shift) within(coordinate_m, {-kFurthestPlace_m, kFurthestPlace_m}, "shift_m");
  for (const double angle_deg : rotation) within(angle_deg, {-1e6, 1e6}, "rotation_deg");
  return matrix_of(align_manually({{shift.x(), shift.y(), shift.z()}, {rotation.x(), rotation.y(), rotation.z()}}));
}

}  // namespace

void add_aligning(py::module_& module) {
  module.def("align_points", &align_points, py::arg("p_world_m"), py::arg("p_mesh_m"),
             "T_mesh_world (4, 4) of three or more pairs of points (n, 3), m, picked on the path and on the mesh, and "
             "their root mean square distance after it, m: a guess for register_scans.");
  module.def("align_by_hand", &align_by_hand, py::arg("shift_m"), py::arg("rotation_deg"),
             "T_mesh_world (4, 4) of a shift (3,), m, of the world's origin in the mesh's frame and rotations (3,), "
             "degrees, about x, then the rotated y, then the twice rotated z.");
}

}  // namespace asperity::python
