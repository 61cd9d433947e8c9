#pragma once

#include <memory>

#include "asperity/device/haptic_device.h"
#include "asperity/device/vibration_sink.h"

namespace asperity {

// A device whose position and motors are `hand`'s and whose force is also heard: each write pushes |force_N| to
// `sink`, whose high-pass leaves what vibrates: the texture, and the taps at the begin and end of a contact.
// What the safety layer takes away is not heard. Named after the sink. A sink that is lost is a fault of the whole.
// Throws Error if one of both is missing.
std::unique_ptr<HapticDevice> open_vibrating(std::unique_ptr<HapticDevice> hand, std::unique_ptr<VibrationSink> sink);

}  // namespace asperity
