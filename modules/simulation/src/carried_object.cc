#include "asperity/simulation/carried_object.h"

#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/simulation/random_wave.h"
#include "septic_step.h"
#include "streams.h"

namespace asperity {

namespace {

constexpr double kNode_s = 1e-3;  // beyond 50 Hz a hand does not move
constexpr double kSlowestDrift_Hz = 0.05;

}  // namespace

CarriedObject::CarriedObject(const SimulationConfig& config, double duration_s)
    : pivot_m_(config.shape.centre_m.data()) {
  const SimulatedObjectConfig& object = config.object;
  if (object.tremor_low_Hz > object.tremor_high_Hz) {
    throw Error(fmt::format("simulation.object.tremor_low_Hz: {} is above tremor_high_Hz {}", object.tremor_low_Hz,
                            object.tremor_high_Hz));
  }
  T_start_body_.translation_m = pivot_m_ + Eigen::Vector3d(object.body_m.data());
  Random random(static_cast<std::uint64_t>(config.seed), stream(Stream::kObjectMotion));
  std::array<RandomWave, 6> drift, tremor;
  for (std::size_t axis = 0; axis < 6; ++axis) {
    const bool turns = axis >= 3;
    drift[axis] =
        RandomWave(turns ? object.drift_rad : object.drift_m, kSlowestDrift_Hz, object.drift_Hz, kNode_s, random);
    tremor[axis] = RandomWave(turns ? object.tremor_rad : object.tremor_m, object.tremor_low_Hz, object.tremor_high_Hz,
                              kNode_s, random);
  }
  const auto nodes = static_cast<std::size_t>(std::ceil(duration_s / kNode_s)) + 2;
  std::vector<Eigen::Matrix<double, 6, 1>> path(nodes, Eigen::Matrix<double, 6, 1>::Zero());
  const Eigen::Vector3d turn_rad = object.motion == SimulatedObjectMotion::kTurned
                                       ? Eigen::Vector3d(object.turn_rad.data())
                                       : Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < nodes; ++i) {
    for (std::size_t axis = 0; axis < 6; ++axis)
      path[i][static_cast<Eigen::Index>(axis)] = drift[axis].next() + tremor[axis].next();
    path[i].tail<3>() += septic_step(static_cast<double>(i) * kNode_s / duration_s) * turn_rad;
  }
  const Eigen::Matrix<double, 6, 1> first = path.front();
  for (auto& node : path) node -= first;
  path_ = UniformSpline<6>(std::move(path), 0.0, kNode_s);
}

Pose CarriedObject::T_world_start(double t_s) const {
  const Eigen::Matrix<double, 6, 1> at = path_.value(t_s);
  const Eigen::Quaterniond R = exp_rotation(at.tail<3>());
  return {R, pivot_m_ + at.head<3>() - R * pivot_m_};
}

MotionState CarriedObject::carry(MotionState state) const {
  const Pose T = T_world_start(state.t_s);
  state.p_world_tip_m = T * state.p_world_tip_m;
  state.q_world_marker = (T.rotation * state.q_world_marker).normalized();
  state.contact_force_world_N = T.rotation * state.contact_force_world_N;
  return state;
}

MotionState CarriedObject::body_state(double t_s) const {
  const Pose T = T_world_body(t_s);
  MotionState out;
  out.t_s = t_s;
  out.p_world_tip_m = T.translation_m;
  out.q_world_marker = T.rotation;
  return out;
}

}  // namespace asperity
