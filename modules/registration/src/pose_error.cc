#include "asperity/registration/pose_error.h"

#include <cmath>

#include "asperity/base/error.h"

namespace asperity {

PoseError pose_error(const RegistrationResult& result, const Pose& true_T_mesh_world,
                     std::span<const Eigen::Vector3d> p_mesh_m) {
  if (p_mesh_m.empty()) throw Error("pose error: no point");
  const Pose error = result.T_mesh_world * true_T_mesh_world.inverse();
  double sum_m2 = 0.0, expected_m2 = 0.0;
  for (const Eigen::Vector3d& p : p_mesh_m) {
    sum_m2 += (error * p - p).squaredNorm();
    Eigen::Matrix<double, 3, 6> motion;
    motion << -skew(p - result.centre_mesh_m), Eigen::Matrix3d::Identity();
    expected_m2 += (motion * result.covariance * motion.transpose()).trace();
  }
  const auto count = static_cast<double>(p_mesh_m.size());
  PoseError out;
  out.rms_m = std::sqrt(sum_m2 / count);
  out.rotation_rad = log_rotation(error.rotation).norm();
  out.sigma_m = std::sqrt(expected_m2 / count);
  out.sigma_rad = std::sqrt(result.covariance.topLeftCorner<3, 3>().trace());
  return out;
}

}  // namespace asperity
