#pragma once

#include <cstdint>
#include <vector>

#include "asperity/geometry/pose.h"
#include "asperity/recording/recording.h"

namespace asperity {

// Where the marker body truly was at any time, between the rows of a recording's truth by straight lines and SLERP (4
// kHz leave some 0.1 µm of error at a motion's 100 m/s²), at its ends as in the first and last row.
class TrueMotion {
 public:
  // Throws Error for a recording without truth.
  explicit TrueMotion(const Recording& recording);

  Pose T_world_marker(std::int64_t t_ns) const;
  std::int64_t start_ns() const { return t_ns_.front(); }
  std::int64_t end_ns() const { return t_ns_.back(); }

 private:
  std::vector<std::int64_t> t_ns_;
  std::vector<Pose> T_world_marker_;
};

}  // namespace asperity
