#pragma once

#include <memory>

#include "asperity/device/haptic_device.h"
#include "asperity/device/vibration_sink.h"

namespace asperity {

// A device whose position and motors are `hand`'s and whose force is also heard: each write pushes to `sink` its part
// along the contact's slow direction plus its part along the motion (both followed in 50 ms), linear in the force, so
// that a tone keeps its pitch. The sink's high-pass leaves what vibrates: the texture, and taps at a contact's ends.
// What the safety layer takes away is not heard. Named after the sink. A sink that is lost is a fault of the whole.
// Throws Error if one of both is missing.
std::unique_ptr<HapticDevice> open_vibrating(std::unique_ptr<HapticDevice> hand, std::unique_ptr<VibrationSink> sink);

}  // namespace asperity
