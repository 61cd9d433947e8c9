#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/motion.h"
#include "asperity/recording/calibration.h"
#include "asperity/recording/recording.h"
#include "asperity/recording/recording_appender.h"
#include "asperity/trajectory/estimate_trajectory_fused.h"

namespace asperity {

struct CausalTipConfig {
  double lag_s = 0.13;
  double poses_after_s = 0.08;
  double longest_lag_s = 0.4;
  double correction_Hz = 0.8;
  double hop_s = 0.02;
  double start_s = 0.25;
  double mounting_s = 3.0;
  double context_s = 0.25;
  double max_row_gap_s = 0.3;
  double ahead_s = 0.08;

  template <class V>
  void visit(V& v) {
    v.field("lag_s", lag_s, "a sample is final this long after it was taken, s", {0.01, 10.0});
    v.field("poses_after_s", poses_after_s, "or, if that is longer, this much more than poses have come late, s",
            {0.0, 10.0});
    v.field("longest_lag_s", longest_lag_s, "poses that come later do not make the lag longer than this, s",
            {0.01, 10.0});
    v.field("correction_Hz", correction_Hz, "corner of what the tracker corrects in the steady path, Hz",
            {0.01, 100.0});
    v.field("hop_s", hop_s, "between two estimates of the window, s", {0.001, 1.0});
    v.field("start_s", start_s, "of rows and poses before the first estimate, s", {0.05, 10.0});
    v.field("mounting_s", mounting_s, "the same where the sensor's rotation is unknown, s", {0.5, 60.0});
    v.field("context_s", context_s, "of rows before the window that its clock is smoothed over, s", {0.05, 10.0});
    v.field("max_row_gap_s", max_row_gap_s, "gap in the rows after which the estimate begins again, s", {0.01, 10.0});
    v.field("ahead_s", ahead_s, "how far a sample looks ahead for its direction of travel, s", {0.001, 1.0});
  }
};

struct CausalTipCounts {
  std::uint64_t rows = 0, rows_refused = 0, rows_lost = 0;
  std::uint64_t poses = 0, poses_refused = 0, poses_late = 0, poses_outlying = 0;
  std::uint64_t restarts = 0;
};

// The tip's motion at the probe's own sample times while they come: the filter of fused.h, smoothed over a fixed lag
// (docs/live-profile-tip.md). Memory is bounded. Thread-safe: no.
class CausalTip {
 public:
  // Throws Error if the calibration is singular.
  CausalTip(const Calibration& calibration, const RecordingInfo& info, const FusedConfig& fused,
            const CausalTipConfig& config);
  ~CausalTip();
  CausalTip(CausalTip&&) noexcept;
  CausalTip& operator=(CausalTip&&) noexcept;

  // Rows in order of time; poses as received, the latency still in them, at any time after. What is out of order,
  // repeated or not finite is passed over and counted.
  void push(const ProbeSample& row);
  void push(const TrackerSample& pose);

  // Appends the samples that have become final since the last call to `out`, in order of time. `broken` is set for a
  // sample before which the estimate restarted: positions jump there.
  // `steady_m` is the tip's position again, with the tracker's corrections let in slowly: worse as a position, far
  // better where it is compared with itself a few millimetres back (docs/live-profile-tip.md).
  // `ahead_m` is the way from the sample to where the newest window has the tip ahead_s later: not final.
  struct Samples {
    TipMotion motion;
    std::vector<char> broken;
    std::vector<Eigen::Vector3d> steady_m;
    std::vector<Eigen::Vector3d> ahead_m;
  };
  void take(Samples& out);

  CausalTipCounts counts() const;
  std::int64_t newest_row_ns() const;
  std::int64_t newest_pose_ns() const;  // its true time
  std::int64_t final_ns() const;        // up to here samples are final
  std::string waiting() const;          // why nothing is estimated yet; empty: it is

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace asperity
