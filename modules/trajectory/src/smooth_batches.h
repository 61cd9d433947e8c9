#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "asperity/trajectory/smooth_clock.h"

namespace asperity {

// The even clock behind stamps that a host gives to batches of samples: within a batch the stamps are even (counted
// back from the arrival) or all but equal, from batch to batch they jump by what the batch had to wait, often by more
// than a period. A longer step is a lost sample only if the stamps stay late from there on, by whole periods of the
// least wait; what returns was a wait. The new stamps are on straight lines, over `reach_s` to either side and without
// the batches that waited unusually long, through the batches' last samples: the mean wait stays in them, as a latency.
// Empty if the stamps are not of batches.
std::optional<SmoothClockResult> smooth_batches(const std::vector<std::int64_t>& t_ns, double reach_s);

}  // namespace asperity
