#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>

#include "asperity/base/random.h"
#include "asperity/geometry/triangle_mesh.h"
#include "asperity/registration/registration_result.h"
#include "test_surfaces.h"

namespace asperity::test {

// A closed prism about z with equal sides.
inline TriangleMesh prism_mesh(std::uint32_t sides, double radius_m, double height_m) {
  TriangleMesh out;
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / sides;
    for (const double z_m : {-0.5 * height_m, 0.5 * height_m}) {
      out.vertices_m.emplace_back(radius_m * std::cos(angle), radius_m * std::sin(angle), z_m);
    }
  }
  out.vertices_m.emplace_back(0.0, 0.0, -0.5 * height_m);
  out.vertices_m.emplace_back(0.0, 0.0, 0.5 * height_m);
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t next = (i + 1) % sides;
    out.triangles.push_back({2 * i, 2 * next, 2 * next + 1});
    out.triangles.push_back({2 * i, 2 * next + 1, 2 * i + 1});
    out.triangles.push_back({2 * sides, 2 * next, 2 * i});
    out.triangles.push_back({2 * sides + 1, 2 * i + 1, 2 * next + 1});
  }
  return out;
}

// A sphere of facets of 1.5 mm with a round bump about +x, 20 mm wide.
inline TriangleMesh sphere_mesh(double radius_m, double bump_m) {
  return grid(70, 140, [&](double u, double v) -> Eigen::Vector3d {
    const Eigen::Vector3d d = spherical(u, v);
    const double away_m = radius_m * std::acos(std::clamp(d.x(), -1.0, 1.0));
    return (radius_m + bump_m * std::exp(-0.5 * std::pow(away_m / 5e-3, 2))) * d;
  });
}

// A path with an error that lasts: along each axis a Gauss–Markov process of `slow_m` over 20 mm of path, stated as
// such; 10 µm of white noise.
inline MeasuredPath measured(const std::vector<Eigen::Vector3d>& p_mesh_m, double slow_m, Random& random) {
  MeasuredPath out;
  Eigen::Vector3d slow = slow_m * normal3(random);
  for (std::size_t i = 0; i < p_mesh_m.size(); ++i) {
    const double keep = i == 0 ? 1.0 : std::exp(-(p_mesh_m[i] - p_mesh_m[i - 1]).norm() / 20e-3);
    slow = keep * slow + std::sqrt(1.0 - keep * keep) * slow_m * normal3(random);
    out.p_world_m.push_back(kWorldMesh * Eigen::Vector3d(p_mesh_m[i] + slow + 10e-6 * normal3(random)));
  }
  out.slow_covariance_world_m2 = slow_m * slow_m * Eigen::Matrix3d::Identity();
  out.sigma_m = slow_m;
  return out;
}

}  // namespace asperity::test
