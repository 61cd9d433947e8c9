#include "asperity/tracking/pose_lines.h"

#include <algorithm>
#include <cmath>

#include "fuzz_input.h"

using namespace asperity;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  PoseLines whole, pieces;
  std::vector<TrackerSample> at_once, piecewise;
  whole.push({data, size}, 1, at_once);
  for (std::size_t i = 0; i < size; i += 3) pieces.push({data + i, std::min<std::size_t>(3, size - i)}, 1, piecewise);
  must(at_once.size() == piecewise.size() && whole.bad_lines() == pieces.bad_lines());
  for (const TrackerSample& pose : at_once) {
    must(pose.t_ns >= 0 && pose.T_world_marker.translation_m.allFinite());
    must(std::abs(pose.T_world_marker.rotation.norm() - 1.0) < 1e-9);
  }
  return 0;
}
