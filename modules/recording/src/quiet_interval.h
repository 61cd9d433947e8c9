#pragma once

#include <cstddef>
#include <optional>

#include "asperity/recording/inspect_recording.h"

namespace asperity {

// Rows first to last (exclusive) of the probe.
struct RowRange {
  std::size_t first = 0;
  std::size_t last = 0;
};

// The gap-free rows of `config.quiet_s` in which the accelerometer varies least; nullopt if none are.
std::optional<RowRange> find_quiet_interval(const ProbeStream& probe, const StreamTiming& timing,
                                            const InspectConfig& config);

QuietInterval describe_quiet_interval(const Recording& recording, const RowRange& rows, const InspectConfig& config);

}  // namespace asperity
