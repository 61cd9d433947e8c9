#include "asperity/session/feel_device.h"

#include <array>
#include <utility>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/device/open_vibrating.h"
#include "asperity/device/replay_device.h"
#include "asperity/device/sim_device.h"

namespace asperity {

namespace {

std::unique_ptr<HapticDevice> open_replay_of(const DevicePath& path) {
  std::vector<ReplaySample> samples;
  samples.reserve(path.size());
  for (std::size_t i = 0; i < path.size(); ++i) samples.push_back({path.t_ns[i], path.p_world_m[i]});
  return open_replay(std::move(samples));
}

// A hand pulled along a path presses by its own spring alone; along a stroke, by the force that is asked for.
std::unique_ptr<HapticDevice> open_hand(const FeelDrive& drive, const FeelSettings& settings) {
  SimDeviceConfig config;
  config.hand = settings.hand;
  config.rate_Hz = settings.servo.rate_Hz;
  const DevicePath& path = drive.stroke ? drive.stroke->path : *drive.path;
  if (drive.stroke) {
    for (std::size_t k = 0; k < 3; ++k) {
      config.hand.press_direction[k] = drive.stroke->press_direction_world[static_cast<Eigen::Index>(k)];
    }
  } else {
    config.hand.press_adaptation_s = 0.0;
  }
  HandPath points;
  points.reserve(path.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    points.push_back({path.t_ns[i], path.p_world_m[i], drive.stroke ? drive.stroke->press_N[i] : 0.0});
  }
  return open_sim(config, std::move(points));
}

}  // namespace

std::optional<DeviceKind> device_kind(std::string_view name) {
  constexpr std::array<DeviceKind, 8> kKinds{{{"sim", true, false},
                                              {"replay", true, false},
                                              {"haply", false, true},
                                              {"openhaptics", false, true},
                                              {"dhd", false, true},
                                              {"2diy", false, true},
                                              {"audio", true, true},
                                              {"gamepad", true, true}}};
  for (const DeviceKind& kind : kKinds) {
    if (kind.name == name) return kind;
  }
  return std::nullopt;
}

std::unique_ptr<HapticDevice> open_device(const std::string& device, const FeelDrive& drive,
                                          const FeelSettings& settings) {
  if (device == "sim") return open_hand(drive, settings);
  if (device == "replay") return open_replay_of(*drive.path);
  if (device == "haply") return open_haply(settings.haply);
  if (device == "openhaptics") return open_openhaptics(settings.openhaptics);
  if (device == "dhd") return open_dhd(settings.dhd);
  if (device == "2diy") return open_two_diy(settings.two_diy);
  // What vibrates has no position of its own: a path or the modelled hand moves the point.
  std::unique_ptr<HapticDevice> hand = drive.stroke ? open_hand(drive, settings) : open_replay_of(*drive.path);
  if (device == "audio") {
    AudioSinkConfig config = settings.audio;
    config.vibration.servo_rate_Hz = settings.servo.rate_Hz;
    return open_vibrating(std::move(hand), open_audio_sink(config));
  }
  if (device == "gamepad") {
    RumbleSinkConfig config = settings.gamepad;
    config.servo_rate_Hz = settings.servo.rate_Hz;
    return open_vibrating(std::move(hand), open_rumble_sink(config));
  }
  throw Error("--device " + device + ": no such device");
}

}  // namespace asperity
