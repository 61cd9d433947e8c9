#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "asperity/device/haptic_device.h"
#include "asperity/device/servo_loop.h"

namespace asperity {

// A device whose every reading is a function of how often it was read. By default each reading is new.
class FakeDevice : public HapticDevice {
 public:
  std::function<Eigen::Vector3d(std::uint64_t)> path;
  std::function<void(std::uint64_t, DeviceReading&)> meddle;  // after the reading was made
  DeviceInfo device_info;
  Eigen::Vector3d force_N = Eigen::Vector3d::Constant(1e9);  // last written
  std::uint64_t reads = 0;
  std::uint64_t writes = 0;
  bool closed = false;

  const DeviceInfo& info() const noexcept override { return device_info; }
  DeviceReading read(std::int64_t /*t_ns*/) noexcept override {
    DeviceReading reading;
    reading.sequence = reads + 1;
    if (path) {
      reading.p_m = path(reads);
      reading.v_mps = (path(reads) - path(reads > 0 ? reads - 1 : 0)) * device_info.rate_Hz;
    }
    if (meddle) meddle(reads, reading);
    ++reads;
    return reading;
  }
  void write(const Eigen::Vector3d& force) noexcept override {
    force_N = force;
    ++writes;
  }
  void close() noexcept override {
    force_N.setZero();
    closed = true;
  }
  std::string fault() const override { return ""; }
};

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
