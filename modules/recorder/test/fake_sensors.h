#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "asperity/base/host_clock.h"
#include "asperity/link/probe_source.h"
#include "asperity/tracking/pose_source.h"

namespace asperity {

// Waits until `t_ns` on the host's clock, at most `timeout`; true if it has come.
inline bool wait_until(std::int64_t t_ns, std::chrono::milliseconds timeout) {
  const std::int64_t wait_ns = t_ns - host_now_ns();
  if (wait_ns > 0)
    std::this_thread::sleep_for(std::min<std::chrono::nanoseconds>(std::chrono::nanoseconds(wait_ns), timeout));
  return host_now_ns() >= t_ns;
}

// What a fake sensor is told from outside, and says of itself.
struct FakeControl {
  std::atomic<bool> unplugged{false};
  std::atomic<bool> silent{false};
  std::atomic<int> opened{0};
  std::atomic<double> force_counts{0.0};
  std::atomic<std::int64_t> delivered_ns{0};  // time of the newest sample handed over
};

// Samples every `period_ns` by the host's clock, in bursts of 5 ms. accel_i counts the samples.
class FakeProbe : public ProbeSource {
 public:
  FakeProbe(std::shared_ptr<FakeControl> control, std::int64_t period_ns)
      : control_(std::move(control)), period_ns_(period_ns), next_ns_(host_now_ns()) {
    if (control_->unplugged) throw Error("fake: not there");
    ++control_->opened;
  }

  void read(std::vector<ProbeSample>& out, std::chrono::milliseconds timeout) override {
    if (control_->unplugged) throw LinkLost("fake: unplugged");
    constexpr std::int64_t kBurst_ns = 5'000'000;
    if (!wait_until(next_ns_ + kBurst_ns, timeout)) return;
    const std::int64_t now_ns = host_now_ns();
    for (; next_ns_ < now_ns; next_ns_ += period_ns_) {
      if (control_->silent) continue;
      ProbeSample sample;
      sample.t_ns = next_ns_;
      sample.accel_counts = {static_cast<double>(statistics_.samples++), -980.665, 0.0};
      sample.force_counts = control_->force_counts;
      out.push_back(sample);
      control_->delivered_ns = next_ns_;
    }
  }

  LinkStatistics statistics() const override { return statistics_; }
  std::optional<ProbeDescription> description() const override {
    ProbeDescription out;
    out.model = "open";
    out.name = "fake";
    out.rate_Hz = 1e9 / static_cast<double>(period_ns_);
    out.has_gyro = true;
    out.adc_max = 1000.0;
    return out;
  }
  std::string name() const override { return "fake probe"; }

 private:
  std::shared_ptr<FakeControl> control_;
  std::int64_t period_ns_;
  std::int64_t next_ns_;
  LinkStatistics statistics_;
};

// A whole capture at once: `count` samples of `period_ns` from `start_ns` on, then its end.
class ReplayedProbe : public ProbeSource {
 public:
  ReplayedProbe(std::int64_t start_ns, std::int64_t period_ns, std::uint64_t count)
      : start_ns_(start_ns), period_ns_(period_ns), count_(count) {}

  void read(std::vector<ProbeSample>& out, std::chrono::milliseconds) override {
    constexpr std::uint64_t kPiece = 1000;
    if (statistics_.samples == count_) throw LinkLost("replay: at its end");
    for (std::uint64_t i = 0; i < kPiece && statistics_.samples < count_; ++i) {
      ProbeSample sample;
      sample.t_ns = start_ns_ + period_ns_ * static_cast<std::int64_t>(statistics_.samples++);
      sample.accel_counts = {0.0, -980.665, 0.0};
      out.push_back(sample);
    }
  }

  LinkStatistics statistics() const override { return statistics_; }
  std::optional<ProbeDescription> description() const override { return std::nullopt; }
  std::string name() const override { return "replay"; }

 private:
  std::int64_t start_ns_;
  std::int64_t period_ns_;
  std::uint64_t count_;
  LinkStatistics statistics_;
};

// A pose every `period_ns`, at rest; px_m counts the frames in µm.
class FakePoses : public PoseSource {
 public:
  FakePoses(std::shared_ptr<FakeControl> control, std::int64_t period_ns)
      : control_(std::move(control)), period_ns_(period_ns), next_ns_(host_now_ns()) {
    if (control_->unplugged) throw Error("fake: not there");
    ++control_->opened;
  }

  std::optional<TrackedPose> read(std::chrono::milliseconds timeout) override {
    if (control_->unplugged) throw LinkLost("fake: unplugged");
    if (!wait_until(next_ns_, timeout)) return std::nullopt;
    TrackedPose out;
    out.sample.t_ns = next_ns_;
    out.sample.T_world_marker.translation_m = {1e-6 * static_cast<double>(statistics_.frames++), 0.0, 0.4};
    out.sample.markers = 2;
    out.sample.reprojection_px = 0.125;
    out.covariance = 1e-8 * Eigen::Matrix<double, 6, 6>::Identity();
    next_ns_ += period_ns_;
    if (control_->silent) return std::nullopt;
    ++statistics_.poses;
    return out;
  }

  TrackingStatistics statistics() const override { return statistics_; }
  double nominal_rate_Hz() const override { return 1e9 / static_cast<double>(period_ns_); }
  std::string name() const override { return "fake tracker"; }

 private:
  std::shared_ptr<FakeControl> control_;
  std::int64_t period_ns_;
  std::int64_t next_ns_;
  TrackingStatistics statistics_;
};

inline std::function<std::unique_ptr<ProbeSource>()> open_fake_probe(std::shared_ptr<FakeControl> control,
                                                                     double rate_Hz = 4000.0) {
  return [=] { return std::make_unique<FakeProbe>(control, std::llround(1e9 / rate_Hz)); };
}

inline std::function<std::unique_ptr<PoseSource>()> open_fake_poses(std::shared_ptr<FakeControl> control,
                                                                    double rate_Hz = 120.0) {
  return [=] { return std::make_unique<FakePoses>(control, std::llround(1e9 / rate_Hz)); };
}

}  // namespace asperity
