#pragma once

#include <span>

#include "asperity/rig/check_rig.h"

namespace asperity {

// Fills faults, remarks, right and verdict of a check whose figures are complete.
void judge_rig(std::span<const NamedRecording> strokes, const CheckRigConfig& config, RigCheck& check);

}  // namespace asperity
