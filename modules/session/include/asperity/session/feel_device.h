#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "asperity/device/haptic_device.h"
#include "asperity/session/feel_drive.h"
#include "asperity/session/feel_settings.h"

namespace asperity {

// What is known of a device's name.
struct DeviceKind {
  std::string_view name;
  bool driven = false;  // its point is moved by a FeelDrive
  bool felt = true;     // a person is at it: it runs by the clock
};

// nullopt for a name that --device does not take.
std::optional<DeviceKind> device_kind(std::string_view name);

// Opens a device by its name. The axes of driven ones are the scene's world. Throws Error in words for one that is not
// there.
std::unique_ptr<HapticDevice> open_device(const std::string& device, const FeelDrive& drive,
                                          const FeelSettings& settings);

}  // namespace asperity
