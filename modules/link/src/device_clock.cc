#include "asperity/link/device_clock.h"

#include <algorithm>
#include <cmath>

namespace asperity {

namespace {

constexpr double kSlowest = 0.5;  // pace of the times handed out against the device's, while they come to the line
constexpr double kFastest = 1.5;
constexpr double kLeap_ns = 50e6;
constexpr std::int64_t kTooFarAhead_ns = 1'000'000'000;

// Times stay well inside 64 bits: differences of two never overflow.
constexpr std::int64_t kFar_ns = std::int64_t{1} << 59;

}  // namespace

DeviceClock::DeviceClock(const DeviceClockConfig& config)
    : config_(config), bin_ns_(config.window_s * 1e9 / static_cast<double>(kBins)) {}

void DeviceClock::observe(std::int64_t device_ns, std::int64_t arrival_ns) {
  device_ns = std::clamp(device_ns, -kFar_ns, kFar_ns);
  arrival_ns = std::clamp(arrival_ns, -kFar_ns, kFar_ns);
  if (count_ == 0) {
    origin_ns_ = device_ns;
    offset_ns_ = arrival_ns - device_ns;
  }
  Pair pair;
  pair.p_ns = static_cast<double>(device_ns - origin_ns_);
  pair.r_ns = static_cast<double>(arrival_ns - device_ns - offset_ns_);
  const auto bin = static_cast<std::int64_t>(std::floor(pair.p_ns / bin_ns_));

  const auto end = bins_.begin() + static_cast<std::ptrdiff_t>(count_);
  const auto place = std::lower_bound(bins_.begin(), end, bin);
  const auto index = static_cast<std::size_t>(place - bins_.begin());
  if (place != end && *place == bin) {
    const Pair& kept = pairs_[index];
    if (pair.r_ns - kept.r_ns >= slope_ * (pair.p_ns - kept.p_ns)) return;
    pairs_[index] = pair;
  } else {
    if (count_ > 0 && bin <= bins_[count_ - 1] - static_cast<std::int64_t>(kBins)) return;
    // Bins that fall out of the window, or, if none does, none: there is room for one more than the window has.
    const std::int64_t oldest =
        std::max(bin, count_ > 0 ? bins_[count_ - 1] : bin) - static_cast<std::int64_t>(kBins) + 1;
    std::size_t drop = 0;
    while (drop < count_ && bins_[drop] < oldest) ++drop;
    std::copy(bins_.begin() + static_cast<std::ptrdiff_t>(drop), end, bins_.begin());
    std::copy(pairs_.begin() + static_cast<std::ptrdiff_t>(drop), pairs_.begin() + static_cast<std::ptrdiff_t>(count_),
              pairs_.begin());
    count_ -= drop;
    const std::size_t at = index - std::min(index, drop);
    std::copy_backward(bins_.begin() + static_cast<std::ptrdiff_t>(at),
                       bins_.begin() + static_cast<std::ptrdiff_t>(count_),
                       bins_.begin() + static_cast<std::ptrdiff_t>(count_) + 1);
    std::copy_backward(pairs_.begin() + static_cast<std::ptrdiff_t>(at),
                       pairs_.begin() + static_cast<std::ptrdiff_t>(count_),
                       pairs_.begin() + static_cast<std::ptrdiff_t>(count_) + 1);
    bins_[at] = bin;
    pairs_[at] = pair;
    ++count_;
  }
  fit();
}

void DeviceClock::fit() {
  // The lower hull by Andrew's monotone chain, in place of indices only.
  std::array<std::size_t, kBins + 1> hull{};
  std::size_t corners = 0;
  double mean_ns = 0.0;
  for (std::size_t i = 0; i < count_; ++i) {
    mean_ns += pairs_[i].p_ns;
    while (corners >= 2) {
      const Pair& a = pairs_[hull[corners - 2]];
      const Pair& b = pairs_[hull[corners - 1]];
      const double turn = (b.p_ns - a.p_ns) * (pairs_[i].r_ns - a.r_ns) - (pairs_[i].p_ns - a.p_ns) * (b.r_ns - a.r_ns);
      if (turn > 0.0) break;
      --corners;
    }
    hull[corners++] = i;
  }
  mean_ns /= static_cast<double>(count_);
  std::size_t edge = 0;
  while (edge + 2 < corners && pairs_[hull[edge + 1]].p_ns < mean_ns) ++edge;
  slope_ = 0.0;
  if (corners >= 2) {
    const Pair& a = pairs_[hull[edge]];
    const Pair& b = pairs_[hull[edge + 1]];
    slope_ = std::clamp((b.r_ns - a.r_ns) / (b.p_ns - a.p_ns), -config_.max_rate_error, config_.max_rate_error);
  }
  intercept_ns_ = pairs_[hull[0]].r_ns - slope_ * pairs_[hull[0]].p_ns;
  for (std::size_t k = 1; k < corners; ++k) {
    intercept_ns_ = std::min(intercept_ns_, pairs_[hull[k]].r_ns - slope_ * pairs_[hull[k]].p_ns);
  }
}

std::int64_t DeviceClock::line_ns(std::int64_t device_ns) const {
  if (count_ == 0) return device_ns;
  device_ns = std::clamp(device_ns, -kFar_ns, kFar_ns);
  const double correction_ns = intercept_ns_ + slope_ * static_cast<double>(device_ns - origin_ns_);
  return device_ns + offset_ns_ + std::llround(correction_ns);
}

std::int64_t DeviceClock::stamp(std::int64_t device_ns) {
  device_ns = std::clamp(device_ns, -kFar_ns, kFar_ns);
  std::int64_t t_ns = line_ns(device_ns);
  if (has_stamp_) {
    double slow_ns = 0.0;
    const bool too_far_ahead = last_stamp_ns_ - t_ns > kTooFarAhead_ns;
    const std::int64_t least_ns = too_far_ahead ? 1 : std::max<std::int64_t>(1, config_.min_spacing_ns);
    if (stamp_is_of_this_run_ && device_ns > last_device_ns_) {
      const auto ahead_ns = static_cast<double>(device_ns - last_device_ns_);
      const double fast_ns = kFastest * ahead_ns;
      const auto jump_ns = static_cast<double>(t_ns - last_stamp_ns_);
      if (jump_ns > fast_ns && jump_ns < fast_ns + kLeap_ns) t_ns = last_stamp_ns_ + std::llround(fast_ns);
      if (!too_far_ahead) slow_ns = kSlowest * ahead_ns;
    }
    t_ns = std::max(t_ns, last_stamp_ns_ + std::max(least_ns, static_cast<std::int64_t>(slow_ns)));
  }
  has_stamp_ = true;
  stamp_is_of_this_run_ = true;
  last_device_ns_ = device_ns;
  last_stamp_ns_ = t_ns;
  return t_ns;
}

void DeviceClock::restart() {
  count_ = 0;
  slope_ = 0.0;
  intercept_ns_ = 0.0;
  stamp_is_of_this_run_ = false;
}

void DeviceClock::restart(const DeviceClockConfig& config) {
  config_ = config;
  bin_ns_ = config.window_s * 1e9 / static_cast<double>(kBins);
  restart();
}

}  // namespace asperity
