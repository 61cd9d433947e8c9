#include "hand_motion.h"

#include <algorithm>
#include <cmath>

#include "noise_sources.h"
#include "relief.h"
#include "turn_by.h"

namespace second_bench {

namespace {

using Kind = Section<double>::Kind;

double smooth_step(double u) {
  const double c = std::clamp(u, 0.0, 1.0);
  return c * c * c * (10.0 + c * (6.0 * c - 15.0));
}

// A C² random function of time: a cubic B-spline with filtered noise as its control points, 500 a second.
class SmoothNoise {
 public:
  SmoothNoise(double duration_s, Kind kind, double f0_Hz, double q, double rms, Dice& dice)
      : points_(
            filtered_noise(static_cast<std::size_t>(duration_s * kRate_Hz) + 8, kRate_Hz, kind, f0_Hz, q, rms, dice)) {}

  double at(double t_s) const {
    const double place = std::max(0.0, t_s) * kRate_Hz;
    const auto i = std::min(static_cast<std::size_t>(place), points_.size() - 4);
    const double u = place - static_cast<double>(i), w = 1.0 - u;
    return (w * w * w * points_[i] + (3.0 * u * u * u - 6.0 * u * u + 4.0) * points_[i + 1] +
            (3.0 * w * w * w - 6.0 * w * w + 4.0) * points_[i + 2] + u * u * u * points_[i + 3]) /
           6.0;
  }

 private:
  static constexpr double kRate_Hz = 500.0;
  std::vector<double> points_;
};

// When the hand travels: one stroke, or two with a rest between.
struct Schedule {
  double ramp_s = 0.3, start_s = 0.0, pause_s = 0.0, resume_s = 0.0, end_s = 0.0, whole_s = 0.0;

  explicit Schedule(const ScanPlan& plan) {
    const double travel_s = plan.length_m / plan.speed_mps;
    start_s = plan.rest_before_s + plan.approach_s;
    const bool pauses = plan.rest_middle_s > 0.0;
    pause_s = start_s + 0.5 * travel_s + ramp_s;
    resume_s = pauses ? pause_s + plan.rest_middle_s : pause_s;
    end_s = start_s + travel_s + ramp_s + (pauses ? plan.rest_middle_s + ramp_s : 0.0);
    whole_s = end_s + plan.rest_after_s;
    if (!pauses) pause_s = resume_s = -1.0;
  }
  double open(double t_s) const {
    const double ends = smooth_step((t_s - start_s) / ramp_s) * smooth_step((end_s - t_s) / ramp_s);
    if (pause_s < 0.0) return ends;
    return ends * std::max(smooth_step((pause_s - t_s) / ramp_s), smooth_step((t_s - resume_s) / ramp_s));
  }
};

// The base: a plane or a cylinder whose axis lies across the path, a measured from its middle.
class Base {
 public:
  explicit Base(const ScanPlan& plan) : plan_(plan), across_(plan.normal.cross(plan.along)) {}

  Eigen::Vector3d normal(double a_m) const {
    if (plan_.radius_m <= 0.0) return plan_.normal;
    const double turn = a_m / plan_.radius_m;
    return std::cos(turn) * plan_.normal + std::sin(turn) * plan_.along;
  }
  Eigen::Vector3d tangent(double a_m) const {
    if (plan_.radius_m <= 0.0) return plan_.along;
    const double turn = a_m / plan_.radius_m;
    return std::cos(turn) * plan_.along - std::sin(turn) * plan_.normal;
  }
  Eigen::Vector3d point(double a_m, double v_m, double h_m) const {
    const Eigen::Vector3d aside = plan_.centre_m + v_m * across_;
    if (plan_.radius_m <= 0.0) return aside + a_m * plan_.along + h_m * plan_.normal;
    return aside - plan_.radius_m * plan_.normal + (plan_.radius_m + h_m) * normal(a_m);
  }
  Eigen::Quaterniond followed(double a_m) const {
    if (plan_.radius_m <= 0.0) return Eigen::Quaterniond::Identity();
    return Eigen::Quaterniond(Eigen::AngleAxisd(plan_.follow_normal * a_m / plan_.radius_m, across_));
  }

 private:
  const ScanPlan& plan_;
  Eigen::Vector3d across_;
};

// One axis of a mass.
struct Mass {
  double x = 0.0, v = 0.0;
  void push(double force_N, double mass_kg) {
    v += force_N / mass_kg * kStep_s;
    x += v * kStep_s;
  }
};

double contact_N(const ScanPlan& plan, double depth_m, double rate_mps) {
  if (depth_m <= 0.0) return 0.0;
  if (plan.contact == Contact::kKelvinVoigt)
    return std::max(0.0, plan.contact_stiffness * depth_m + plan.contact_damping * rate_mps);
  const double elastic_N = plan.contact_stiffness * depth_m * std::sqrt(depth_m);
  return std::max(0.0, elastic_N * (1.0 + plan.contact_damping * rate_mps));
}

double depth_at(const ScanPlan& plan, double force_N) {
  const double ratio = force_N / plan.contact_stiffness;
  return plan.contact == Contact::kKelvinVoigt ? ratio : std::pow(ratio, 2.0 / 3.0);
}

// The commanded arc length, scaled to end at the plan's.
std::vector<double> commanded_speed(const ScanPlan& plan, const Schedule& schedule, std::size_t steps, Dice& dice) {
  const SmoothNoise variation(schedule.whole_s, Kind::kLowPass, 0.8, 0.7, plan.speed_variation, dice);
  std::vector<double> out(steps);
  double way_m = 0.0;
  for (std::size_t i = 0; i < steps; ++i) {
    const double t_s = static_cast<double>(i) * kStep_s;
    out[i] = plan.speed_mps * schedule.open(t_s) * std::max(0.15, 1.0 + variation.at(t_s));
    way_m += out[i] * kStep_s;
  }
  for (double& v : out) v *= plan.length_m / way_m;
  return out;
}

}  // namespace

HandMotion move_hand(const ScanPlan& plan) {
  constexpr double kMargin_m = 4e-3;
  constexpr double kHalfWidth_m = 0.5e-3;
  constexpr double kAbove_m = 6e-3;     // where the approach begins
  constexpr double kTakesOver_s = 0.3;  // in which the hand makes the height it meets its own
  constexpr double kStickBand_mps = 2e-4;
  const Schedule schedule(plan);
  const RollingTip tip(plan, kMargin_m, kHalfWidth_m);
  const Base base(plan);
  const bool air = plan.family == "air";
  const auto steps = static_cast<std::size_t>(schedule.whole_s / kStep_s);

  Dice dice(plan.seed, 21);
  const std::vector<double> speed = commanded_speed(plan, schedule, steps, dice);
  const double T = schedule.whole_s;
  const SmoothNoise press(T, Kind::kLowPass, 0.7, 0.7, plan.force_variation, dice);
  const SmoothNoise tremor_along(T, Kind::kBandPass, plan.tremor_Hz, 3.0, plan.tremor_N, dice);
  const SmoothNoise tremor_down(T, Kind::kBandPass, plan.tremor_Hz, 3.0, plan.tremor_N, dice);
  const SmoothNoise aside(T, Kind::kLowPass, 0.4, 0.7, plan.lateral_m, dice);
  const SmoothNoise aside_tremor(T, Kind::kBandPass, plan.tremor_Hz, 3.0, 0.4 * plan.lateral_m, dice);
  std::vector<SmoothNoise> wander, shake;
  for (int axis = 0; axis < 3; ++axis) {
    wander.emplace_back(T, Kind::kLowPass, 0.4, 0.7, plan.turn_rad, dice);
    shake.emplace_back(T, Kind::kBandPass, plan.tremor_Hz, 3.0, 0.04 * plan.turn_rad, dice);
  }
  const double waved_m = air ? 8e-3 : 0.0;
  const SmoothNoise wave(T, Kind::kLowPass, 1.0, 0.7, waved_m, dice);

  // The body's lowest point of the ball at the mean attitude, from the ball's centre.
  const Eigen::Quaterniond mean_attitude = turn_by(plan.tilt_rad);
  const Eigen::Vector3d down_in_marker = mean_attitude.conjugate() * -plan.normal;
  const double half_m = 0.5 * plan.length_m;

  Mass probe_along, probe_up, hand_along, hand_up;
  const bool from_air = plan.approach_s > 0.0 || air;
  const double first_N = from_air ? 0.0 : plan.force_from_N;
  const double ground_m = tip.at(0.0, aside.at(0.0) + aside_tremor.at(0.0)).z_m;
  probe_up.x = ground_m + (from_air ? kAbove_m : -depth_at(plan, first_N));
  hand_up.x = probe_up.x - first_N / plan.grip_N_per_m;
  double own_m = from_air ? ground_m : hand_up.x;  // the height that the hand takes for its own
  double command_m = 0.0;

  HandMotion out;
  out.s_m.reserve(steps);
  out.height_m.reserve(steps);
  out.normal_N.reserve(steps);
  out.p_world_tip_m.reserve(steps);
  out.q_world_marker.reserve(steps);
  out.contact_world_N.reserve(steps);
  for (std::size_t i = 0; i < steps; ++i) {
    const double t_s = static_cast<double>(i) * kStep_s;
    const double v_m = aside.at(t_s) + aside_tremor.at(t_s);
    const RollingTip::Stand stand = air ? RollingTip::Stand{-1.0, 0.0} : tip.at(probe_along.x, v_m);
    const double cosine = 1.0 / std::sqrt(1.0 + stand.slope * stand.slope), sine = stand.slope * cosine;
    const double depth_m = (stand.z_m - probe_up.x) * cosine;
    const double rate_mps = (stand.slope * probe_along.v - probe_up.v) * cosine;
    const double normal_N = contact_N(plan, depth_m, rate_mps);

    const double grip_along_N =
        plan.grip_N_per_m * (hand_along.x - probe_along.x) + plan.grip_N_s_per_m * (hand_along.v - probe_along.v);
    const double grip_up_N =
        plan.grip_N_per_m * (hand_up.x - probe_up.x) + plan.grip_N_s_per_m * (hand_up.v - probe_up.v);
    // Coulomb: as much as stops the tip within a step, at most what the load allows.
    const double sliding_mps = probe_along.v * cosine + probe_up.v * sine;
    const double pulled_N = grip_along_N * cosine + grip_up_N * sine;
    const double coefficient = std::abs(sliding_mps) < kStickBand_mps ? plan.friction_static : plan.friction_sliding;
    const double stopping_N = plan.probe_mass_kg * sliding_mps / kStep_s + pulled_N;
    const double friction_N = -std::clamp(stopping_N, -coefficient * normal_N, coefficient * normal_N);
    const double along_N = -sine * normal_N + cosine * friction_N;
    const double up_N = cosine * normal_N + sine * friction_N;

    const double a_m = probe_along.x - half_m;
    const Eigen::Vector3d turn_rad(wander[0].at(t_s) + shake[0].at(t_s), wander[1].at(t_s) + shake[1].at(t_s),
                                   wander[2].at(t_s) + shake[2].at(t_s));
    Eigen::Quaterniond q = base.followed(hand_along.x - half_m) * mean_attitude * turn_by(turn_rad);
    q.normalize();
    const Eigen::Vector3d centre = base.point(a_m, v_m, probe_up.x + plan.tip_radius_m);
    out.s_m.push_back(probe_along.x);
    out.height_m.push_back(probe_up.x);
    out.normal_N.push_back(normal_N);
    out.p_world_tip_m.push_back(centre + q * (plan.tip_radius_m * down_in_marker));
    out.q_world_marker.push_back(q);
    out.contact_world_N.push_back(up_N * base.normal(a_m) + along_N * base.tangent(a_m));

    const double share = std::clamp((t_s - schedule.start_s) / (schedule.end_s - schedule.start_s), 0.0, 1.0);
    const double down = plan.approach_s > 0.0 ? smooth_step((t_s - plan.rest_before_s) / (0.7 * plan.approach_s)) : 1.0;
    const double pressing =
        plan.approach_s > 0.0
            ? smooth_step((t_s - plan.rest_before_s - 0.7 * plan.approach_s) / (0.3 * plan.approach_s))
            : 1.0;
    const double lift_m = air ? kAbove_m + 8e-3 + wave.at(t_s) : kAbove_m * (1.0 - down);
    const double set_N = air ? 0.0
                             : pressing * (plan.force_from_N + share * (plan.force_to_N - plan.force_from_N)) *
                                   std::max(0.2, 1.0 + press.at(t_s));
    const double arm_along_N = 5.0 * plan.arm_N_per_m * (command_m - hand_along.x) +
                               2.0 * plan.arm_N_s_per_m * (speed[i] - hand_along.v) + tremor_along.at(t_s);
    const double arm_up_N =
        -set_N - plan.arm_N_per_m * (hand_up.x - own_m - lift_m) - plan.arm_N_s_per_m * hand_up.v + tremor_down.at(t_s);
    if (pressing >= 1.0 && !air) own_m += (hand_up.x - own_m) * kStep_s / kTakesOver_s;
    command_m += speed[i] * kStep_s;
    probe_along.push(grip_along_N + along_N, plan.probe_mass_kg);
    probe_up.push(grip_up_N + up_N, plan.probe_mass_kg);
    hand_along.push(arm_along_N - grip_along_N, plan.hand_mass_kg);
    hand_up.push(arm_up_N - grip_up_N, plan.hand_mass_kg);
  }
  return out;
}

std::vector<double> filtered_noise(std::size_t count, double rate_Hz, Section<double>::Kind kind, double f0_Hz,
                                   double q, double rms, Dice& dice) {
  Section<double> first(kind, f0_Hz, q, rate_Hz), second(kind, f0_Hz, q, rate_Hz);
  const auto settle = static_cast<std::size_t>(3.0 * q / f0_Hz * rate_Hz);
  std::vector<double> out;
  out.reserve(count);
  for (std::size_t i = 0; i < settle + count; ++i) {
    const double value = second.push(first.push(dice.normal()));
    if (i >= settle) out.push_back(value);
  }
  // By the filters' own gain, not by this piece: a slow wave seen for a moment is no larger for it.
  Section<double> gain_first(kind, f0_Hz, q, rate_Hz), gain_second(kind, f0_Hz, q, rate_Hz);
  double power = 0.0;
  for (std::size_t i = 0; i < 4 * settle + 64; ++i) {
    const double response = gain_second.push(gain_first.push(i == 0 ? 1.0 : 0.0));
    power += response * response;
  }
  for (double& value : out) value *= rms / std::sqrt(power);
  return out;
}

double tangent_stiffness_N_per_mm(const ScanPlan& plan) {
  if (plan.contact == Contact::kKelvinVoigt) return 1e-3 * plan.contact_stiffness;
  const double mean_N = 0.5 * (plan.force_from_N + plan.force_to_N);
  return 1e-3 * 1.5 * plan.contact_stiffness * std::sqrt(depth_at(plan, mean_N));
}

}  // namespace second_bench
