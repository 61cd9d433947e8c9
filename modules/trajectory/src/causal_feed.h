#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "asperity/recording/recording.h"
#include "asperity/trajectory/calibrate_inertial.h"
#include "asperity/trajectory/causal_feed_config.h"
#include "asperity/trajectory/estimate_trajectory_fused.h"
#include "inertial_smoother.h"

namespace asperity::inertial_smoother {

// A recording as it would have come: block after block of rows, each calibrated from what is known at its end, and the
// poses that were taken within it. Nothing of a later block is looked at. (A pose is known its latency after it was
// taken; time here is when poses and rows were taken.)
class CausalFeed {
 public:
  // Keeps the recording. Throws Error if fewer than four poses lie within the probe's time.
  CausalFeed(const Recording& recording, const FusedConfig& fused, const CausalFeedConfig& config);

  // The next block; false at the end. The first is the start: it begins with the first pose and has the first state
  // and its covariance in `problem`.
  bool next();

  // Knots and epochs of the block on one time line, from where the block before ended; seconds after origin_ns().
  const Problem& problem() const { return problem_; }
  // The rows that the knots' samples index; some before the block are among them.
  const InertialStream& stream() const { return stream_; }
  std::int64_t origin_ns() const { return stream_.t_ns.front(); }
  // The row of the recording that is the stream's first.
  std::size_t first_row() const { return first_row_; }

 private:
  void calibrate();
  void configure();

  const Recording& recording_;
  const FusedConfig& fused_;
  CausalFeedConfig config_;
  Recording part_;  // the rows in hand, with calibration and info
  std::vector<std::int64_t> pose_ns_;
  std::vector<PoseNoise> pose_noise_;  // as stated, of every pose
  std::size_t first_row_ = 0;
  std::size_t end_row_ = 0;   // past the block
  std::size_t last_row_ = 0;  // past the last pose
  std::size_t next_pose_ = 0;
  std::int64_t begin_ns_ = 0;
  bool started_ = false;
  bool gyro_turns_too_ = true;
  double accel_floor_mps2_ = std::numeric_limits<double>::infinity();
  double gyro_floor_radps_ = std::numeric_limits<double>::infinity();
  InertialStream stream_;
  Problem problem_;
};

}  // namespace asperity::inertial_smoother
