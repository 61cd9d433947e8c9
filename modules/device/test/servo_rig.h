#pragma once

#include <algorithm>
#include <atomic>
#include <memory>
#include <vector>

#include "asperity/device/servo_loop.h"
#include "fake_device.h"

namespace asperity {

// A wall z < 0 of the config's stiffness.
inline ServoOutput wall_step(const RenderModel& model, ServoState& /*state*/, const DeviceState& device) noexcept {
  ServoOutput output;
  output.contact_N.z() = model.config.stiffness_N_per_m * std::max(-device.p_world_m.z(), 0.0);
  output.force_N = output.contact_N;
  return output;
}

inline std::unique_ptr<const RenderModel> wall(double stiffness_N_per_m) {
  auto model = std::make_unique<RenderModel>();
  model->config.stiffness_N_per_m = stiffness_N_per_m;
  return model;
}

struct Recorded {
  ServoResult result;
  std::vector<ServoTick> ticks;
};

inline Recorded run(FakeDevice& device, const ServoConfig& config) {
  SnapshotExchange<const RenderModel> scene(wall(1000.0));
  const std::atomic<bool> stop{false};
  Recorded all;
  all.result = run_servo(
      device, scene, config, stop, [&](const ServoTick& t) { all.ticks.push_back(t); }, wall_step);
  return all;
}

inline ServoConfig unpaced(double duration_s) {
  ServoConfig config;
  config.paced = false;
  config.duration_s = duration_s;
  return config;
}

// Presses with 1 N.
inline Eigen::Vector3d pressed(std::uint64_t /*read*/) { return {0.0, 0.0, -1e-3}; }

}  // namespace asperity
