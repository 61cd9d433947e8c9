#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "asperity/import/file_streams.h"

namespace asperity {

// Poses between the rows of a stream, for times that mostly rise.
class PoseAt {
 public:
  explicit PoseAt(const PoseStream& pose);

  // nullopt outside the stream and in gaps of more than ten usual intervals.
  std::optional<Pose> interpolate(std::int64_t t_ns);

 private:
  const PoseStream& pose_;
  std::size_t row_ = 0;  // at or before the last time asked for
  std::int64_t longest_gap_ns_ = 0;
};

// The median of the intervals, ns; 0 for fewer than two times.
std::int64_t median_interval_ns(const std::vector<std::int64_t>& t_ns);

}  // namespace asperity
