#include "asperity/simulation/calibration_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <vector>

#include "asperity/base/random.h"
#include "asperity/simulation/true_motion.h"
#include "septic_step.h"
#include "streams.h"

namespace asperity {
namespace {

// A random function of time as in random_wave.h, read at any time.
class TimedWave {
 public:
  TimedWave(double rms, double low_Hz, double high_Hz, Random& random) {
    for (std::size_t i = 0; i < sines_.size(); ++i) {
      const double share = (static_cast<double>(i) + random.uniform()) / static_cast<double>(sines_.size());
      sines_[i].omega_radps = 2.0 * std::numbers::pi * (low_Hz + (high_Hz - low_Hz) * share);
      sines_[i].phase_rad = random.uniform(0.0, 2.0 * std::numbers::pi);
      sines_[i].amplitude = rms * std::sqrt(2.0 / static_cast<double>(sines_.size()));
    }
  }
  double at(double t_s) const {
    double sum = 0.0;
    for (const Sine& sine : sines_) sum += sine.amplitude * std::sin(sine.omega_radps * t_s + sine.phase_rad);
    return sum;
  }

 private:
  struct Sine {
    double amplitude = 0.0, omega_radps = 0.0, phase_rad = 0.0;
  };
  std::array<Sine, 8> sines_;
};

struct TimedWave3 {
  TimedWave3(double rms, double low_Hz, double high_Hz, Random& random)
      : x(rms, low_Hz, high_Hz, random), y(rms, low_Hz, high_Hz, random), z(rms, low_Hz, high_Hz, random) {}
  Eigen::Vector3d at(double t_s) const { return {x.at(t_s), y.at(t_s), z.at(t_s)}; }
  TimedWave x, y, z;
};

MotionState state_of(const Pose& T_world_marker, const Eigen::Vector3d& tip_in_marker_m) {
  MotionState state;
  state.p_world_tip_m = T_world_marker * tip_in_marker_m;
  state.q_world_marker = T_world_marker.rotation;
  return state;
}

Eigen::Vector3d random_direction(Random& random) {
  while (true) {
    const Eigen::Vector3d v(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
    const double length = v.norm();
    if (length > 0.1 && length <= 1.0) return v / length;
  }
}

}  // namespace

MotionFunction static_motion(const Pose& T_world_marker, const Eigen::Vector3d& tip_in_marker_m) {
  const MotionState state = state_of(T_world_marker, tip_in_marker_m);
  return [state](double) { return state; };
}

MotionFunction pivot_motion(const PivotMotion& pivot) {
  Random random(pivot.seed, stream(Stream::kCalibrationMotion));
  const auto swing = std::make_shared<TimedWave3>(pivot.swing_rad, 0.2 * pivot.highest_Hz, pivot.highest_Hz, random);
  return [pivot, swing](double t_s) {
    MotionState state;
    state.p_world_tip_m = pivot.p_world_tip_m;
    state.q_world_marker = exp_rotation(pivot.mean_rotation_rad) * exp_rotation(swing->at(t_s));
    state.normal_force_N = pivot.force_N;
    state.contact_force_world_N = state.q_world_marker * Eigen::Vector3d(0.0, -pivot.force_N, 0.0);
    return state;
  };
}

MotionFunction shake_motion(const ShakeMotion& shake, const Eigen::Vector3d& tip_in_marker_m) {
  Random random(shake.seed, stream(Stream::kCalibrationMotion));
  const auto shift = std::make_shared<TimedWave3>(shake.amplitude_m, shake.low_Hz, shake.high_Hz, random);
  const auto turn = std::make_shared<TimedWave3>(shake.rotation_rad, shake.low_Hz, shake.high_Hz, random);
  return [shake, shift, turn, tip_in_marker_m](double t_s) {
    const double share = septic_step((t_s - shake.rest_s) / shake.ramp_s);
    Pose T = shake.T_world_marker;
    T.translation_m += share * shift->at(t_s);
    T.rotation = T.rotation * exp_rotation(share * turn->at(t_s));
    return state_of(T, tip_in_marker_m);
  };
}

MotionFunction static_poses_motion(const StaticPosesMotion& poses, const Eigen::Vector3d& tip_in_marker_m) {
  Random random(poses.seed, stream(Stream::kCalibrationMotion));
  auto turns = std::make_shared<std::vector<Eigen::Quaterniond>>();
  for (int i = 0; i < poses.poses; ++i) {
    // Even over the ball of rotation vectors: few are near the mean.
    const double angle = poses.greatest_turn_rad * std::cbrt(random.uniform());
    turns->push_back(poses.T_world_marker.rotation * exp_rotation(angle * random_direction(random)));
  }
  return [poses, turns, tip_in_marker_m](double t_s) {
    const double period_s = poses.hold_s + poses.move_s;
    const auto last = static_cast<double>(turns->size() - 1);
    const double index = std::clamp(std::floor(t_s / period_s), 0.0, last);
    const auto here = static_cast<std::size_t>(index);
    const std::size_t next = std::min(here + 1, turns->size() - 1);
    const double share = septic_step((t_s - index * period_s - poses.hold_s) / poses.move_s);
    Pose T = poses.T_world_marker;
    T.rotation = slerp((*turns)[here], (*turns)[next], share);
    return state_of(T, tip_in_marker_m);
  };
}

std::vector<Eigen::Vector3d> static_specific_force_mps2(const Recording& bench, const std::vector<std::int64_t>& t_ns) {
  const TrueMotion motion(bench);
  std::vector<Eigen::Vector3d> out;
  out.reserve(t_ns.size());
  for (const std::int64_t t : t_ns)
    out.emplace_back(motion.T_world_marker(t).rotation.conjugate() * -bench.info.gravity_world_mps2);
  return out;
}

}  // namespace asperity
