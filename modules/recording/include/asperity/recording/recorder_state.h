#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace asperity {

struct Segment {
  std::string name;
  std::int64_t start_ns = 0;
  std::int64_t end_ns = 0;
};

// How the recorder got the gravity that a recording states.
struct GravityAtRest {
  bool measured = false;
  std::int64_t windows_at_rest = 0;
  // Standard deviation of the windows' estimates; nan below two.
  Eigen::Vector3d scatter_mps2 = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
};

// What the recorder says of its own work (recording.json, extra.recorder); absent is what it did not say.
struct RecorderState {
  std::string state;  // "recording" until it has come to its end, then "finished"
  std::string mode;   // "segments" or "auto"
  std::optional<bool> last_segment_is_open;
  std::optional<std::int64_t> discarded_until_ns;
  std::optional<std::int64_t> discarded_segments;
  std::vector<Segment> discarded;  // whose rows are still in the files
  std::optional<GravityAtRest> gravity;
  std::optional<std::string> probe_name;
  std::optional<std::string> probe_firmware;
};

}  // namespace asperity
