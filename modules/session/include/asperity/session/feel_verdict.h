#pragma once

#include <string>
#include <vector>

#include "asperity/device/haptic_device.h"
#include "asperity/device/servo_loop.h"
#include "asperity/render/render_model.h"
#include "asperity/session/feel_drive.h"
#include "asperity/session/feel_report.h"

namespace asperity {

// What is to be said of a run, in words.
struct RunVerdict {
  std::vector<std::string> warnings;
  std::vector<std::string> reasons;  // why it is invalid; empty: it is valid
};

RunVerdict judge_run(const FeelStatistics& statistics, const ServoResult& servo, const HapticDevice& device,
                     const FeelDrive& drive, const RenderModel& model, const SafetyConfig& safety);

}  // namespace asperity
