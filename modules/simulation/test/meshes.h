#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>

#include <Eigen/Core>

#include "asperity/geometry/triangle_mesh.h"

namespace asperity {

// A closed surface r(direction) around the origin, from a cube's faces of n × n squares; outward.
inline TriangleMesh blown_up_cube(std::uint32_t n, const std::function<double(const Eigen::Vector3d&)>& radius_m) {
  TriangleMesh mesh;
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    const double side = face % 2 == 0 ? 1.0 : -1.0;
    const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
    for (std::uint32_t i = 0; i <= n; ++i) {
      for (std::uint32_t j = 0; j <= n; ++j) {
        // Equal angles: squares of nearly equal size.
        const double u = std::tan(std::numbers::pi / 4.0 * (2.0 * i / n - 1.0));
        const double v = std::tan(std::numbers::pi / 4.0 * (2.0 * j / n - 1.0));
        Eigen::Vector3d p;
        p[axis] = side;
        p[(axis + 1) % 3] = side * u;
        p[(axis + 2) % 3] = v;
        const Eigen::Vector3d direction = p.normalized();
        mesh.vertices_m.push_back(radius_m(direction) * direction);
      }
    }
    for (std::uint32_t i = 0; i < n; ++i) {
      for (std::uint32_t j = 0; j < n; ++j) {
        const std::uint32_t a = first + i * (n + 1) + j, b = a + n + 1;
        mesh.triangles.push_back({a, b, b + 1});
        mesh.triangles.push_back({a, b + 1, a + 1});
      }
    }
  }
  return mesh;
}

inline TriangleMesh sphere_mesh(double radius_m, std::uint32_t n) {
  return blown_up_cube(n, [&](const Eigen::Vector3d&) { return radius_m; });
}

// A potato with hills and hollows 15 to 40 mm across.
inline TriangleMesh bumpy_mesh(std::uint32_t n) {
  return blown_up_cube(n, [](const Eigen::Vector3d& d) {
    return 0.045 + 0.004 * std::sin(5.0 * d.x() + 1.0) * std::cos(4.0 * d.y()) + 0.003 * std::sin(6.0 * d.z() + d.x());
  });
}

// A rectangle in z = 0, outward +z, n × n squares.
inline TriangleMesh plate_mesh(double length_m, double width_m, std::uint32_t n) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i <= n; ++i) {
    for (std::uint32_t j = 0; j <= n; ++j)
      mesh.vertices_m.emplace_back(length_m * (1.0 * i / n - 0.5), width_m * (1.0 * j / n - 0.5), 0.0);
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t a = i * (n + 1) + j, b = a + n + 1;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  }
  return mesh;
}

// A box whose edges are rounded with `radius_m`; half_m are its half sizes, the rounding included.
inline TriangleMesh rounded_box_mesh(const Eigen::Vector3d& half_m, double radius_m, std::uint32_t n) {
  TriangleMesh mesh = blown_up_cube(n, [](const Eigen::Vector3d& d) { return 1.0 / d.cwiseAbs().maxCoeff(); });
  const Eigen::Vector3d inner_m = half_m - Eigen::Vector3d::Constant(radius_m);
  for (Eigen::Vector3d& p : mesh.vertices_m) {
    const Eigen::Vector3d on_box = p.cwiseProduct(half_m);
    const Eigen::Vector3d core = on_box.cwiseMax(-inner_m).cwiseMin(inner_m);
    const Eigen::Vector3d out = on_box - core;
    p = core + radius_m * out.normalized();
  }
  return mesh;
}

}  // namespace asperity
