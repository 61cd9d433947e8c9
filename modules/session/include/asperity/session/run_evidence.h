#pragma once

#include "asperity/device/haptic_device.h"
#include "asperity/device/servo_loop.h"
#include "asperity/render/render_model.h"
#include "asperity/session/feel_drive.h"
#include "asperity/session/feel_report.h"
#include "asperity/verdict/judge_rendering.h"

namespace asperity {

// What a run shows of itself, for judge_run (asperity/verdict/judge_rendering.h).
RunEvidence run_evidence(const FeelStatistics& statistics, const ServoResult& servo, const HapticDevice& device,
                         const FeelDrive& drive, const RenderModel& model, const SafetyConfig& safety);

}  // namespace asperity
