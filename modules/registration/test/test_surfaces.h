#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "asperity/base/random.h"
#include "asperity/geometry/mesh_bvh.h"
#include "asperity/geometry/pose.h"
#include "asperity/geometry/triangle_mesh.h"
#include "asperity/registration/registration_result.h"
#include "asperity/registration/registration_surface.h"

namespace asperity::test {

// A grid of rows × columns cells under position(u, v), u and v from 0 to 1; outside where d/du × d/dv points.
inline TriangleMesh grid(std::uint32_t rows, std::uint32_t columns,
                         const std::function<Eigen::Vector3d(double, double)>& position) {
  TriangleMesh out;
  for (std::uint32_t i = 0; i <= rows; ++i) {
    for (std::uint32_t j = 0; j <= columns; ++j) {
      out.vertices_m.push_back(position(static_cast<double>(i) / rows, static_cast<double>(j) / columns));
    }
  }
  for (std::uint32_t i = 0; i < rows; ++i) {
    for (std::uint32_t j = 0; j < columns; ++j) {
      const std::uint32_t a = i * (columns + 1) + j;
      const std::uint32_t b = a + columns + 1;
      out.triangles.push_back({a, b, b + 1});
      out.triangles.push_back({a, b + 1, a + 1});
    }
  }
  return out;
}

inline Eigen::Vector3d spherical(double u, double v) {
  const double theta = std::numbers::pi * (0.02 + 0.96 * u);
  const double phi = 2.0 * std::numbers::pi * v;
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

// A body of about 40 mm radius with bumps of 10 to 40 mm.
inline Eigen::Vector3d bumpy(const Eigen::Vector3d& d) {
  const double r = 1.0 + 0.03 * std::sin(7.0 * d.x() + 1.0) * std::cos(6.0 * d.y()) +
                   0.02 * std::sin(11.0 * d.z() + 5.0 * d.x()) + 0.03 * std::sin(4.0 * d.y() - 9.0 * d.z());
  return 0.04 * r * Eigen::Vector3d(d.x(), 0.85 * d.y(), 0.7 * d.z());
}

// A mesh with what registration needs of it.
struct Body {
  TriangleMesh mesh;
  MeshBvh bvh;
  RegistrationSurface surface;

  explicit Body(TriangleMesh m) : mesh(std::move(m)), bvh(mesh), surface(prepare_surface(mesh, bvh)) {}
  Body(const Body&) = delete;
  Body& operator=(const Body&) = delete;
};

inline TriangleMesh bumpy_mesh() {
  return grid(120, 240, [](double u, double v) { return bumpy(spherical(u, v)); });
}

// Points of the facets below a path, mesh frame.
inline std::vector<Eigen::Vector3d> laid_on(const Body& body, const std::vector<Eigen::Vector3d>& path_m) {
  std::vector<Eigen::Vector3d> out;
  for (const Eigen::Vector3d& p_m : path_m) out.push_back(body.bvh.closest_point(p_m).p_m);
  return out;
}

// A zig-zag over half of the bumpy body.
inline std::vector<Eigen::Vector3d> bumpy_path(const Body& body, int count) {
  std::vector<Eigen::Vector3d> out;
  for (int i = 0; i < count; ++i) {
    const double t = (i + 0.5) / count;
    out.push_back(bumpy(spherical(0.25 + 0.5 * t, 0.1 + 0.15 * (1.0 + std::sin(31.0 * t)))));
  }
  return laid_on(body, out);
}

inline Eigen::Vector3d normal3(Random& random) { return {random.normal(), random.normal(), random.normal()}; }

// A path of points alone.
inline MeasuredPath path_of(std::vector<Eigen::Vector3d> p_world_m, double sigma_m) {
  MeasuredPath out;
  out.p_world_m = std::move(p_world_m);
  out.sigma_m = sigma_m;
  return out;
}

inline std::vector<Eigen::Vector3d> seen_from(const Pose& T_world_mesh, const std::vector<Eigen::Vector3d>& p_mesh_m,
                                              double sigma_m, Random& random) {
  std::vector<Eigen::Vector3d> out;
  for (const Eigen::Vector3d& p_m : p_mesh_m) out.push_back(T_world_mesh * (p_m + sigma_m * normal3(random)));
  return out;
}

// `pose` with the points' mean moved by shift_m and turned by turn_deg about it, in directions of chance.
inline Pose perturbed(const Pose& T_mesh_world, const std::vector<Eigen::Vector3d>& p_mesh_m, double shift_m,
                      double turn_deg, Random& random) {
  Eigen::Vector3d mean_m = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p_m : p_mesh_m) mean_m += p_m / static_cast<double>(p_mesh_m.size());
  const Eigen::Quaterniond turn = exp_rotation(turn_deg * std::numbers::pi / 180.0 * normal3(random).normalized());
  return Pose{turn, mean_m + shift_m * normal3(random).normalized() - turn * mean_m} * T_mesh_world;
}

// Root mean square of how far a pose puts the points from where they belong.
inline double pose_error_m(const Pose& T_mesh_world, const Pose& T_world_mesh,
                           const std::vector<Eigen::Vector3d>& p_mesh_m) {
  const Pose back = T_mesh_world * T_world_mesh;
  double square = 0.0;
  for (const Eigen::Vector3d& p_m : p_mesh_m) square += (back * p_m - p_m).squaredNorm();
  return std::sqrt(square / static_cast<double>(p_mesh_m.size()));
}

// Where the tests put the mesh in the tracker's world.
inline const Pose kWorldMesh{exp_rotation({0.3, -1.2, 0.8}), {0.2, -0.1, 0.4}};

inline const Body& bumpy_body() {
  static const Body body(bumpy_mesh());
  return body;
}

// The Cramér–Rao limit of the points' RMS motion: independent errors along the facets' normals.
inline double limit_m(const Body& body, const std::vector<Eigen::Vector3d>& p_m, double sigma_m) {
  Eigen::Vector3d mean_m = Eigen::Vector3d::Zero();
  for (const auto& p : p_m) mean_m += p / static_cast<double>(p_m.size());
  Eigen::Matrix<double, 6, 6> info = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 6> metric = info;
  for (const auto& p : p_m) {
    const auto& [a, b, c] = body.mesh.triangles[body.bvh.closest_point(p).triangle];
    const auto& v = body.mesh.vertices_m;
    const Eigen::Vector3d n = (v[b] - v[a]).cross(v[c] - v[a]).normalized();
    Eigen::Matrix<double, 6, 1> j;
    j << (p - mean_m).cross(n), n;
    info += j * j.transpose();
    Eigen::Matrix<double, 3, 6> motion;
    motion << -skew(p - mean_m), Eigen::Matrix3d::Identity();
    metric += motion.transpose() * motion / static_cast<double>(p_m.size());
  }
  return sigma_m * std::sqrt((info.inverse() * metric).trace());
}

}  // namespace asperity::test
