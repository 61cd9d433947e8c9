#include <filesystem>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "arrays.h"
#include "asperity/geometry/mesh_bvh.h"
#include "asperity/geometry/mesh_file.h"
#include "asperity/geometry/read_mesh.h"
#include "parts.h"

namespace asperity::python {

namespace {

struct Mesh {
  TriangleMesh mesh;
  MeshBvh bvh;
  explicit Mesh(TriangleMesh of) : mesh(std::move(of)), bvh(mesh) {}
};

Mesh mesh_of(const Doubles& vertices_m, const py::object& triangles) {
  TriangleMesh out;
  const std::span<const Eigen::Vector3d> vertices = points_of(vertices_m, "vertices_m");
  out.vertices_m.assign(vertices.begin(), vertices.end());
  out.triangles = triangles_of(triangles, vertices.size());
  return Mesh(std::move(out));
}

// Of each point the nearest of the mesh: points (n, 3), distances (n,), triangles (n,).
py::tuple closest_points(const Mesh& mesh, const Doubles& points_m) {
  const std::span<const Eigen::Vector3d> points = finite_points_of(points_m, "points_m");
  py::array_t<double> nearest = rows_of_three(points.size());
  py::array_t<double> distance(static_cast<py::ssize_t>(points.size()));
  py::array_t<std::uint32_t> triangle(static_cast<py::ssize_t>(points.size()));
  auto* const nearest_m = reinterpret_cast<Eigen::Vector3d*>(nearest.mutable_data());
  double* const distance_m = distance.mutable_data();
  std::uint32_t* const index = triangle.mutable_data();
  {
    const py::gil_scoped_release unlocked;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const ClosestPoint found = mesh.bvh.closest_point(points[i]);
      nearest_m[i] = found.p_m;
      distance_m[i] = found.distance_m;
      index[i] = found.triangle;
    }
  }
  return py::make_tuple(nearest, distance, triangle);
}

// Of each ray the first hit: t (n,), inf without one, and triangles (n,).
py::tuple cast_rays(const Mesh& mesh, const Doubles& origins_m, const Doubles& directions) {
  const std::span<const Eigen::Vector3d> origin = finite_points_of(origins_m, "origins_m"),
                                         direction = finite_points_of(directions, "directions");
  if (origin.size() != direction.size()) throw py::value_error("directions: as many as origins_m are wanted");
  py::array_t<double> along(static_cast<py::ssize_t>(origin.size()));
  py::array_t<std::uint32_t> triangle(static_cast<py::ssize_t>(origin.size()));
  double* const t = along.mutable_data();
  std::uint32_t* const index = triangle.mutable_data();
  {
    const py::gil_scoped_release unlocked;
    for (std::size_t i = 0; i < origin.size(); ++i) {
      const RayHit hit = mesh.bvh.cast_ray(origin[i], direction[i]);
      t[i] = hit.t;
      index[i] = hit.triangle;
    }
  }
  return py::make_tuple(along, triangle);
}

}  // namespace

void add_meshes(py::module_& module) {
  py::class_<Mesh>(module, "Mesh", "Triangles, with a tree for queries. Raises Error for what is no mesh.")
      .def(py::init(&mesh_of), py::arg("vertices_m"), py::arg("triangles"),
           "vertices_m: (n, 3), m; triangles: (m, 3) indices from 0. Copied.")
      .def_property_readonly("vertices_m",
                             [](py::object self) { return view(self.cast<const Mesh&>().mesh.vertices_m, self); })
      .def("__len__", [](const Mesh& mesh) { return mesh.mesh.triangles.size(); })
      .def("closest_points", &closest_points, py::arg("points_m"),
           "points_m: (n, 3). Gives the nearest points of the surface (n, 3), their distances (n,), m, and triangles "
           "(n,).")
      .def("cast_rays", &cast_rays, py::arg("origins_m"), py::arg("directions"),
           "Both (n, 3). Gives t (n,), with the hit at origin + t direction, inf without one, and triangles (n,), "
           "4294967295 without one.");
  module.def(
      "read_mesh",
      [](const std::filesystem::path& file, double unit_m) { return Mesh(to_metres(read_mesh(file), unit_m)); },
      py::arg("file"), py::arg("unit_m") = 1.0, "Read an OBJ, PLY, STL, OFF or glTF file whose unit is unit_m, m.");
}

}  // namespace asperity::python
