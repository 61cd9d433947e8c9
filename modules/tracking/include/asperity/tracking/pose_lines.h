#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "asperity/recording/recording_appender.h"

namespace asperity {

// Poses as lines of text, those of a tracker.csv: t_ns,px_m,py_m,pz_m,qw,qx,qy,qz and perhaps markers,reprojection_px;
// what follows is passed over. An empty t_ns stands for the time of arrival. Any bytes are survived: a line that is
// no pose (a cell that is no number, a quaternion more than 1e-3 off length one, more than 1000 bytes) is counted.
// Empty lines, those that begin with # and a header are no poses and no errors.
class PoseLines {
 public:
  // Appends to `out` the poses that `bytes` complete.
  void push(std::span<const std::uint8_t> bytes, std::int64_t arrival_ns, std::vector<TrackerSample>& out);

  std::uint64_t bad_lines() const { return bad_lines_; }

 private:
  void take_line(std::int64_t arrival_ns, std::vector<TrackerSample>& out);

  std::string line_;
  bool too_long_ = false;
  std::uint64_t bad_lines_ = 0;
};

}  // namespace asperity
