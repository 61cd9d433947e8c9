#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "asperity/recording/recording.h"

namespace asperity {

// The rows of all streams and of the truth whose t_ns lies from `start_ns` to `end_ns`, both included; of the segments
// the parts therein. Everything else as it is. The result has no row of a stream that has none there.
Recording cut_recording(const Recording& recording, std::int64_t start_ns, std::int64_t end_ns);

// The stretches of a recording that are to be processed each for itself:
// - of what a recorder has made (extra.recorder) each segment; rows outside, discarded ones of a recorder that died,
//   belong to none;
// - of any other recording the segments with less than 0.1 s between them together, under the name of the longest.
// Empty: the recording is to be processed as it is, because it has no segments or no gap between them.
std::vector<Segment> separate_segments(const Recording& recording);

// The segment called `name`. Throws Error naming those that there are if there is none, or more than one.
Segment find_segment(const Recording& recording, const std::string& name);

// A folder's name for each segment: its own, with what is not a letter, a digit, '-', '_' or '.' replaced by '_', at
// most 64 bytes; with its number behind where it is empty, begins with a dot or is there already.
std::vector<std::string> segment_folders(const std::vector<Segment>& segments);

}  // namespace asperity
