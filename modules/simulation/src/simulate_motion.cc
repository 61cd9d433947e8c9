#include "asperity/simulation/simulate_motion.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/simulation/probe_sampler.h"
#include "asperity/simulation/probe_truth.h"
#include "asperity/simulation/tracker_sampler.h"

namespace asperity {

Recording simulate_motion(const SimulationConfig& config, const MotionFunction& motion, double duration_s,
                          const std::string& object, const Observer& observer) {
  constexpr std::int64_t kStart_ns = 1'000'000'000;
  constexpr std::int64_t kStepsPerUpdate = 8192;
  constexpr double kLongest_s = 1800.0;
  if (!(duration_s > 0.0 && duration_s <= kLongest_s))
    throw Error(fmt::format("a motion of {} s cannot be simulated: at most {} s", duration_s, kLongest_s));
  if (config.probe.true_rate_Hz * config.step_s > 1.0)
    throw Error(fmt::format("simulation.probe.true_rate_Hz: {} is faster than one sample a step of {} s",
                            config.probe.true_rate_Hz, config.step_s));
  const auto seed = static_cast<std::uint64_t>(config.seed);
  const Calibration truth = make_probe_truth(config.probe, config.tracker, seed);
  ProbeSampler probe(config, truth, kStart_ns);
  TrackerSampler tracker(config, kStart_ns);
  const auto steps = static_cast<std::int64_t>(std::llround(duration_s / config.step_s));
  for (std::int64_t i = 0; i <= steps; ++i) {
    if (i % kStepsPerUpdate == 0) observer.update("simulate", static_cast<double>(i) / static_cast<double>(steps));
    MotionState state = motion(static_cast<double>(i) * config.step_s);
    state.t_s = static_cast<double>(i) * config.step_s;
    probe.push(state);
    tracker.push(state);
  }
  probe.finish();

  Recording recording;
  SimulatedCalibrationConfig exact;
  exact.imperfection = 0.0;
  recording.calibration =
      make_stated_calibration(truth, config.probe, exact, tracker.rms_position_m(), tracker.rms_rotation_rad(), seed);
  recording.calibration.tip_radius_m = config.contact.tip_radius_m;
  recording.probe = std::move(probe.samples);
  recording.tracker = std::move(tracker.poses);
  recording.truth = std::move(probe.truth);
  RecordingInfo& info = recording.info;
  info.created = "2000-01-01T00:00:00Z";
  info.object = object;
  info.probe_model = std::string(kProbeModelNames[static_cast<std::size_t>(config.probe.model)]);
  info.probe_rate_Hz = config.probe.nominal_rate_Hz;
  info.adc_min = config.probe.adc_min;
  info.adc_max = config.probe.adc_max;
  info.tracker_rate_Hz = config.tracker.rate_Hz;
  info.gravity_world_mps2 = Eigen::Vector3d(config.gravity_world_mps2.data());
  info.segments = {{object, kStart_ns, kStart_ns + std::llround(duration_s * 1e9)}};
  info.simulation.emplace();
  observer.update("simulate", 1.0);
  return recording;
}

SimulationConfig without_link_faults(const SimulationConfig& config) {
  SimulationConfig out = config;
  out.probe.clock_jitter_s = 0.0;
  out.probe.clock_step_s = 0.0;
  out.probe.delivery_delay_s = 0.0;
  out.probe.dropout_chance = 0.0;
  out.probe.spike_chance = 0.0;
  out.tracker.clock_jitter_s = 0.0;
  out.tracker.clock_step_s = 0.0;
  out.tracker.dropout_chance = 0.0;
  out.tracker.flip_chance = 0.0;
  out.calibration.imperfection = 0.0;
  return out;
}

}  // namespace asperity
