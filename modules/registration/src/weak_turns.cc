#include "weak_turns.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace asperity::registration {

void list_weak_turns(const PathChain& chain, double limit_rad, RegistrationResult& result) {
  const Eigen::Matrix3d turn = result.covariance.topLeftCorner<3, 3>();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(turn);
  for (int k = 0; k < 3; ++k) {
    const double sigma_rad = std::sqrt(std::max(0.0, solver.eigenvalues()[k]));
    if (!(sigma_rad > limit_rad)) continue;
    const Eigen::Vector3d axis = solver.eigenvectors().col(k);
    const bool listed = std::any_of(result.undetermined.begin(), result.undetermined.end(), [&](const auto& other) {
      return other.turn.norm() > 0.0 && std::abs(other.turn.normalized().dot(axis)) > 0.9;
    });
    if (listed) continue;
    // The shift that goes with the turn, as the data have it.
    const Eigen::Vector3d shift = result.covariance.bottomLeftCorner<3, 3>() * axis / (sigma_rad * sigma_rad);
    double moved_m2 = 0.0;
    for (const Eigen::Vector3d& p_m : chain.p_world_m) {
      if (!p_m.allFinite()) continue;
      const Eigen::Vector3d arm = result.T_mesh_world * p_m - result.centre_mesh_m;
      moved_m2 += (axis.cross(arm) + shift).squaredNorm() / static_cast<double>(chain.p_world_m.size());
    }
    const double scale = 1.0 / std::sqrt(moved_m2);
    if (!std::isfinite(scale)) continue;
    UndeterminedMotion motion;
    motion.turn = scale * axis;
    motion.shift = scale * shift;
    motion.centre_mesh_m = result.centre_mesh_m;
    motion.sigma_m = sigma_rad / scale;
    motion.description = fmt::format("turns about ({:.2f}, {:.2f}, {:.2f}) are known to {:.1f} degrees only", axis.x(),
                                     axis.y(), axis.z(), sigma_rad * 180.0 / std::numbers::pi);
    result.undetermined.push_back(motion);
  }
}

}  // namespace asperity::registration
