#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "asperity/live/live_profile.h"
#include "asperity/live/scan_hints.h"
#include "asperity/tracking/tracked_pose.h"
#include "scan/kept_rows.h"
#include "scan/scan_config.h"

namespace asperity::studio {

// What is known of a scan while it is made: the live profile, the hints, and the rows to work it out again. Where the
// tracker has too little to say the live estimate is a guess: what is further from its poses than a hand could be is
// left out, and no hint is made of it. Not thread-safe.
class ScanEstimator {
 public:
  // Throws Error for settings or a calibration that the estimators do not take.
  ScanEstimator(Calibration calibration, bool calibrated, RecordingInfo info, const ScanConfig& config);

  // Rows and poses as they have arrived; what is new, without implausible ones.
  LiveEstimate take(std::span<const ProbeSample> rows, std::span<const TrackedPose> poses);
  // A new stroke begins.
  void restart();
  // Other settings, or more that is known of the probe (its rate and range, the gravity), from here on: the latter
  // begins the estimate again. Throws Error, and nothing has changed then.
  void configure(const RecordingInfo& info, const ScanConfig& config);
  // The profile of these rows with the settings as they are. With `goes_on` the estimate continues from there.
  LiveEstimate again(std::int64_t start_ns, std::int64_t end_ns, bool goes_on);

  std::vector<Hint> hints(std::int64_t now_ns) { return advisor_.hints(now_ns); }
  double highest_speed_mps() const { return advisor_.highest_speed_mps(); }
  // Why no live profile is shown, as a message; empty: one is shown.
  const std::string& waiting() const { return waiting_; }
  KeptRows& kept() { return kept_; }

 private:
  struct TrackedTip {
    std::int64_t t_ns;
    Eigen::Vector3d p_world_m;
  };
  bool is_near_poses(const LiveTip& tip) const;
  void keep_valid(LiveEstimate& estimate);

  Calibration calibration_;
  bool calibrated_;
  RecordingInfo info_;
  ScanConfig config_;
  LiveProfile live_;
  ScanAdvisor advisor_;
  KeptRows kept_;
  std::deque<TrackedTip> tracked_;  // of the last seconds
  double trusted_share_ = 1.0;      // of the tips of the last half second
  std::string waiting_;
};

}  // namespace asperity::studio
