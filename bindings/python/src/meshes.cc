#include <filesystem>
#include <optional>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "arrays.h"
#include "asperity/geometry/mesh_file.h"
#include "asperity/geometry/mesh_unit.h"
#include "asperity/geometry/read_mesh.h"
#include "inputs.h"
#include "interruptible.h"
#include "mesh.h"
#include "parts.h"
#include "unmade.h"

namespace asperity::python {

namespace {

Mesh make_mesh(py::handle vertices_m, py::handle triangles) {
  TriangleMesh out;
  const Rows vertices = place_rows(vertices_m, "vertices_m");
  out.vertices_m.assign(vertices.all().begin(), vertices.all().end());
  out.triangles = triangles_of(triangles, vertices.size());
  require_mesh_size(vertices);
  return interruptible([&](const Observer& observer) { return Mesh(std::move(out), observer); });
}

Mesh read(const std::filesystem::path& file, std::optional<double> unit_m) {
  if (unit_m) unit_of(*unit_m, "unit_m");
  return interruptible([&](const Observer& observer) {
    const MeshFile read = read_mesh(file, {}, observer);
    if (!unit_m) refuse_unlikely_metres(read, file);
    return Mesh(to_metres(read, unit_m.value_or(1.0)), observer);
  });
}

// Of each point the nearest of the mesh: points (n, 3), distances (n,), triangles (n,).
py::tuple closest_points(const Mesh& mesh, py::handle points_m) {
  const Rows points = place_rows(points_m, "points_m");
  py::array_t<double> nearest = rows_of_three(points.size()), distance = column_of(points.size());
  py::array_t<std::uint32_t> triangle = column_of<std::uint32_t>(points.size());
  auto* const nearest_m = reinterpret_cast<Eigen::Vector3d*>(nearest.mutable_data());
  double* const distance_m = distance.mutable_data();
  std::uint32_t* const index = triangle.mutable_data();
  interruptible([&](const Observer& observer) {
    in_blocks(observer, points.size(), [&, at = points.all()](std::size_t i) {
      const ClosestPoint found = mesh.bvh.closest_point(at[i]);
      nearest_m[i] = found.p_m;
      distance_m[i] = found.distance_m;
      index[i] = found.triangle;
    });
  });
  return py::make_tuple(nearest, distance, triangle);
}

// Of each ray the first hit: t (n,), inf without one, and triangles (n,).
py::tuple cast_rays(const Mesh& mesh, py::handle origins_m, py::handle directions) {
  const Rows origin = place_rows(origins_m, "origins_m"), direction = finite_rows(directions, "directions");
  if (origin.size() != direction.size()) throw py::value_error("directions: as many as origins_m are wanted");
  py::array_t<double> along = column_of(origin.size());
  py::array_t<std::uint32_t> triangle = column_of<std::uint32_t>(origin.size());
  double* const t = along.mutable_data();
  std::uint32_t* const index = triangle.mutable_data();
  interruptible([&](const Observer& observer) {
    in_blocks(observer, origin.size(), [&, from = origin.all(), to = direction.all()](std::size_t i) {
      const RayHit hit = mesh.bvh.cast_ray(from[i], to[i]);
      t[i] = hit.t;
      index[i] = hit.triangle;
    });
  });
  return py::make_tuple(along, triangle);
}

}  // namespace

void add_meshes(py::module_& module) {
  py::class_<Mesh>(module, "Mesh", "Triangles, with a tree for queries. Raises Error for what is no mesh.")
      .def(py::init(&make_mesh), py::arg("vertices_m"), py::arg("triangles"),
           "vertices_m: (n, 3), m; triangles: (m, 3) indices from 0. Copied.")
      .def_property_readonly(
          "vertices_m", [](py::object self) { return view(self.cast<const Mesh&>().mesh.vertices_m, self); },
          "(n, 3) float64, m")
      .def_property_readonly(
          "triangles", [](py::object self) { return view(self.cast<const Mesh&>().mesh.triangles, self); },
          "(m, 3) uint32, indices of vertices_m")
      .def(
          "__len__", [](const Mesh& mesh) { return mesh.mesh.triangles.size(); }, "The number of triangles.")
      .def("closest_points", &closest_points, py::arg("points_m"),
           "points_m: (n, 3), m. Gives the nearest points of the surface (n, 3), m, their distances (n,), m, and "
           "triangles (n,).")
      .def("cast_rays", &cast_rays, py::arg("origins_m"), py::arg("directions"),
           "Both (n, 3); origins in m, directions of any length. Gives t (n,), with the hit at origin + t direction, "
           "inf without one, and triangles (n,), 4294967295 without one.")
      .def("__repr__", [](const Mesh& mesh) {
        return "<asperity.Mesh: " + std::to_string(mesh.mesh.vertices_m.size()) + " vertices, " +
               std::to_string(mesh.mesh.triangles.size()) + " triangles>";
      });
  refuse_unmade<Mesh>();
  module.def("read_mesh", &read, py::arg("file"), py::arg("unit_m") = py::none(),
             "Read an OBJ, PLY, STL, OFF or glTF file. unit_m: length of its unit, m, from 1e-9 to 1000; without it "
             "the unit is a metre, and a mesh that is then smaller than 1 mm or larger than 5 m raises Error.");
}

}  // namespace asperity::python
