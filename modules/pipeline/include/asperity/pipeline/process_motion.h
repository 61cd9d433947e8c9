#pragma once

#include <functional>

#include "asperity/base/progress.h"
#include "asperity/pipeline/process_config.h"
#include "asperity/pipeline/process_result.h"
#include "asperity/recording/recording.h"

namespace asperity {

// The two halves of process_recording.h, for those that learn the base path's shape in between: from a mesh
// that the motion is registered to.

// The tip's trajectory (seed §4.1 to §4.3) and what is doubtful about it; the rest of the result stays empty.
// Throws as process_recording does.
ProcessResult estimate_motion(const Recording& recording, const ProcessConfig& config, const Observer& observer = {});

// Gives the base path under a motion; may throw Error.
using FindBase = std::function<BasePathResult(const TipMotion& motion)>;

// All that is measured along the path of `result.trajectory` (seed §5.1 to §6.5), into `result`.
void measure_along(const Recording& recording, const ProcessConfig& config, const FindBase& find_base,
                   ProcessResult& result, const Observer& observer = {});

}  // namespace asperity
