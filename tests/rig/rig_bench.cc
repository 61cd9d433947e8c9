#include "rig_bench.h"

#include "asperity/simulation/probe_truth.h"
#include "asperity/simulation/simulate_recording.h"

namespace asperity {

namespace {

// Each seed of the bench has a probe of its own. One rig is one probe and one calibration: the calibration that errs of
// stroke i's probe as `stated` does of the first one's.
template <class Sensor>
void carry_over(const Sensor& truth, const Sensor& first_truth, const Sensor& stated, Sensor& out) {
  const Eigen::Matrix3d change = truth.B * first_truth.B.inverse();
  const Eigen::Matrix3d B = change * stated.B;
  const Eigen::Vector3d C = truth.C - change * (first_truth.C - stated.C);
  out = stated;
  out.B = B;
  out.C = C;
}

Calibration same_errors(const Calibration& truth, const Calibration& first_truth, const Calibration& stated) {
  Calibration out = stated;
  carry_over(truth.accelerometer, first_truth.accelerometer, stated.accelerometer, out.accelerometer);
  carry_over(*truth.gyroscope, *first_truth.gyroscope, *stated.gyroscope, *out.gyroscope);
  out.force.offset_newton += truth.force.offset_newton - first_truth.force.offset_newton;
  return out;
}

}  // namespace

std::vector<NamedRecording> grating_strokes(int count, std::uint64_t seed, const std::function<void(Recording&)>& wrong,
                                            const std::function<void(SimulationConfig&)>& change) {
  std::vector<NamedRecording> out;
  Calibration first_calibration;
  Eigen::Vector3d first_gravity = Eigen::Vector3d::Zero();
  for (int i = 0; i < count; ++i) {
    SimulationConfig config = make_simulation_config("sine", "open");
    config.seed = static_cast<std::int64_t>(seed) + i;
    config.hand.length_m = 0.05;
    if (change) change(config);
    Recording recording = simulate_recording(config);
    recording.truth.reset();
    const auto truth = [&](std::uint64_t of) { return make_probe_truth(config.probe, config.tracker, of); };
    if (i > 0) {
      recording.calibration = same_errors(truth(seed + static_cast<std::uint64_t>(i)), truth(seed), first_calibration);
      recording.info.gravity_world_mps2 = first_gravity;
    }
    if (i == 0) {
      first_calibration = recording.calibration;
      first_gravity = recording.info.gravity_world_mps2;
    }
    if (wrong) wrong(recording);
    out.push_back({"stroke_" + std::to_string(i + 1), std::move(recording)});
  }
  return out;
}

}  // namespace asperity
