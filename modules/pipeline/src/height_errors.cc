#include "asperity/pipeline/height_errors.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/LU>

#include "asperity/base/units.h"
#include "asperity/profile/measure_error_floor.h"
#include "asperity/profile/measure_length_error.h"
#include "asperity/profile/noise_at_rest.h"
#include "calibration_crosstalk.h"
#include "normal_leak.h"

namespace asperity {

namespace {

constexpr double kStandingStill_mps = 2e-3;
constexpr double kLargestLean_rad = 0.7;  // its tangent is a normal error's no more
constexpr double kUnstatedScale = 0.01;   // relative error of a calibration that states none

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

// Samples whose value was replaced by their neighbours' mean.
std::size_t replaced_samples(const TrajectoryResult& trajectory) {
  std::size_t out = 0;
  for (const Problem& problem : trajectory.problems) out += problem.kind == "spike" ? problem.count : 0;
  return out;
}

// How far the normals may lean about the path. A fitted base's lean was corrected by the motion itself
// (find_base_path.h); a mesh's normals are those of the mesh, and what the motion shows against them is their error.
double lean_rad(const TipMotion& motion, const BasePathResult& base, const std::vector<char>& moving) {
  const double sigma_rad = base.normal_sigma_deg * std::numbers::pi / 180.0;
  if (base.shape != PathShape::kMesh) return std::min(sigma_rad, kLargestLean_rad);
  return std::atan(normal_leak(motion, off_base(motion, base.path), moving));
}

// Of the object's own motion: weights along the normals and along the path. A rotation φ of the object moves the tip
// relative to it by −φ × r, so the height by φ·(n × r).
void add_object(const ObjectMotion& object, const TipMotion& motion, const BasePathResult& base,
                const std::vector<char>& moving, HeightErrors& out) {
  Eigen::Matrix<double, 6, 1> normal_weight = Eigen::Matrix<double, 6, 1>::Zero(), along_weight = normal_weight;
  double samples = 0.0;
  constexpr std::size_t kStride = 8;  // the object's orientation does not change faster
  for (std::size_t i = 0; i < motion.size(); i += kStride) {
    if (moving[i] == 0) continue;
    const Eigen::Quaterniond R = object.at(motion.t_ns[i]).T_world_object.rotation;
    const Eigen::Vector3d arm = R * motion.p_world_tip_m[i], normal = R * base.path.n_world[i];
    const Eigen::Vector3d v = R * motion.v_world_tip_mps[i];
    const Eigen::Vector3d along = (v - normal * normal.dot(v)).normalized();
    const auto add = [&](const Eigen::Vector3d& direction, Eigen::Matrix<double, 6, 1>& weight) {
      weight.head<3>() += direction.cwiseAbs2();
      weight.tail<3>() += direction.cross(arm).cwiseAbs2();
    };
    add(normal, normal_weight);
    add(along, along_weight);
    samples += 1.0;
  }
  if (samples == 0.0) return;
  const ObjectNoise& noise = object.noise;
  for (Eigen::Index axis = 0; axis < 6; ++axis) {
    const bool turns = axis >= 3;
    const Eigen::Index k = axis % 3;
    ObjectAxisError error;
    error.pose_psd = 2.0 * noise.frame_s * std::pow((turns ? noise.pose_rad : noise.pose_m)[k], 2);
    error.motion_psd = 2.0 * (turns ? noise.angular_rad2ps3 : noise.accel_m2ps3)[k];
    error.slow_sigma = (turns ? noise.slow_rad : noise.slow_m)[k];
    error.weight = normal_weight[axis] / samples;
    out.object.push_back(error);
    error.weight = along_weight[axis] / samples;
    out.along_object.push_back(error);
  }
  out.object_slow_time_s = noise.slow_time_s;
}

// The least density of the tracker's noise along the normal, m² s. Where the acceleration errs along the normal alone,
// as a contact's ringing makes it err, the other axes are known and the tracker's three axes measure this one error:
// their information adds up. The noise was learnt from `poses` poses: its variance has the relative error √(2/poses).
double least_tracker_psd_m2ps(const Eigen::Vector3d& mean_square_normal, const Eigen::Vector3d& tracker_psd_m2ps,
                              double poses) {
  constexpr double kSure = 2.33;  // one-sided 99 %, as each octave's limit (measure_error_floor.h)
  const double least = 1.0 / mean_square_normal.cwiseQuotient(tracker_psd_m2ps).sum();
  return least / (1.0 + kSure * std::sqrt(2.0 / std::max(poses, 2.0)));
}

// Along the normal, along the path and across it.
std::vector<AccelerationAtRest> accelerations_at_rest(const TipMotion& motion, const std::vector<double>& normal_mps2,
                                                      const Eigen::Vector3d& normal, const Eigen::Vector3d& along,
                                                      const Eigen::Vector3d& gravity_mps2,
                                                      const Eigen::Vector3d& tracker_m2ps,
                                                      const Eigen::Vector3d& slow_sigma_m, double lever_m,
                                                      const HeightErrors& of_height) {
  std::vector<AccelerationAtRest> out{{normal_mps2, of_height}};
  for (const Eigen::Vector3d& direction : {along, Eigen::Vector3d(normal.cross(along).normalized())}) {
    AccelerationAtRest& one = out.emplace_back();
    one.errors = of_height;
    one.errors.tracker_psd_m2ps = direction.cwiseAbs2().dot(tracker_m2ps);
    one.errors.tracker_slow_sigma_m = direction.cwiseProduct(slow_sigma_m).norm();
    one.errors.force_across_mps2 = gravity_mps2.cross(direction).norm();
    one.errors.lever_m = lever_m;
    for (const Eigen::Vector3d& a_mps2 : motion.a_world_tip_mps2) one.accel_mps2.push_back(direction.dot(a_mps2));
  }
  return out;
}

}  // namespace

HeightErrors height_errors(const Recording& recording, const TrajectoryResult& trajectory, const BasePathResult& base) {
  HeightErrors out;
  const TipMotion& motion = trajectory.motion;
  const auto figure = [&](const std::string& name) {
    const auto found = trajectory.metrics.find(name);
    return found == trajectory.metrics.end() ? 0.0 : found->second;
  };
  const auto axes = [&](const std::string& before, const std::string& after) {
    return Eigen::Vector3d(figure(before + "x" + after), figure(before + "y" + after), figure(before + "z" + after));
  };
  const Eigen::Vector3d tracker_sigma_m = axes("tracker_sigma_", "_m");
  const std::size_t n = motion.size();
  if (n < 2 || base.path.size() != n || recording.tracker.size() < 2 || !(tracker_sigma_m.minCoeff() > 0.0)) {
    return out;
  }

  std::vector<double> t_s(n), normal_mps2(n), along_mps2(n), height_m(n);
  Eigen::Vector3d normal_square = Eigen::Vector3d::Zero(), along_square = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal_marker = Eigen::Vector3d::Zero(), mean_normal = Eigen::Vector3d::Zero();
  Eigen::Vector3d mean_along = Eigen::Vector3d::Zero();
  // Means of the squares of the normal and of the direction of travel in the marker.
  Eigen::Vector3d normal_in_marker = Eigen::Vector3d::Zero(), along_in_marker = Eigen::Vector3d::Zero();
  std::vector<char> moving(n, 0), resting(n, 0);
  double samples = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector3d& normal = base.path.n_world[i];
    const Eigen::Vector3d& v = motion.v_world_tip_mps[i];
    const Eigen::Vector3d along = (v - normal * normal.dot(v)).normalized();
    t_s[i] = static_cast<double>(motion.t_ns[i] - motion.t_ns[0]) * kNanosecond_s;
    normal_mps2[i] = normal.dot(motion.a_world_tip_mps2[i]);
    along_mps2[i] = along.dot(motion.a_world_tip_mps2[i]);
    height_m[i] = normal.dot(motion.p_world_tip_m[i] - base.path.p_world_m[i]);
    resting[i] = base.contact[i] != 0 && base.speed_mps[i] < kStandingStill_mps ? 1 : 0;
    if (base.contact[i] == 0 || !(base.speed_mps[i] > kStandingStill_mps)) continue;
    moving[i] = 1;
    normal_square += normal.cwiseAbs2();
    mean_normal += normal;
    along_square += along.cwiseAbs2();
    mean_along += along.dot(mean_along) < 0.0 ? -along : along;
    const Eigen::Vector3d in_marker = motion.q_world_marker[i].conjugate() * normal;
    normal_marker += in_marker;
    normal_in_marker += in_marker.cwiseAbs2();
    along_in_marker += (motion.q_world_marker[i].conjugate() * along).cwiseAbs2();
    samples += 1.0;
  }
  if (samples == 0.0) return out;
  const double frame_s = duration_s(recording.tracker.t_ns) / static_cast<double>(recording.tracker.size() - 1);
  const Eigen::Vector3d tracker_psd = 2.0 * frame_s * tracker_sigma_m.cwiseAbs2();
  out.tracker_psd_m2ps = normal_square.dot(tracker_psd) / samples;
  out.along_tracker_psd_m2ps = along_square.dot(tracker_psd) / samples;
  const LengthErrors length = measure_length_error(motion, base, recording.calibration.tip_in_marker_m,
                                                   recording.calibration.tip_radius_m, base.indentation_sigma_m);
  const double per_m = base.length_m > 0.0 ? 1.0 / base.length_m : 0.0;
  const double bends = per_m * length.bends_m, turns = per_m * length.turned_m;
  out.along_scale_sigma = std::hypot(length.scale_sigma, bends, turns);
  // On a mesh a position is that of the nearest point: the level at which the tip goes does not move it. Errors of
  // turns add up as a random walk: of the same end, its variance about the path's mean (1/6) is twice that of a stretch
  // (1/12).
  if (base.shape != PathShape::kMesh) {
    out.stretch_sigma = std::hypot(length.scale_sigma, bends, std::numbers::sqrt2 * turns);
  }
  out.length_ends_m = length.ends_m;
  out.along_sigma_m = length.place_m;
  // What the smoother has learnt of the sensor's own noise, at one reading a period.
  const double period_s = duration_s(motion.t_ns) / static_cast<double>(n - 1);
  const double own_m2ps3 = 2.0 * std::pow(figure("accel_own_noise_mps2"), 2) * period_s;
  const Eigen::Vector3d clipped_m2ps3 = axes("accel_clipped_", "_m2ps3");
  const auto white_m2ps3 = [&](const std::vector<double>& accel_mps2, const std::vector<double>& position_m,
                               const Eigen::Vector3d& in_marker, double tracker_m2ps) {
    const double seen = std::min(acceleration_floor_m2ps3(t_s, accel_mps2, moving),
                                 own_m2ps3 + folded_acceleration_m2ps3(t_s, accel_mps2, moving));
    const double lost =
        gap_noise_m2ps3(t_s, accel_mps2, moving, replaced_samples(trajectory)) + in_marker.dot(clipped_m2ps3) / samples;
    const double most = largest_acceleration_noise_m2ps3(t_s, position_m, moving, tracker_m2ps);
    return std::max(own_m2ps3, std::min(seen + lost, most));
  };
  out.accel_psd_m2ps3 = white_m2ps3(normal_mps2, height_m, normal_in_marker,
                                    least_tracker_psd_m2ps(normal_square / samples, tracker_psd, figure("poses_used")));
  out.accel_own_psd_m2ps3 = std::min(own_m2ps3, out.accel_psd_m2ps3);
  // Along the path the hand's own motion fills the low frequencies: nothing bounds the noise from above.
  out.along_accel_psd_m2ps3 = white_m2ps3(along_mps2, {}, along_in_marker, 0.0);
  out.accel_walk_psd_m2ps5 = 2.0 * std::pow(figure("accel_bias_walk_mps2_rts"), 2);
  out.tracker_slow_sigma_m = std::sqrt(normal_square.dot(axes("tracker_slow_sigma_", "_m").cwiseAbs2()) / samples);
  out.tracker_slow_time_s = figure("tracker_slow_time_s");
  // Gravity along the surface, turned by a wrong orientation, is an acceleration along the normal.
  const Eigen::Vector3d across = recording.info.gravity_world_mps2.cross(mean_normal.normalized());
  out.force_across_mps2 = across.norm();
  const Eigen::Vector3d sigma_rad = axes("tracker_sigma_r", "_rad");
  out.rotation_tracker_psd_rad2ps = 2.0 * frame_s * across.normalized().cwiseProduct(sigma_rad).squaredNorm();
  out.rotation_rate_psd_rad2ps3 = 2.0 * std::pow(figure("gyro_own_noise_radps"), 2) * period_s;
  out.rotation_accel_psd_rad2ps5 = 2.0 * std::pow(figure("angular_accel_radps2_rtHz"), 2);
  CalibrationErrors calibration;
  calibration.accel_matrix = figure("accel_matrix_sigma");
  calibration.gyro_matrix = figure("gyro_matrix_sigma");
  calibration.tip_m = motion.sigma_tip_in_marker_m;
  calibration.tip_from_sensor_m =
      recording.calibration.tip_in_marker_m - recording.calibration.accelerometer_in_marker_m();
  out.lever_m = calibration.tip_from_sensor_m.cross(normal_marker.normalized()).norm();
  add_crosstalk(motion, base.path, moving, recording.info.gravity_world_mps2, calibration,
                lean_rad(motion, base, moving), out);
  if (trajectory.object) add_object(*trajectory.object, motion, base, moving, out);
  const bool flat = base.shape == PathShape::kPlane || base.shape == PathShape::kLine || base.shape == PathShape::kMesh;
  out.base_degree = flat ? 1 : 2;
  // A normal that is off by φ makes heights too small by 1 − cos φ.
  const double turned = 0.5 * std::pow(base.normal_sigma_deg * std::numbers::pi / 180.0, 2);
  out.scale_sigma = std::hypot(scale_sigma(recording.calibration.accelerometer, normal_marker.normalized()), turned);
  // The 1/f noise is the sensor's, whatever comes to the white noise with the contact.
  const double quiet_m2ps3 = std::max(own_m2ps3, 2.0 * std::pow(figure("accel_noise_mps2"), 2) * period_s);
  const NoiseAtRest at_rest =
      noise_at_rest(t_s, motion.force_N, resting,
                    accelerations_at_rest(motion, normal_mps2, mean_normal.normalized(), mean_along.normalized(),
                                          recording.info.gravity_world_mps2, tracker_psd,
                                          axes("tracker_slow_sigma_", "_m"), calibration.tip_from_sensor_m.norm(), out),
                    quiet_m2ps3);
  if (at_rest.rests_s > 0.0) {
    const double of_white = quiet_m2ps3 / out.accel_psd_m2ps3;
    out.accel_corner_Hz = of_white * at_rest.corner_Hz;
    out.accel_corner_sigma_Hz = of_white * at_rest.corner_sigma_Hz;
  } else {
    out.accel_corner_Hz = at_rest.corner_Hz;
  }
  return out;
}

}  // namespace asperity
