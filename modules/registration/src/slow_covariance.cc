#include "slow_covariance.h"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

namespace asperity::registration {

Vector6 pose_gradient(const FacetHeights& heights, std::size_t i, const Eigen::Vector3d& centre_m) {
  Vector6 row;
  row << (heights.p_mesh_m[i] - centre_m).cross(heights.normal[i]), heights.normal[i];
  return row;
}

Matrix6 start_covariance(const PathChain& chain, const FacetHeights& heights, const Pose& T_mesh_world,
                         const Eigen::Vector3d& centre_m, const RefineConfig& config) {
  constexpr std::size_t kMostPoints = 500;  // ample for 6 numbers; the work grows with the square
  const std::size_t stride = 1 + heights.count / kMostPoints;
  struct Row {
    Vector6 gradient;
    Eigen::Vector3d normal_world;
    double s_m;
    std::size_t part;
  };
  std::vector<Row> rows;
  std::size_t seen = 0;
  for (std::size_t p = 0; p < chain.parts.size(); ++p) {
    const PathChain::Part& part = chain.parts[p];
    for (std::size_t i = part.first_point; i < part.first_point + part.points; ++i) {
      if (heights.usable[i] == 0 || seen++ % stride != 0) continue;
      const double s_m = (static_cast<double>(chain.knots[i].knot) + chain.knots[i].share) * config.knot_m;
      rows.push_back(
          {pose_gradient(heights, i, centre_m), T_mesh_world.rotation.conjugate() * heights.normal[i], s_m, p});
    }
  }
  Matrix6 information = Matrix6::Zero(), spread = Matrix6::Zero();
  const double white_m2 = heights.rms_m * heights.rms_m;
  for (const Row& a : rows) {
    information += a.gradient * a.gradient.transpose();
    spread += white_m2 * a.gradient * a.gradient.transpose();
    for (const Row& b : rows) {
      if (a.part != b.part) continue;
      const double slow_m2 = a.normal_world.dot(chain.parts[a.part].covariance_m2 * b.normal_world) *
                             std::exp(-std::abs(a.s_m - b.s_m) / config.slow_length_m);
      spread += slow_m2 * a.gradient * b.gradient.transpose();
    }
  }
  const Matrix6 inverse = information.ldlt().solve(Matrix6::Identity());
  return inverse * spread * inverse;
}

}  // namespace asperity::registration
