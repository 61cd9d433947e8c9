#include "asperity/device/device_registry.h"

#include <functional>
#include <string>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/device/dhd_device.h"
#include "asperity/device/open_audio_sink.h"
#include "asperity/device/open_haply.h"
#include "asperity/device/open_rumble_sink.h"
#include "asperity/device/open_two_diy.h"
#include "asperity/device/open_vibrating.h"
#include "asperity/device/openhaptics_device.h"
#include "asperity/device/replay_device.h"
#include "asperity/device/sim_device.h"

namespace asperity {

namespace {

using Device = std::unique_ptr<HapticDevice>;

// A device with its settings, whose type only its own functions know.
struct DeviceEntry {
  DeviceKind kind;
  std::any config;  // the defaults; empty: there are no settings
  std::function<void(std::any&, ConfigLister&)> visit;
  std::function<bool(const std::any&)> lacks_need;
  std::function<Device(const std::any&, const DeviceDrive&)> open;
};

// The entry of a device with settings. `open` is called with them and the drive.
template <class Config, class Open>
DeviceEntry make_entry(DeviceKind kind, Open open, std::string Config::*need = nullptr) {
  return {kind, Config(), [](std::any& config, ConfigLister& v) { std::any_cast<Config&>(config).visit(v); },
          [need](const std::any& config) { return need && (std::any_cast<const Config&>(config).*need).empty(); },
          [open](const std::any& config, const DeviceDrive& drive) {
            return open(std::any_cast<const Config&>(config), drive);
          }};
}

// Of a device with motors, which a person moves.
template <class Config>
DeviceEntry with_motors(DeviceKind kind, Device (*open)(const Config&), std::string Config::*need = nullptr) {
  return make_entry<Config>(
      kind, [open](const Config& config, const DeviceDrive&) { return open(config); }, need);
}

// Of one without settings.
DeviceEntry without_settings(DeviceKind kind, Device (*open)(const DeviceDrive&)) {
  return {kind, {}, {}, {}, [open](const std::any&, const DeviceDrive& drive) { return open(drive); }};
}

Device open_path(const DeviceDrive& drive) {
  std::vector<ReplaySample> samples;
  samples.reserve(drive.path.size());
  for (const HandPoint& point : drive.path) samples.push_back({point.t_ns, point.p_m});
  return open_replay(std::move(samples));
}

Device open_hand(const DeviceDrive& drive) {
  SimDeviceConfig config;
  config.hand = drive.hand;
  config.rate_Hz = drive.servo_rate_Hz;
  return open_sim(config, drive.path);
}

// What vibrates has no position of its own: a path or the modelled hand moves the point.
Device open_with_sink(const DeviceDrive& drive, std::unique_ptr<VibrationSink> sink) {
  return open_vibrating(drive.is_stroke ? open_hand(drive) : open_path(drive), std::move(sink));
}

Device open_audio(AudioSinkConfig config, const DeviceDrive& drive) {
  config.vibration.servo_rate_Hz = drive.servo_rate_Hz;
  return open_with_sink(drive, open_audio_sink(config));
}

Device open_gamepad(RumbleSinkConfig config, const DeviceDrive& drive) {
  config.servo_rate_Hz = drive.servo_rate_Hz;
  return open_with_sink(drive, open_rumble_sink(config));
}

const std::vector<DeviceEntry>& entries() {
  constexpr DeviceMover kHand = DeviceMover::kModelledHand;
  constexpr NeededSetting kTwoDiyPort{"serial port", "2diy.port", "/dev/ttyACM0"};
  static const std::vector<DeviceEntry> all{
      without_settings({.name = "sim", .title = "Modelled hand", .mover = kHand, .has_person = false}, open_hand),
      without_settings({.name = "replay", .title = "Recorded path", .mover = DeviceMover::kPath, .has_person = false},
                       open_path),
      with_motors<HaplyConfig>({.name = "haply", .title = "Haply Inverse3"}, open_haply),
      with_motors<OpenHapticsConfig>({.name = "openhaptics", .title = "OpenHaptics"}, open_openhaptics),
      with_motors<DhdConfig>({.name = "dhd", .title = "Force Dimension"}, open_dhd),
      with_motors<TwoDiyConfig>({.name = "2diy", .title = "Haply 2diy", .needs = kTwoDiyPort}, open_two_diy,
                                &TwoDiyConfig::port),
      make_entry<AudioSinkConfig>({.name = "audio", .title = "Voice coil", .mover = kHand, .vibrotactile = true},
                                  open_audio),
      make_entry<RumbleSinkConfig>({.name = "gamepad", .title = "Gamepad", .mover = kHand, .vibrotactile = true},
                                   open_gamepad),
  };
  return all;
}

std::vector<DeviceKind> kinds_of(const std::vector<DeviceEntry>& all) {
  std::vector<DeviceKind> out;
  for (const DeviceEntry& each : all) out.push_back(each.kind);
  return out;
}

std::size_t index_of(std::string_view name) {
  for (std::size_t k = 0; k < entries().size(); ++k) {
    if (entries()[k].kind.name == name) return k;
  }
  throw Error("unknown device '" + printable(std::string(name), 100) + "'");
}

// Settings whose type only the entry knows, as ConfigLister takes them.
struct ErasedConfig {
  const DeviceEntry& entry;
  std::any& config;
  void visit(ConfigLister& v) { entry.visit(config, v); }
};

}  // namespace

std::span<const DeviceKind> device_kinds() {
  static const std::vector<DeviceKind> all = kinds_of(entries());
  return all;
}

const DeviceKind* find_device_kind(std::string_view name) {
  for (const DeviceKind& kind : device_kinds()) {
    if (kind.name == name) return &kind;
  }
  return nullptr;
}

DeviceConfigs::DeviceConfigs() {
  for (const DeviceEntry& each : entries()) configs_.push_back(each.config);
}

void DeviceConfigs::visit(ConfigLister& v) {
  for (std::size_t k = 0; k < configs_.size(); ++k) {
    if (!configs_[k].has_value()) continue;
    ErasedConfig config{entries()[k], configs_[k]};
    v.group(entries()[k].kind.name, config);
  }
}

std::any& DeviceConfigs::at(std::string_view name) { return configs_[index_of(name)]; }

std::optional<NeededSetting> DeviceConfigs::missing(std::string_view name) const {
  const std::size_t k = index_of(name);
  const DeviceEntry& found = entries()[k];
  return found.kind.needs && found.lacks_need(configs_[k]) ? found.kind.needs : std::nullopt;
}

std::unique_ptr<HapticDevice> DeviceConfigs::open(std::string_view name, const DeviceDrive& drive) const {
  const std::size_t k = index_of(name);
  return entries()[k].open(configs_[k], drive);
}

}  // namespace asperity
