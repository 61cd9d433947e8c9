#include "asperity/simulation/probe_device.h"

#include <asperity_firmware/probe.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <string>

#include "asperity/base/error.h"

namespace asperity {
namespace {

constexpr std::int64_t kLongestStep_ns = 2'000'000;

std::int32_t whole(double counts, double low, double high) {
  return static_cast<std::int32_t>(std::clamp(std::round(counts), low, high));
}

// The samples in time's order and the place that has been reached in them.
struct Samples {
  Samples(const Recording& recording, const ProbeClock& probe_clock) : stream(recording.probe), clock(probe_clock) {
    if (!recording.truth || recording.truth->size() != stream.size() || stream.size() == 0)
      throw Error("a probe can only send a recording that has its truth and all of its samples");
    t_ns = recording.truth->t_ns;
  }
  std::uint64_t device_ns(std::int64_t time_ns) const {
    const auto since_ns = static_cast<double>(time_ns - t_ns.front());
    return static_cast<std::uint64_t>(
        std::llround(std::max(0.0, clock.start_s * 1e9 + since_ns * (1.0 + 1e-6 * clock.fast_ppm))));
  }

  ProbeStream stream;
  std::vector<std::int64_t> t_ns;  // true
  ProbeClock clock;
};

class OpenDevice : public ProbeDevice {
 public:
  OpenDevice(const Recording& recording, const SimulatedProbeConfig& config, const ProbeClock& clock)
      : samples_(recording, clock), now_ns_(samples_.t_ns.front()) {
    board_.context = this;
    board_.clock_us = [](void* self) { return as_device(self).samples_.device_ns(as_device(self).now_ns_) / 1000; };
    board_.read_imu = [](void* self, asp_imu_row* rows, std::size_t capacity) {
      return as_device(self).read_rows(rows, capacity);
    };
    board_.read_force = [](void* self, asp_force_sample* sample) { return as_device(self).read_force(sample); };
    board_.write = [](void* self, const std::uint8_t* bytes, std::size_t count) {
      as_device(self).out_->insert(as_device(self).out_->end(), bytes, bytes + count);
      return count;
    };
    board_.read_host = [](void* self, std::uint8_t* bytes, std::size_t capacity) {
      return as_device(self).read_host(bytes, capacity);
    };
    // A data sheet's figures: what these very sensors do is the calibration's business.
    const Calibration& truth = recording.calibration;
    asp_description description{};
    description.name = "virtual bench";
    description.firmware = "1.0.0";
    description.rate_hz = config.nominal_rate_Hz;
    description.adc_min = static_cast<std::int32_t>(config.adc_min);
    description.adc_max = static_cast<std::int32_t>(config.adc_max);
    description.accel_counts_per_mps2 = truth.accelerometer.B.leftCols<3>().norm() / std::sqrt(3.0);
    description.has_gyro = samples_.stream.has_gyro();
    if (truth.gyroscope) description.gyro_counts_per_radps = truth.gyroscope->B.norm() / std::sqrt(3.0);
    description.force_axes = 1;
    description.force_rate_hz = config.force_rate_Hz;
    description.force_newton_per_count = truth.force.newton_per_count;
    if (!asp_probe_init(&probe_, &board_, &description, nullptr))
      throw Error(
          "the firmware refuses the description of the probe: a rate, range or scale is not in the protocol's range");
  }

  void advance(std::int64_t t_ns, std::vector<std::uint8_t>& out) override {
    out_ = &out;
    // Steps as short as a firmware's loop: its queues see what they would see.
    while (true) {
      now_ns_ = std::max(now_ns_, std::min(t_ns, now_ns_ + kLongestStep_ns));
      while (asp_probe_step(&probe_)) {
      }
      if (now_ns_ >= t_ns) break;
    }
    out_ = nullptr;
  }

  void receive(std::span<const std::uint8_t> bytes) override {
    constexpr std::size_t kMost = 4096;
    for (const std::uint8_t byte : bytes) {
      if (heard_.size() < kMost) heard_.push_back(byte);
    }
  }

 private:
  static OpenDevice& as_device(void* self) { return *static_cast<OpenDevice*>(self); }

  std::size_t read_rows(asp_imu_row* rows, std::size_t capacity) {
    std::size_t count = 0;
    for (; count < capacity && next_row_ < samples_.t_ns.size() && samples_.t_ns[next_row_] <= now_ns_; ++count) {
      asp_imu_row& row = rows[count];
      row = {};
      row.time_ns = samples_.device_ns(samples_.t_ns[next_row_]);
      for (int axis = 0; axis < 3; ++axis) {
        row.accel[axis] =
            static_cast<std::int16_t>(whole(samples_.stream.accel_counts[next_row_][axis], -32768, 32767));
        if (samples_.stream.has_gyro())
          row.gyro[axis] =
              static_cast<std::int16_t>(whole(samples_.stream.gyro_counts[next_row_][axis], -32768, 32767));
      }
      ++next_row_;
    }
    return count;
  }

  bool read_force(asp_force_sample* sample) {
    while (next_force_ < samples_.t_ns.size() && samples_.t_ns[next_force_] <= now_ns_) {
      const std::size_t i = next_force_++;
      if (std::isnan(samples_.stream.force_counts[i])) continue;
      *sample = {};
      sample->time_us = samples_.device_ns(samples_.t_ns[i]) / 1000;
      sample->counts[0] = whole(samples_.stream.force_counts[i], -2147483648.0, 2147483647.0);
      return true;
    }
    return false;
  }

  std::size_t read_host(std::uint8_t* bytes, std::size_t capacity) {
    const std::size_t count = std::min(capacity, heard_.size());
    std::copy_n(heard_.begin(), count, bytes);
    heard_.erase(heard_.begin(), heard_.begin() + static_cast<std::ptrdiff_t>(count));
    return count;
  }

  Samples samples_;
  std::int64_t now_ns_ = 0;
  std::size_t next_row_ = 0;
  std::size_t next_force_ = 0;
  std::vector<std::uint8_t>* out_ = nullptr;
  std::deque<std::uint8_t> heard_;
  asp_board board_{};
  asp_probe probe_{};
};

class WhatDevice : public ProbeDevice {
 public:
  WhatDevice(const Recording& recording, const ProbeClock& clock) : samples_(recording, clock) {}

  void advance(std::int64_t t_ns, std::vector<std::uint8_t>& out) override {
    for (; next_ < samples_.t_ns.size() && samples_.t_ns[next_] <= t_ns; ++next_) {
      const double force = samples_.stream.force_counts[next_];
      if (!std::isnan(force)) force_ = force;
      out.push_back(0xFF);
      for (int axis = 0; axis < 3; ++axis) out.push_back(byte(samples_.stream.accel_counts[next_][axis]));
      out.push_back(byte(force_));
    }
  }

  void receive(std::span<const std::uint8_t>) override {}

 private:
  static std::uint8_t byte(double counts) { return static_cast<std::uint8_t>(whole(counts, 0.0, 255.0)); }

  Samples samples_;
  std::size_t next_ = 0;
  double force_ = 0.0;
};

}  // namespace

std::unique_ptr<ProbeDevice> make_probe_device(const Recording& recording, const SimulatedProbeConfig& config,
                                               const ProbeClock& clock) {
  if (config.model == ProbeModel::kWhat) return std::make_unique<WhatDevice>(recording, clock);
  return std::make_unique<OpenDevice>(recording, config, clock);
}

std::vector<ProbeBytes> send_recording(const Recording& recording, const SimulatedProbeConfig& config,
                                       const ProbeClock& clock, double poll_s) {
  constexpr std::int64_t kAfterwards_ns = 50'000'000;  // the last frame is not full
  if (!(poll_s >= 1e-5)) throw Error(fmt::format("a host cannot read every {} s", poll_s));
  const std::unique_ptr<ProbeDevice> device = make_probe_device(recording, config, clock);
  std::vector<ProbeBytes> out;
  const auto poll_ns = static_cast<std::int64_t>(std::llround(poll_s * 1e9));
  const std::int64_t end_ns = recording.truth->t_ns.back() + kAfterwards_ns;
  ProbeBytes read;
  for (read.t_ns = recording.truth->t_ns.front(); read.t_ns <= end_ns; read.t_ns += poll_ns) {
    read.bytes.clear();
    device->advance(read.t_ns, read.bytes);
    if (!read.bytes.empty()) out.push_back(read);
  }
  return out;
}

}  // namespace asperity
