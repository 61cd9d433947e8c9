#pragma once

#include <memory>

#include "asperity/recording/recording.h"
#include "scan/scan_source.h"

namespace asperity::studio {

// A recording played in real time, row by row, its times moved to now, at each start. It has no images.
// Throws Error for a recording without probe rows.
std::unique_ptr<ScanSource> make_replay_source(Recording recording);

}  // namespace asperity::studio
