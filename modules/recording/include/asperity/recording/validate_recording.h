#pragma once

#include "asperity/recording/recording.h"

namespace asperity {

// Throws Error naming the stream and the row unless the recording keeps the rules that stages rely on:
// times rise strictly, vectors of a stream have one length, accelerations, poses and calibration are
// finite, quaternions are of length one.
void validate_recording(const Recording& recording);

}  // namespace asperity
