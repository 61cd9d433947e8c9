#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/base/progress.h"
#include "asperity/device/device_registry.h"
#include "asperity/device/pointer_device.h"
#include "asperity/render/render_model.h"
#include "asperity/session/feel_drive.h"
#include "feel/feel_setup.h"

namespace asperity::studio {

// Devices are those of the registry, and "mouse", the pointer of a browser.
bool is_feel_device(std::string_view name);
// Throws Error for a name that is none.
const DeviceKind& feel_device_kind(std::string_view name);

// All devices: [{"name","title","available","words"}]. Nothing is opened for it: what only opening it can show is
// stated as such.
Json feel_devices_json(const FeelConfig& start);

// A device that is open, and what it is to feel.
struct OpenedFeel {
  DeviceKind kind;
  std::unique_ptr<HapticDevice> device;
  DeviceInfo info;
  std::shared_ptr<PointerTargets> targets;  // of the mouse, else null
  FeelDrive drive;
  FeelConfig config;  // with the device placed in the scene
  std::unique_ptr<const RenderModel> model;
  std::vector<std::string> warnings;
};

// Opens the device of `setup` for a scene that was read from it. Not for the studio's thread: drivers take their time.
// Throws Error in words for a device that is not there.
OpenedFeel open_feel(const FeelSetup& setup, const Scene& scene, const Observer& observer);

}  // namespace asperity::studio
