#include "asperity/device/replay_device.h"

#include <algorithm>
#include <utility>

#include "asperity/base/units.h"
#include "check_samples.h"

namespace asperity {

namespace {

class ReplayDevice final : public HapticDevice {
 public:
  explicit ReplayDevice(std::vector<ReplaySample> samples) : samples_(std::move(samples)) {
    check_samples(samples_, "the replayed path");
    info_.name = "replay";
    info_.model = "recorded path";
    info_.workspace_min_m = info_.workspace_max_m = samples_.front().p_m;
    const std::int64_t start_ns = samples_.front().t_ns;
    for (ReplaySample& sample : samples_) {
      sample.t_ns -= start_ns;
      info_.workspace_min_m = info_.workspace_min_m.cwiseMin(sample.p_m);
      info_.workspace_max_m = info_.workspace_max_m.cwiseMax(sample.p_m);
    }
    info_.simulated = true;
    info_.yields = false;
  }

  const DeviceInfo& info() const noexcept override { return info_; }

  DeviceReading read(std::int64_t t_ns) noexcept override {
    if (t_ns > newest_ns_) {
      newest_ns_ = t_ns;
      ++sequence_;
      while (segment_ + 1 < samples_.size() && samples_[segment_ + 1].t_ns <= t_ns) ++segment_;
    }
    DeviceReading reading;
    reading.sequence = sequence_;
    const ReplaySample& from = samples_[segment_];
    reading.p_m = from.p_m;
    if (segment_ + 1 < samples_.size()) {
      const ReplaySample& to = samples_[segment_ + 1];
      const double since_ns = static_cast<double>(std::max<std::int64_t>(newest_ns_, 0) - from.t_ns);
      const double duration_ns = static_cast<double>(to.t_ns - from.t_ns);
      const Eigen::Vector3d way_m = to.p_m - from.p_m;
      reading.p_m += since_ns / duration_ns * way_m;
      reading.v_mps = way_m / (duration_ns * kNanosecond_s);
    }
    if (closed_ || newest_ns_ > samples_.back().t_ns) reading.status = DeviceStatus::kEnded;
    return reading;
  }

  void write(const Eigen::Vector3d&) noexcept override {}
  void close() noexcept override { closed_ = true; }
  std::string fault() const override { return {}; }

 private:
  DeviceInfo info_;
  std::vector<ReplaySample> samples_;
  std::size_t segment_ = 0;
  std::int64_t newest_ns_ = -1;
  std::uint64_t sequence_ = 0;
  bool closed_ = false;
};

}  // namespace

std::unique_ptr<HapticDevice> open_replay(std::vector<ReplaySample> samples) {
  return std::make_unique<ReplayDevice>(std::move(samples));
}

}  // namespace asperity
