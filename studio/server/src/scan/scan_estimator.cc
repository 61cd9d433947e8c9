#include "scan/scan_estimator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/geometry/pose.h"

namespace asperity::studio {

namespace {

constexpr double kFarthest_m = 0.02;              // of the tip from where the poses have it
constexpr std::int64_t kWidest_ns = 300'000'000;  // between two poses that tell where the tip is between
constexpr std::int64_t kRemembered_ns = 3'000'000'000;
constexpr double kCertain_deg = 10.0;  // of the base's normal, for a hint about the tilt
constexpr double kShareOfTip = 0.01;   // a tip comes every 4 ms
constexpr double kEnough = 0.5;

// The data of the probe and its position for the estimators.
bool measures_alike(const RecordingInfo& a, const RecordingInfo& b) {
  return a.gravity_world_mps2 == b.gravity_world_mps2 && a.probe_rate_Hz == b.probe_rate_Hz && a.adc_min == b.adc_min &&
         a.adc_max == b.adc_max;
}

}  // namespace

ScanEstimator::ScanEstimator(Calibration calibration, bool calibrated, RecordingInfo info, const ScanConfig& config)
    : calibration_(std::move(calibration)),
      calibrated_(calibrated),
      info_(std::move(info)),
      config_(config),
      live_(calibration_, info_, config.live),
      advisor_(calibration_, info_, config.hints, calibrated) {}

LiveEstimate ScanEstimator::take(std::span<const ProbeSample> rows, std::span<const TrackedPose> poses) {
  for (const ProbeSample& row : rows) {
    live_.push(row);
    advisor_.push(row);
  }
  kept_.add(rows);
  for (const TrackedPose& pose : poses) {
    const TrackerSample sample = with_sigmas(pose);
    live_.push(sample);
    advisor_.push(sample);
    kept_.add(sample);
    const auto latency_ns = static_cast<std::int64_t>(std::llround(1e9 * calibration_.tracker.latency_s));
    tracked_.push_back({sample.t_ns - latency_ns, sample.T_world_marker * calibration_.tip_in_marker_m});
    while (tracked_.front().t_ns < tracked_.back().t_ns - kRemembered_ns) tracked_.pop_front();
  }
  LiveEstimate out = live_.estimate();
  keep_valid(out);
  advisor_.push(out);
  return out;
}

void ScanEstimator::keep_valid(LiveEstimate& estimate) {
  std::int64_t doubted_from_ns = std::numeric_limits<std::int64_t>::max(), doubted_to_ns = 0;
  const bool certain = estimate.base.known && estimate.base.normal_sigma_deg <= kCertain_deg;
  std::erase_if(estimate.tips, [&](LiveTip& tip) {
    if (!certain) tip.tilt_rad = std::numeric_limits<double>::quiet_NaN();
    const bool trusted = is_near_poses(tip);
    trusted_share_ += kShareOfTip * ((trusted ? 1.0 : 0.0) - trusted_share_);
    if (trusted) return false;
    doubted_from_ns = std::min(doubted_from_ns, tip.t_ns);
    doubted_to_ns = std::max(doubted_to_ns, tip.t_ns);
    return true;
  });
  for (LivePoint& point : estimate.points) {
    if (point.t_ns < doubted_from_ns || point.t_ns > doubted_to_ns) continue;
    point.height_m = point.sigma_m = point.texture_m = std::numeric_limits<double>::quiet_NaN();
  }
  waiting_ = estimate.waiting;
  if (waiting_.empty() && trusted_share_ < kEnough)
    waiting_ = "No live profile at the moment: too few poses arrive in time.";
}

bool ScanEstimator::is_near_poses(const LiveTip& tip) const {
  const auto after = std::lower_bound(tracked_.begin(), tracked_.end(), tip.t_ns,
                                      [](const TrackedTip& at, std::int64_t t_ns) { return at.t_ns < t_ns; });
  if (after == tracked_.end() || after == tracked_.begin()) return false;
  const auto before = std::prev(after);
  const auto width_ns = static_cast<double>(after->t_ns - before->t_ns);
  if (width_ns > static_cast<double>(kWidest_ns)) return false;
  const double share = static_cast<double>(tip.t_ns - before->t_ns) / std::max(1.0, width_ns);
  return (lerp(before->p_world_m, after->p_world_m, share) - tip.p_world_tip_m).norm() <= kFarthest_m;
}

void ScanEstimator::restart() {
  live_.restart();
  advisor_.restart();
  trusted_share_ = 1.0;
}

void ScanEstimator::configure(const RecordingInfo& info, const ScanConfig& config) {
  ScanAdvisor advisor(calibration_, info, config.hints, calibrated_);
  if (measures_alike(info, info_)) {
    live_.configure(config.live);
    advisor_.configure(config.hints);
  } else {
    live_ = LiveProfile(calibration_, info, config.live);
    advisor_ = std::move(advisor);
  }
  info_ = info;
  config_ = config;
}

LiveEstimate ScanEstimator::again(std::int64_t start_ns, std::int64_t end_ns, bool goes_on) {
  LiveProfile live(calibration_, info_, config_.live);
  kept_.replay(
      start_ns, end_ns, [&](const ProbeSample& row) { live.push(row); },
      [&](const TrackerSample& pose) { live.push(pose); });
  LiveEstimate out = live.estimate();
  if (goes_on) live_ = std::move(live);
  return out;
}

}  // namespace asperity::studio
