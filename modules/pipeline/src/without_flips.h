#pragma once

#include "asperity/recording/recording.h"

namespace asperity {

// The recording without the poses that are far from the median of their neighbours (pose_path.h): flips of the tracker.
Recording without_flips(const Recording& recording);

}  // namespace asperity
