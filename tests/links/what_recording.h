#pragma once

#include <cstdint>

#include "asperity/link/link_statistics.h"
#include "asperity/recording/recording.h"
#include "asperity/simulation/simulation_config.h"
#include "asperity/testkit/what_line.h"

namespace asperity {

// The settings of a scan of `surface` with the seed's probe, whose samples all arrive unharmed at their true times:
// faults are the line's matter here.
SimulationConfig faultless_what_config(const char* surface, std::uint64_t seed);

// `recording` with its probe's samples sent as the seed's probe sends them, damaged as `line` says, read and decoded
// again.
struct LineResult {
  Recording recording;
  LinkStatistics statistics;
};
LineResult through_what_line(const Recording& recording, const testkit::WhatLineConfig& line, std::uint64_t seed);

}  // namespace asperity
