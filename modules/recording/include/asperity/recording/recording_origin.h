#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "asperity/json/json.h"

namespace asperity {

// The simulation that a recording is of (extra.simulation, extra.path_length_m).
struct SimulationOrigin {
  Json settings = Json::object();       // by their dotted paths
  bool is_live = false;                 // a simulated probe and camera, recorded as real ones are
  std::optional<double> path_length_m;  // of the path that the hand means to follow over a mesh
};

// What was done to another instrument's streams, of which a recording was made (extra.imported and four keys beside
// it).
struct ImportOrigin {
  double pose_rate_Hz = 0.0;
  std::array<double, 3> pose_noise_m{};
  std::array<double, 3> rotation_noise_rad{};
  std::int64_t seed = 0;
};

}  // namespace asperity
