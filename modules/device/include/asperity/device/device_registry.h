#pragma once

#include <any>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "asperity/base/config.h"
#include "asperity/device/hand_model_config.h"
#include "asperity/device/hand_path.h"
#include "asperity/device/haptic_device.h"

namespace asperity {

// What moves a device's point.
enum class DeviceMover {
  kPerson,
  kModelledHand,  // or a path, where one is given
  kPath,
};

// A setting without which a device cannot be opened.
struct NeededSetting {
  std::string_view what;     // "serial port"
  std::string_view setting;  // "2diy.port"
  std::string_view example;  // "/dev/ttyACM0"
};

// What is known of a device before it is opened.
struct DeviceKind {
  std::string_view name;   // as of `asperity feel --device`; its settings are a group of this name
  std::string_view title;  // for people
  DeviceMover mover = DeviceMover::kPerson;
  bool has_person = true;     // its force reaches a person: it runs by the clock
  bool vibrotactile = false;  // its force is put out as a vibration
  std::optional<NeededSetting> needs = std::nullopt;

  bool driven() const { return mover != DeviceMover::kPerson; }
};

// All devices, in the order in which they are offered. One entry each in device_registry.cc.
std::span<const DeviceKind> device_kinds();
// Null for a name that is none of theirs.
const DeviceKind* find_device_kind(std::string_view name);

// What moves the point of a device that no person moves.
struct DeviceDrive {
  HandPath path;           // device axes
  bool is_stroke = false;  // of a hand that presses; false: the path is taken exactly
  HandModelConfig hand;    // that follows the path
  double servo_rate_Hz = 1000.0;
};

// The settings of all devices, with which they are opened.
class DeviceConfigs {
 public:
  DeviceConfigs();
  // A group for each device that has settings.
  void visit(ConfigLister& v);

  // Those of one device, by their type. Throws Error for a name that is none, std::bad_any_cast for another type.
  template <class Config>
  Config& get(std::string_view name) {
    return std::any_cast<Config&>(at(name));
  }
  // What the device of this name needs and does not have. Throws Error for a name that is none.
  std::optional<NeededSetting> missing(std::string_view name) const;
  // Opens a device; `drive` matters to driven ones alone. Throws Error in words for one that is not there, and for a
  // name that is none.
  std::unique_ptr<HapticDevice> open(std::string_view name, const DeviceDrive& drive) const;

 private:
  std::any& at(std::string_view name);

  std::vector<std::any> configs_;  // in the order of device_kinds(); empty: the device has no settings
};

}  // namespace asperity
