#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "asperity/recording/recording_appender.h"

namespace asperity {

// Poses as lines of text, those of a tracker.csv: t_ns,px_m,py_m,pz_m,qw,qx,qy,qz and perhaps markers,reprojection_px;
// what follows is passed over. An empty t_ns stands for the time of arrival. Any bytes are survived: a line that is
// no pose (a cell that is no number, a quaternion more than 1e-3 off length one, more than 1000 bytes) is counted.
// Empty lines, those that begin with # and a header are neither poses nor errors.
class PoseLines {
 public:
  // A line that begins with one of `bodies` and a comma is a pose of that body: sample.body is its place, from 1.
  explicit PoseLines(std::vector<std::string> bodies = {}) : bodies_(std::move(bodies)) {}

  // Appends to `out` the poses that `bytes` complete.
  void push(std::span<const std::uint8_t> bytes, std::int64_t arrival_ns, std::vector<TrackerSample>& out);

  std::uint64_t bad_lines() const { return bad_lines_; }

 private:
  // The body that the line begins with, which is taken off it.
  std::size_t take_body(std::string_view& line) const;
  void take_line(std::int64_t arrival_ns, std::vector<TrackerSample>& out);

  std::vector<std::string> bodies_;
  std::string line_;
  bool too_long_ = false;
  std::uint64_t bad_lines_ = 0;
};

}  // namespace asperity
