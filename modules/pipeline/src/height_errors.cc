#include "asperity/pipeline/height_errors.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/LU>

#include "asperity/base/units.h"
#include "asperity/profile/estimate_stiffness.h"
#include "asperity/profile/measure_error_floor.h"
#include "asperity/profile/measure_length_error.h"

namespace asperity {

namespace {

constexpr double kStandingStill_mps = 2e-3;
constexpr double kDeepest_m = 1e-3;      // of an indentation of which nothing is known; tips are no longer
constexpr double kUnstatedScale = 0.01;  // relative error of a calibration that states none

double duration_s(const std::vector<std::int64_t>& t_ns) {
  return static_cast<double>(t_ns.back() - t_ns.front()) * kNanosecond_s;
}

// The relative error of an acceleration along `n` (marker frame) that the calibration's standard errors leave: to first
// order nᵀ B⁻¹ δB n.
double scale_sigma(const AccelerometerCalibration& accelerometer, const Eigen::Vector3d& n) {
  if (accelerometer.B.cols() < 3 || accelerometer.standard_errors.cols() < 3) return kUnstatedScale;
  const Eigen::Vector3d w = accelerometer.B.leftCols<3>().transpose().fullPivLu().solve(n);
  const Eigen::Matrix3d weighted = w.asDiagonal() * accelerometer.standard_errors.leftCols<3>() * n.asDiagonal();
  const double sigma = weighted.norm();
  return std::isfinite(sigma) && sigma > 0.0 ? sigma : kUnstatedScale;
}

// How deep the tip may be, by the mean force and the compliance that the force's variation shows; where that is not
// significant, by the highest possible one, evenly spread below it.
double indentation_m(const TipMotion& motion, const BasePathResult& base) {
  double sum_N = 0.0, count = 0.0;
  for (std::size_t i = 0; i < motion.force_N.size(); ++i) {
    if (base.contact[i] == 0 || !std::isfinite(motion.force_N[i])) continue;
    sum_N += motion.force_N[i];
    count += 1.0;
  }
  if (count == 0.0) return 0.0;
  const StiffnessEstimate stiffness = estimate_stiffness(motion, base.path, base.contact, {});
  const double mm_per_N = stiffness.measured
                              ? std::hypot(stiffness.compliance_mm_per_N, stiffness.compliance_stderr_mm_per_N)
                              : 1.0 / (std::numbers::sqrt3 * stiffness.lower_bound_N_per_mm);
  const double out = 1e-3 * mm_per_N * std::abs(sum_N / count);
  return std::isfinite(out) ? std::min(out, kDeepest_m) : 0.0;
}

}  // namespace

HeightErrors height_errors(const Recording& recording, const TrajectoryResult& trajectory, const BasePathResult& base) {
  HeightErrors out;
  const TipMotion& motion = trajectory.motion;
  const auto figure = [&](const std::string& name) {
    const auto found = trajectory.metrics.find(name);
    return found == trajectory.metrics.end() ? 0.0 : found->second;
  };
  const Eigen::Vector3d tracker_sigma_m(figure("tracker_sigma_x_m"), figure("tracker_sigma_y_m"),
                                        figure("tracker_sigma_z_m"));
  const std::size_t n = motion.size();
  if (n < 2 || base.path.size() != n || recording.tracker.size() < 2 || !(tracker_sigma_m.minCoeff() > 0.0)) {
    return out;
  }

  std::vector<double> t_s(n), normal_mps2(n), along_mps2(n), height_m(n);
  Eigen::Vector3d normal_square = Eigen::Vector3d::Zero(), along_square = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal_marker = Eigen::Vector3d::Zero();
  std::vector<char> moving(n, 0);
  double samples = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector3d& normal = base.path.n_world[i];
    const Eigen::Vector3d& v = motion.v_world_tip_mps[i];
    const Eigen::Vector3d along = (v - normal * normal.dot(v)).normalized();
    t_s[i] = static_cast<double>(motion.t_ns[i] - motion.t_ns[0]) * kNanosecond_s;
    normal_mps2[i] = normal.dot(motion.a_world_tip_mps2[i]);
    along_mps2[i] = along.dot(motion.a_world_tip_mps2[i]);
    height_m[i] = normal.dot(motion.p_world_tip_m[i] - base.path.p_world_m[i]);
    if (base.contact[i] == 0 || !(base.speed_mps[i] > kStandingStill_mps)) continue;
    moving[i] = 1;
    normal_square += normal.cwiseAbs2();
    along_square += along.cwiseAbs2();
    normal_marker += motion.q_world_marker[i].conjugate() * normal;
    samples += 1.0;
  }
  if (samples == 0.0) return out;
  const double frame_s = duration_s(recording.tracker.t_ns) / static_cast<double>(recording.tracker.size() - 1);
  const Eigen::Vector3d tracker_psd = 2.0 * frame_s * tracker_sigma_m.cwiseAbs2();
  out.tracker_psd_m2ps = normal_square.dot(tracker_psd) / samples;
  out.along_tracker_psd_m2ps = along_square.dot(tracker_psd) / samples;
  out.accel_psd_m2ps3 = std::min(acceleration_floor_m2ps3(t_s, normal_mps2, moving),
                                 largest_acceleration_noise_m2ps3(t_s, height_m, moving, out.tracker_psd_m2ps));
  out.along_accel_psd_m2ps3 = acceleration_floor_m2ps3(t_s, along_mps2, moving);
  const bool round = base.shape != PathShape::kPlane && base.shape != PathShape::kLine;
  const LengthErrors length =
      measure_length_error(motion, base, recording.calibration.tip_in_marker_m, recording.calibration.tip_radius_m,
                           round ? indentation_m(motion, base) : 0.0);
  out.along_scale_sigma = length.scale_sigma;
  out.length_ends_m = length.ends_m;
  // A normal that is off by φ makes heights too small by 1 − cos φ.
  const double turned = 0.5 * std::pow(base.normal_sigma_deg * std::numbers::pi / 180.0, 2);
  out.scale_sigma = std::hypot(scale_sigma(recording.calibration.accelerometer, normal_marker.normalized()), turned);
  return out;
}

}  // namespace asperity
