#include "asperity/simulation/tracker_sampler.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "normal_vector.h"
#include "streams.h"

namespace asperity {
namespace {

std::uint64_t seed_of(const SimulationConfig& config) { return static_cast<std::uint64_t>(config.seed); }

std::int64_t run_length(double mean, Random& random) {
  if (mean <= 1.0) return 1;
  return 1 + static_cast<std::int64_t>(std::log(1.0 - random.uniform()) / std::log(1.0 - 1.0 / mean));
}

Eigen::Vector3d ray(const Pose& T_world_marker) { return T_world_marker.translation_m.normalized(); }

}  // namespace

SimulatedTrackerNoise simulated_tracker_noise(const SimulatedTrackerConfig& config, const Pose& T_world_marker) {
  constexpr double kLeastCosine = 0.2;  // a marker seen at 80 degrees is lost before its noise grows further
  SimulatedTrackerNoise noise;
  const Eigen::Vector3d along = ray(T_world_marker);
  const Eigen::Vector3d sideways = Eigen::Vector3d::UnitY().cross(along);
  const Eigen::Vector3d right = sideways.norm() > 1e-6 ? sideways.normalized() : Eigen::Vector3d::UnitX();
  noise.world_from_ray << right, along.cross(right), along;
  const double distance = T_world_marker.translation_m.norm() / config.reference_distance_m;
  const double facing = std::abs((T_world_marker.rotation * Eigen::Vector3d::UnitZ()).dot(along));
  const double foreshortening = 1.0 / std::max(kLeastCosine, facing);
  noise.position_m = foreshortening * distance * Eigen::Vector3d(config.noise_m.data());
  noise.position_m.z() *= distance;
  noise.rotation_rad = foreshortening * distance * Eigen::Vector3d(config.noise_rad.data());
  return noise;
}

Pose flipped_pose(const Pose& T_world_marker) {
  const Eigen::Vector3d along = ray(T_world_marker);
  const Eigen::Matrix3d mirror = Eigen::Matrix3d::Identity() - 2.0 * along * along.transpose();
  const Eigen::Matrix3d rotation =
      mirror * T_world_marker.rotation.toRotationMatrix() * Eigen::Vector3d(1.0, 1.0, -1.0).asDiagonal();
  return {Eigen::Quaterniond(rotation).normalized(), T_world_marker.translation_m};
}

TrackerSampler::TrackerSampler(const SimulationConfig& config, std::int64_t start_ns, std::uint64_t other_errors)
    : config_(config.tracker),
      tip_in_marker_m_(config.probe.tip_in_marker_m.data()),
      start_ns_(start_ns),
      noise_(seed_of(config) + other_errors, stream(Stream::kTrackerNoise)),
      clock_(seed_of(config), stream(Stream::kTrackerClock)),
      faults_(seed_of(config) + other_errors, stream(Stream::kTrackerFaults)),
      slow_random_(seed_of(config) + other_errors, stream(Stream::kTrackerSlow)),
      wander_random_(seed_of(config), stream(Stream::kTrackerWander)),
      wander_(config.tracker.clock_wander_s, config.tracker.clock_wander_time_s, wander_random_) {
  phase_ = clock_.uniform();
  for (GaussMarkov& part : slow_) part = GaussMarkov(1.0, config_.slow_time_s, slow_random_);
}

Pose TrackerSampler::shake(const Pose& T_world_marker, double t_s) {
  const double step_s = t_s - held_t_s_;
  const Eigen::Vector3d v_mps = (T_world_marker.translation_m - held_m_) / step_s;
  if (held_ >= 2) {
    const double omega_radps = 2.0 * std::numbers::pi * config_.mount_Hz;
    const Eigen::Vector3d a_mps2 = (v_mps - held_v_mps_) / step_s;
    bend_v_mps_ += step_s * (-a_mps2 - 2.0 * config_.mount_damping_ratio * omega_radps * bend_v_mps_ -
                             omega_radps * omega_radps * bend_m_);
    bend_m_ += step_s * bend_v_mps_;
  }
  held_ = std::min(held_ + 1, 2);
  held_t_s_ = t_s;
  held_m_ = T_world_marker.translation_m;
  held_v_mps_ = v_mps;
  const Eigen::Vector3d out_of_body = T_world_marker.rotation * -tip_in_marker_m_.normalized();
  Pose out = T_world_marker;
  out.translation_m += bend_m_;
  out.rotation = (exp_rotation(out_of_body.cross(bend_m_) / config_.mount_length_m) * out.rotation).normalized();
  return out;
}

void TrackerSampler::push(const MotionState& state) {
  Pose now{state.q_world_marker, state.p_world_tip_m - state.q_world_marker * tip_in_marker_m_};
  if (config_.mount_Hz > 0.0) now = shake(now, state.t_s);
  if (has_previous_) {
    while (true) {
      const double t_s = (static_cast<double>(frames_) + phase_) / config_.rate_Hz;
      if (t_s > state.t_s) break;
      const double share = std::clamp((t_s - previous_t_s_) / (state.t_s - previous_t_s_), 0.0, 1.0);
      take({slerp(previous_.rotation, now.rotation, share), lerp(previous_.translation_m, now.translation_m, share)},
           t_s);
    }
  }
  has_previous_ = true;
  previous_t_s_ = state.t_s;
  previous_ = now;
}

void TrackerSampler::take(const Pose& T_world_marker, double t_s) {
  ++frames_;
  const SimulatedTrackerNoise noise = simulated_tracker_noise(config_, T_world_marker);
  Eigen::Vector3d position_m = noise.world_from_ray * noise.position_m.cwiseProduct(normal_vector(noise_));
  Eigen::Vector3d rotation_rad = noise.world_from_ray * noise.rotation_rad.cwiseProduct(normal_vector(noise_));
  if (config_.slow_share > 0.0) {
    Eigen::Matrix<double, 6, 1> slow;
    for (std::size_t axis = 0; axis < 6; ++axis)
      slow[static_cast<Eigen::Index>(axis)] = slow_[axis].next(1.0 / config_.rate_Hz, slow_random_);
    slow *= config_.slow_share;
    position_m += noise.world_from_ray * noise.position_m.cwiseProduct(slow.head<3>());
    rotation_rad += noise.world_from_ray * noise.rotation_rad.cwiseProduct(slow.tail<3>());
  }
  const double flip_shift_m = config_.flip_depth_m * noise_.normal();
  const double with_slow = 1.0 + config_.slow_share * config_.slow_share;
  sum_position_m2_ += with_slow * (noise.world_from_ray.cwiseAbs2() * noise.position_m.cwiseAbs2());
  sum_rotation_rad2_ += with_slow * (noise.world_from_ray.cwiseAbs2() * noise.rotation_rad.cwiseAbs2());
  double stamp_s = t_s + config_.latency_s + config_.clock_jitter_s * clock_.normal();

  if (config_.clock_wander_s > 0.0) stamp_s += wander_.next(1.0 / config_.rate_Hz, wander_random_);

  if (lost_left_ == 0 && faults_.chance(config_.dropout_chance))
    lost_left_ = run_length(config_.dropout_frames, faults_);
  if (flipped_left_ == 0 && faults_.chance(config_.flip_chance))
    flipped_left_ = run_length(config_.flip_frames, faults_);
  const bool flipped = flipped_left_ > 0;
  if (flipped) --flipped_left_;
  if (lost_left_ > 0) {
    --lost_left_;
    return;
  }
  Pose seen = T_world_marker;
  if (flipped) {
    seen = flipped_pose(seen);
    seen.translation_m += flip_shift_m * ray(T_world_marker);
    ++flips;
  }
  seen.translation_m += position_m;
  seen.rotation = (exp_rotation(rotation_rad) * seen.rotation).normalized();

  const auto step_ns = std::max<std::int64_t>(1, std::llround(config_.clock_step_s * 1e9));
  std::int64_t stamp = start_ns_ + std::llround(stamp_s * 1e9);
  stamp -= stamp % step_ns;
  if (!poses.t_ns.empty()) stamp = std::max(stamp, poses.t_ns.back() + step_ns);
  poses.t_ns.push_back(stamp);
  poses.T_world_marker.push_back(seen);
}

Eigen::Vector3d TrackerSampler::rms_position_m() const {
  return (sum_position_m2_ / static_cast<double>(std::max<std::int64_t>(1, frames_))).cwiseSqrt();
}

Eigen::Vector3d TrackerSampler::rms_rotation_rad() const {
  return (sum_rotation_rad2_ / static_cast<double>(std::max<std::int64_t>(1, frames_))).cwiseSqrt();
}

}  // namespace asperity
