#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "asperity/rig/check_rig.h"
#include "asperity/simulation/simulation_config.h"

namespace asperity {

// `count` strokes over the grating on the virtual bench, by one rig: its calibration's error is the same in all.
// `wrong` makes the rig wrong in each.
std::vector<NamedRecording> grating_strokes(int count, std::uint64_t seed, const std::function<void(Recording&)>& wrong,
                                            const std::function<void(SimulationConfig&)>& change = {});

}  // namespace asperity
