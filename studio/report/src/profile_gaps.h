#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "asperity/pipeline/process_result.h"

namespace asperity::studio {

// A stretch of a profile without heights, and why in words.
struct ProfileGap {
  double from_m = 0.0, to_m = 0.0;
  std::string why;
};

// The gaps between a profile's first and last height, in order.
std::vector<ProfileGap> find_gaps(const ProcessResult& result);

}  // namespace asperity::studio
