#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "asperity/base/random.h"
#include "asperity/geometry/mesh_surface.h"
#include "asperity/registration/registration_result.h"

namespace asperity {

// A bumpy ball of 40 mm radius, facets of some 1.5 mm.
inline TriangleMesh bumpy_ball() {
  constexpr int kRows = 80, kColumns = 160;
  TriangleMesh mesh;
  for (int row = 0; row <= kRows; ++row) {
    const double latitude = std::numbers::pi * (static_cast<double>(row) / kRows - 0.5);
    for (int column = 0; column < kColumns; ++column) {
      const double longitude = 2.0 * std::numbers::pi * column / kColumns;
      const Eigen::Vector3d out(std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
                                std::sin(latitude));
      const double bump = std::sin(7.0 * out.x() + 1.0) * std::sin(6.0 * out.y()) * std::cos(5.0 * out.z() - 0.5);
      mesh.vertices_m.emplace_back(0.04 * (1.0 + 0.06 * bump) * out);
    }
  }
  for (std::uint32_t row = 0; row < kRows; ++row) {
    for (std::uint32_t column = 0; column < kColumns; ++column) {
      const std::uint32_t a = row * kColumns + column, b = row * kColumns + (column + 1) % kColumns;
      mesh.triangles.push_back({a, b, b + kColumns});
      mesh.triangles.push_back({a, b + kColumns, a + kColumns});
    }
  }
  return mesh;
}

// A stroke over the ball: an arc about its middle, `lean` its height over the equator, with errors.
struct BallStroke {
  double begin_rad = 0.0;
  double end_rad = 2.5;
  double lean = 0.5;  // of a wave about the equator
  double lean_phase = 0.0;
  double across_m = 0.0;                            // beside the wave
  double relief_m = 20e-6;                          // RMS, a texture of the ball: the same at the same place
  double white_m = 2e-6;                            // of each point, along the normal
  double slow_m = 0.1e-3;                           // of each axis, lasting for 20 mm
  Eigen::Vector3d tip_m = Eigen::Vector3d::Zero();  // error of the calibrated tip, marker axes
  Eigen::Vector3d tip_sigma_m = Eigen::Vector3d::Zero();
  int tip = 0;
};

// A texture in space: waves of 0.8 to 3 mm, RMS 1.
inline double ball_relief(const Eigen::Vector3d& p_m) {
  double sum = 0.0;
  constexpr int kWaves = 30;
  Random random(99);
  for (int i = 0; i < kWaves; ++i) {
    const Eigen::Vector3d direction = Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
    const double wave_m = 0.8e-3 + 2.2e-3 * random.uniform();
    sum += std::cos(2.0 * std::numbers::pi / wave_m * direction.dot(p_m) + 6.28 * random.uniform());
  }
  return sum * std::sqrt(2.0 / kWaves);
}

// The measured path, world frame. The probe stands along the ball's radius, 100 mm long, its marker axes turning with
// it.
inline MeasuredPath stroke_over_ball(const MeshSurface& surface, const Pose& T_mesh_world, const BallStroke& stroke,
                                     std::uint64_t seed) {
  constexpr double kSpacing_m = 0.25e-3;
  Random random(seed);
  MeasuredPath path;
  path.sigma_m = stroke.slow_m;
  path.slow_covariance_world_m2 = stroke.slow_m * stroke.slow_m * Eigen::Matrix3d::Identity();
  path.tip_sigma_m = stroke.tip_sigma_m;
  path.tip = stroke.tip;
  const Pose T_world_mesh = T_mesh_world.inverse();
  const double keep = std::exp(-kSpacing_m / 20e-3);
  const auto draw = [&] { return Eigen::Vector3d(random.normal(), random.normal(), random.normal()); };
  Eigen::Vector3d slow_m = stroke.slow_m * draw();
  Eigen::Vector3d before = Eigen::Vector3d::Zero();
  for (double angle = stroke.begin_rad; angle < stroke.end_rad; angle += 5e-4) {
    const Eigen::Vector3d towards =
        Eigen::Vector3d(std::cos(angle), std::sin(angle),
                        stroke.lean * std::sin(3.0 * angle + stroke.lean_phase) + stroke.across_m / 0.04)
            .normalized();
    const RayHit hit = surface.bvh.cast_ray(0.1 * towards, -towards);
    const Eigen::Vector3d p_m = (0.1 - hit.t) * towards;
    if (!path.p_world_m.empty() && (p_m - before).norm() < kSpacing_m) continue;
    before = p_m;
    slow_m = keep * slow_m + std::sqrt(1.0 - keep * keep) * stroke.slow_m * draw();
    const Eigen::Quaterniond q_world_marker =
        T_world_mesh.rotation * shortest_rotation(Eigen::Vector3d::UnitZ(), towards);
    const double height_m = stroke.relief_m * ball_relief(p_m) + stroke.white_m * random.normal();
    path.p_world_m.push_back(T_world_mesh * Eigen::Vector3d(p_m + height_m * towards) + slow_m -
                             q_world_marker * stroke.tip_m);
    path.q_world_marker.push_back(q_world_marker);
  }
  return path;
}

}  // namespace asperity
