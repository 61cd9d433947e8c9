#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "asperity/device/haptic_device.h"

namespace asperity {

// A device whose every reading is a function of how often it was read. Unless told otherwise it has news at each.
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

}  // namespace asperity
