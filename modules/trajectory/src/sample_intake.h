#pragma once

#include <cstdint>
#include <vector>

#include "asperity/recording/recording.h"
#include "asperity/recording/recording_appender.h"
#include "asperity/trajectory/causal_tip.h"

namespace asperity {

// The rows and poses that a causal estimate still needs, as they came and were found sound. Memory is bounded.
class SampleIntake {
 public:
  SampleIntake(const Calibration& calibration, const RecordingInfo& info);

  // A row that is not finite, repeated or older than the newest is refused; but when a good number of them in a row is,
  // the clock has been set back, which counts as a hole. A row more than `max_gap_s` after the newest comes after one.
  enum class Row { kNext, kAfterHole, kRefused };
  Row judge(const ProbeSample& row, double max_gap_s);
  void add(const ProbeSample& row);
  void add(const TrackerSample& pose);

  void clear_rows();
  void clear_poses();
  void forget_before(std::int64_t t_ns);
  // Poses up to here have been told to the filter, or can be no more.
  void set_begin(std::int64_t begin_ns) { begin_ns_ = begin_ns; }

  // Rows and poses in hand, with calibration and info; the poses' times are true ones: the latency is off.
  const Recording& recording() const { return recording_; }
  // The poses' times, seconds after `origin_ns`; rising.
  std::vector<double> pose_s(std::int64_t origin_ns) const;
  std::int64_t newest_row_ns() const { return newest_row_ns_; }
  std::int64_t newest_pose_ns() const { return newest_pose_ns_; }
  CausalTipCounts counts() const { return counts_; }

 private:
  Recording recording_;
  std::int64_t latency_ns_ = 0;
  std::int64_t newest_row_ns_;
  std::int64_t newest_pose_ns_;
  std::int64_t begin_ns_;
  int rows_back_ = 0;   // refused in a row
  int poses_back_ = 0;  // likewise
  bool has_gyro_ = false;
  CausalTipCounts counts_;
};

}  // namespace asperity
