#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <span>

#include "asperity/recording/recording.h"
#include "asperity/recording/recording_appender.h"

namespace asperity::studio {

// The rows and poses of the scan that is under way, or else of the last seconds, so that it can be worked out again
// with other settings at once. Bounded; not thread-safe.
class KeptRows {
 public:
  static constexpr std::size_t kMostRows = 1'500'000;  // six minutes at 4 kHz, 130 MB
  static constexpr std::int64_t kTrail_ns = 12'000'000'000;

  void add(std::span<const ProbeSample> rows);
  void add(const TrackerSample& pose);
  // False: rows before the newest 12 s may go.
  void hold(bool held) { held_ = held; }
  // Forgets what was before.
  void forget_before(std::int64_t t_ns);
  // True if nothing between was dropped.
  bool covers(std::int64_t start_ns) const { return dropped_until_ns_ < start_ns; }

  // Both streams in the order of their times, as far as they lie in the range.
  void replay(std::int64_t start_ns, std::int64_t end_ns, const std::function<void(const ProbeSample&)>& on_row,
              const std::function<void(const TrackerSample&)>& on_pose) const;
  // The two streams of a recording of that range.
  void copy(std::int64_t start_ns, std::int64_t end_ns, bool has_gyro, Recording& out) const;
  std::int64_t newest_pose_ns() const { return poses_.empty() ? kNever : poses_.back().t_ns; }

 private:
  static constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::min();
  std::deque<ProbeSample> rows_;
  std::deque<TrackerSample> poses_;
  bool held_ = false;
  std::int64_t dropped_until_ns_ = kNever;
};

}  // namespace asperity::studio
