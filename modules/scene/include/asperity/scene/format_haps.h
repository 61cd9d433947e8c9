#pragma once

#include <span>
#include <string>

#include "asperity/scene/format_ahap.h"

namespace asperity {

// A vibration as Interhaptics' .haps, version 6, as the MPEG haptic reference software reads it (HapsEncoder): one
// melody of one sine note whose amplitude (amplitude / full_scale, at most 1) and pitch are curves of keyframes.
// Positions are seconds; a pitch of 0 to 1 lies between frequency_range min and max, the lowest and highest frequency
// of the points in whole hertz. All numbers are written with a decimal point, as that reader wants. Throws Error as
// format_ahap does.
std::string format_haps(std::span<const VibrationPoint> points, double duration_s, double full_scale,
                        const VibrationNote& note);

}  // namespace asperity
