#pragma once

#include "asperity/base/progress.h"
#include "asperity/pipeline/process_config.h"
#include "asperity/pipeline/process_result.h"
#include "asperity/recording/recording.h"

namespace asperity {

// From a raw recording to a haptic texture, one stage after the other (seed §4 to §6.5): the tip's
// trajectory, the base path under it, the height along it, roughness, compliance, texture; and the
// accuracy where the recording has a truth. Lengths in metres, the world frame is the tracker's.
// Throws Error if the recording or a setting does not allow a profile at all, and Cancelled.
ProcessResult process_recording(const Recording& recording, const ProcessConfig& config, const Observer& observer = {});

// The same by a method that need not be in the table: `config.method` says nothing then.
ProcessResult process_recording(const Recording& recording, const ProcessConfig& config, const ProcessMethod& method,
                                const Observer& observer = {});

}  // namespace asperity
