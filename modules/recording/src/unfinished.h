#pragma once

#include "asperity/recording/recording.h"

namespace asperity {

// A recorder that died (extra.recorder.state is "recording") could not write down where its last segment ends: it
// then reaches to the last row, and rows that lie behind all that is listed or discarded are one called "unfinished".
// Adds a Problem "unfinished".
void close_unfinished(Recording& recording);

}  // namespace asperity
