#pragma once

#include <cstdint>

#include "asperity/simulation/surface_config.h"

namespace asperity {

// Puts an object somewhere else before the tracker: the middle of the stroke within 30 mm of where it was, along each
// axis of the world, the normal there turned by up to 20 degrees, the stroke turned about it by up to 60. The same
// seed gives the same pose.
void randomise_pose(std::uint64_t seed, SimulatedShapeConfig& shape);

}  // namespace asperity
