#include "asperity/simulation/probe_motion.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "asperity/geometry/pose.h"
#include "asperity/simulation/base_shape.h"
#include "streams.h"

namespace asperity {
namespace {

ScanPath make_path(const SimulationConfig& config) {
  const std::int64_t seed = config.hand.path_seed != 0 ? config.hand.path_seed : config.seed;
  Random random(static_cast<std::uint64_t>(seed), stream(Stream::kPath));
  return {config.hand, random};
}

}  // namespace

ProbeMotion::ProbeMotion(const SimulationConfig& config, const Surface& surface)
    : ProbeMotion(config, surface, std::make_shared<SimulatedShape>(config.shape, config.hand.follow_normal)) {}

ProbeMotion::ProbeMotion(const SimulationConfig& config, const Surface& surface, std::shared_ptr<const ScanBase> base)
    : config_(config),
      base_(std::move(base)),
      path_(make_path(config)),
      hand_(config.hand, path_.length_m(), config.step_s, static_cast<std::uint64_t>(config.seed)),
      profile_(surface, *base_, path_, config.contact, hand_.greatest_force_N()),
      mean_tilt_(exp_rotation(Eigen::Vector3d(config.hand.tilt_rad.data()))),
      damping_Ns_per_m_(2.0 * config.contact.damping_ratio *
                        std::sqrt(config.contact.stiffness_N_per_m * config.hand.normal_mass_kg)) {
  // The hand rests on the object before time begins.
  Hand first = hand_;
  const HandState start = first.next();
  const double indentation_m = start.force_N / config.contact.stiffness_N_per_m;
  s_m_ = start.s_m + start.along_m;
  const ScanPoint point = path_.at(s_m_);
  aside_m_ = ground_aside_m(point, point.a_m - start.lateral_m * std::sin(point.angle_rad),
                            point.v_m + start.lateral_m * std::cos(point.angle_rad));
  height_m_ = profile_.at(s_m_, indentation_m).height_m + aside_m_ - indentation_m;
  rest_height_m_ = height_m_ - start.tremor_m;
  // Set down on a slope, the tip slides until friction and the hand's spring hold it, within some 0.2 s.
  constexpr double kSettling_s = 0.5;
  const auto steps = static_cast<std::int64_t>(std::ceil(kSettling_s / config.step_s));
  for (std::int64_t i = 0; i < steps; ++i) step(start);
}

double ProbeMotion::ground_aside_m(const ScanPoint& on_path, double a_m, double v_m) {
  const Ground path = base_->ground(on_path.a_m, on_path.v_m);
  const Ground aside = base_->ground(a_m, v_m);
  // Beyond a mesh's border both stay as they were.
  if (path.found && aside.found) {
    ground_on_path_ = path;
    ground_aside_ = aside;
  }
  return ground_aside_.height_m - ground_on_path_.height_m;
}

MotionState ProbeMotion::next() { return step(hand_.next()); }

MotionState ProbeMotion::step(const HandState& hand) {
  const SimulatedContactConfig& contact = config_.contact;
  const ScanPoint point = path_.at(s_m_);
  const double cosine = std::cos(point.angle_rad);
  const double sine = std::sin(point.angle_rad);
  const double a_m = point.a_m - hand.lateral_m * sine;
  const double v_m = point.v_m + hand.lateral_m * cosine;

  const ContactProfile::Value relief = profile_.at(s_m_, hand.force_N / contact.stiffness_N_per_m);
  const double aside_m = ground_aside_m(point, a_m, v_m);
  const double indentation_m = relief.height_m + aside_m - height_m_;
  const double rate_mps = relief.slope * v_s_mps_ + (aside_m - aside_m_) / config_.step_s - v_h_mps_;
  aside_m_ = aside_m;
  force_N_ = indentation_m > 0.0
                 ? std::max(0.0, contact.stiffness_N_per_m * indentation_m + damping_Ns_per_m_ * rate_mps)
                 : 0.0;
  slope_ = relief.slope;

  // LuGre friction per newton (Canudas de Wit et al., 1995); the bristle's own decay is taken implicitly,
  // which stays stable at any speed.
  const double ratio = v_s_mps_ / contact.friction_stribeck_mps;
  const double level =
      contact.friction_dynamic + (contact.friction_static - contact.friction_dynamic) * std::exp(-ratio * ratio);
  double coefficient = contact.friction_viscous_s_per_m * v_s_mps_;
  if (level > 0.0) {
    const double before_m = bristle_m_;
    bristle_m_ = (before_m + v_s_mps_ * config_.step_s) /
                 (1.0 + contact.friction_bristle_per_m * std::abs(v_s_mps_) * config_.step_s / level);
    coefficient += contact.friction_bristle_per_m * bristle_m_ +
                   contact.friction_bristle_damping_s_per_m * (bristle_m_ - before_m) / config_.step_s;
  }
  friction_N_ = force_N_ * coefficient;

  MotionState state;
  state.t_s = hand.t_s;
  state.s_m = s_m_;
  state.height_m = height_m_;
  state.normal_force_N = force_N_;
  state.friction_N = friction_N_;
  state.p_world_tip_m = base_->point_m(a_m, v_m, height_m_);
  const Eigen::Vector3d direction = cosine * base_->along(a_m) + sine * base_->across(a_m);
  state.contact_force_world_N = force_N_ * base_->normal(a_m) - (friction_N_ + force_N_ * slope_) * direction;
  // The orientation follows the hand, not the tip: stick and slip does not turn the probe.
  state.q_world_marker = base_->turn(path_.at(hand.s_m).a_m) * mean_tilt_ * exp_rotation(hand.rotation_rad);
  state.q_world_marker.normalize();

  advance(hand);
  return state;
}

void ProbeMotion::advance(const HandState& hand) {
  const HandConfig& h = config_.hand;
  const double step_s = config_.step_s;
  const double hand_N = hand.force_N +
                        h.normal_stiffness_N_per_m * (height_m_ - rest_height_m_ - hand.lift_m - hand.tremor_m) +
                        h.normal_damping_N_s_per_m * v_h_mps_;
  const double pull_N = h.tangential_stiffness_N_per_m * (hand.s_m + hand.along_m - s_m_) +
                        h.tangential_damping_N_s_per_m * (hand.v_mps - v_s_mps_);
  if (!hand.lifting) rest_height_m_ += (height_m_ - rest_height_m_) * step_s / h.normal_adaptation_s;

  v_h_mps_ += (force_N_ - hand_N) / h.normal_mass_kg * step_s;
  height_m_ += v_h_mps_ * step_s;
  v_s_mps_ += (pull_N - friction_N_ - force_N_ * slope_) / h.tangential_mass_kg * step_s;
  s_m_ += v_s_mps_ * step_s;
}

}  // namespace asperity
