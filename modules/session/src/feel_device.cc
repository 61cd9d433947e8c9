#include "asperity/session/feel_device.h"

namespace asperity {

namespace {

// A hand pulled along a path presses by its own spring alone; along a stroke, by the force that is asked for.
DeviceDrive device_drive(const FeelDrive& drive, const FeelSettings& settings) {
  DeviceDrive out;
  out.hand = settings.hand;
  out.servo_rate_Hz = settings.servo.rate_Hz;
  out.is_stroke = drive.stroke.has_value();
  if (!drive.stroke && !drive.path) return out;
  const DevicePath& path = drive.stroke ? drive.stroke->path : *drive.path;
  if (drive.stroke) {
    for (std::size_t k = 0; k < 3; ++k) {
      out.hand.press_direction[k] = drive.stroke->press_direction_world[static_cast<Eigen::Index>(k)];
    }
  } else {
    out.hand.press_adaptation_s = 0.0;
  }
  out.path.reserve(path.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    out.path.push_back({path.t_ns[i], path.p_world_m[i], drive.stroke ? drive.stroke->press_N[i] : 0.0});
  }
  return out;
}

}  // namespace

std::unique_ptr<HapticDevice> open_device(const std::string& device, const FeelDrive& drive,
                                          const FeelSettings& settings) {
  return settings.devices.open(device, device_drive(drive, settings));
}

}  // namespace asperity
