#pragma once

#include <span>
#include <string>

#include "asperity/scene/vibration_envelope.h"

namespace asperity {

// The frequencies between which sharpness 0 and 1 are taken. Apple states none; these are those of the MPEG haptic
// reference software's reader of AHAP.
inline constexpr double kSharpnessLow_Hz = 65.0, kSharpnessHigh_Hz = 300.0;

// What describes a vibration to people, in the file's metadata.
struct VibrationNote {
  std::string name;
  std::string text;  // units, what was stroked, warnings
};

// A vibration as Apple Haptic and Audio Pattern 1.0: HapticContinuous events of at most 30 s at full intensity, and
// curves of HapticIntensityControl (amplitude / full_scale, at most 1) and HapticSharpnessControl (frequency between
// the two above, clamped), of at most 16 points each, from time 0 on. Times in seconds. The same points give the same
// bytes. Throws Error without points or for a full scale that is not positive.
std::string format_ahap(std::span<const VibrationPoint> points, double duration_s, double full_scale,
                        const VibrationNote& note);

}  // namespace asperity
