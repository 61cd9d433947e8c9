#pragma once

#include <memory>
#include <string>

#include "asperity/device/haptic_device.h"
#include "feel_drive.h"
#include "feel_settings.h"

namespace asperity::app {

// True for devices whose hand is computed: they need no clock.
bool is_computed(const std::string& device);

// Opens a device by the name that --device takes. The axes of computed ones are the scene's world. Throws Error in
// words for one that is not there.
std::unique_ptr<HapticDevice> open_device(const std::string& device, const FeelDrive& drive,
                                          const FeelSettings& settings);

}  // namespace asperity::app
