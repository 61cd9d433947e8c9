#pragma once

#include "asperity/base/progress.h"
#include "asperity/pipeline/process_motion.h"
#include "asperity/pipeline/process_result.h"
#include "kept_stages.h"

namespace asperity {

// The two halves of process_recording() in terms of what still holds of `result` from a run before over the same
// recording; `kept` knows. Both give what they would give with nothing kept, to the last bit.
void run_motion_stages(const Recording& recording, const ProcessConfig& config, KeptStages& kept, ProcessResult& result,
                       const Observer& observer);
void run_surface_stages(const Recording& recording, const ProcessConfig& config, const FindBase& find_base,
                        KeptStages& kept, ProcessResult& result, const Observer& observer);

// The base path by its shape alone (find_base_path.h).
FindBase base_path_finder(const Recording& recording, const ProcessConfig& config);

}  // namespace asperity
