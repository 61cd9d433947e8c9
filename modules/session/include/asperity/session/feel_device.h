#pragma once

#include <memory>
#include <string>

#include "asperity/device/haptic_device.h"
#include "asperity/session/feel_drive.h"
#include "asperity/session/feel_settings.h"

namespace asperity {

// Opens a device of the registry (device_registry.h) with its settings; a driven one takes the path or the stroke of
// `drive`. The axes of driven ones are the scene's world. Throws Error in words for one that is not there.
std::unique_ptr<HapticDevice> open_device(const std::string& device, const FeelDrive& drive,
                                          const FeelSettings& settings);

}  // namespace asperity
