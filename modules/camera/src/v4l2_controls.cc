#include "v4l2_controls.h"

#include <fmt/format.h>
#include <linux/videodev2.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "asperity/base/error.h"

namespace asperity {

namespace {

constexpr double kExposureUnit_s = 1e-4;  // of V4L2_CID_EXPOSURE_ABSOLUTE

// A property of the camera: the control that lets it adapt, and the one with its value.
struct Property {
  const char* name;
  std::uint32_t automatic;
  std::vector<int> manual;  // values of `automatic` that stop it, the best first
  std::uint32_t value;
};

std::optional<v4l2_queryctrl> find_control(const V4l2Device& device, std::uint32_t id) {
  v4l2_queryctrl out{};
  out.id = id;
  if (!device.ask(VIDIOC_QUERYCTRL, out) || (out.flags & V4L2_CTRL_FLAG_DISABLED) != 0) return std::nullopt;
  return out;
}

std::optional<int> get_control(const V4l2Device& device, std::uint32_t id) {
  v4l2_control out{};
  out.id = id;
  if (!device.ask(VIDIOC_G_CTRL, out)) return std::nullopt;
  return out.value;
}

bool set_control(const V4l2Device& device, std::uint32_t id, int value) {
  v4l2_control control{};
  control.id = id;
  control.value = value;
  return device.ask(VIDIOC_S_CTRL, control);
}

// The control's present value if it is set and stays; nullopt with a warning if not.
std::optional<int> lock_property(const V4l2Device& device, const Property& property, std::optional<int> wanted,
                                 std::vector<std::string>& warnings) {
  const auto warn = [&](const std::string& why) {
    warnings.push_back(std::string(property.name) + " is not locked: " + why);
    return std::nullopt;
  };
  const auto automatic = find_control(device, property.automatic);
  const auto value = find_control(device, property.value);
  if (!automatic && !value) return warn("the camera has no control for it");
  if (wanted && !value) return warn("the camera has no control for its value");
  if (wanted && (*wanted < value->minimum || *wanted > value->maximum)) {
    throw Error(fmt::format("{}: {} {} is not within {} to {} of the driver's units", device.name(), property.name,
                            *wanted, value->minimum, value->maximum));
  }
  // Read before the camera stops to adapt: what it has found for itself.
  const std::optional<int> present = value ? get_control(device, property.value) : std::nullopt;
  if (automatic) {
    bool stopped = false;
    for (const int manual : property.manual) stopped = stopped || set_control(device, property.automatic, manual);
    if (!stopped) return warn(std::string("the camera keeps adapting it (") + std::strerror(errno) + ")");
    const auto now = get_control(device, property.automatic);
    bool is_manual = !now;
    for (const int manual : property.manual) is_manual = is_manual || *now == manual;
    if (!is_manual) return warn("the camera went back to adapting it");
  }
  if (!value) return std::nullopt;
  const std::optional<int> target = wanted ? wanted : present;
  if (target && !set_control(device, property.value, *target)) {
    if (wanted || automatic) return warn(fmt::format("{} cannot be set ({})", *target, std::strerror(errno)));
  }
  const std::optional<int> now = get_control(device, property.value);
  const int step = std::max(1, value->step);
  if (wanted && now && std::abs(*now - *wanted) >= step) {
    warnings.push_back(fmt::format("{} is {}, not {}", property.name, *now, *wanted));
  }
  return now;
}

void lock_exposure(const V4l2Device& device, const V4l2Config& config, const V4l2Image& image,
                   std::vector<std::string>& warnings) {
  // In some drivers exposure may lengthen the frames even when it is set by hand.
  if (find_control(device, V4L2_CID_EXPOSURE_AUTO_PRIORITY) &&
      !set_control(device, V4L2_CID_EXPOSURE_AUTO_PRIORITY, 0)) {
    warnings.push_back("exposure may lower the rate: the driver keeps that to itself");
  }
  Property exposure{"exposure",
                    V4L2_CID_EXPOSURE_AUTO,
                    {V4L2_EXPOSURE_MANUAL, V4L2_EXPOSURE_SHUTTER_PRIORITY},
                    V4L2_CID_EXPOSURE_ABSOLUTE};
  std::optional<int> wanted;
  if (config.exposure_s) wanted = static_cast<int>(std::max(1L, std::lround(*config.exposure_s / kExposureUnit_s)));
  if (!find_control(device, V4L2_CID_EXPOSURE_ABSOLUTE) && find_control(device, V4L2_CID_EXPOSURE)) {
    if (wanted) {
      warnings.push_back("the exposure was not set: the driver counts it in units of its own");
      wanted.reset();
    }
    exposure.value = V4L2_CID_EXPOSURE;
  }
  const auto now = lock_property(device, exposure, wanted, warnings);
  if (!now || exposure.value != V4L2_CID_EXPOSURE_ABSOLUTE || image.rate_Hz <= 0.0) return;
  const double exposure_s = *now * kExposureUnit_s;
  if (exposure_s * image.rate_Hz > 1.0) {
    warnings.push_back(fmt::format("the exposure of {:.4g} ms is longer than a frame at {:.4g} Hz: the rate drops",
                                   exposure_s * 1e3, image.rate_Hz));
  }
}

}  // namespace

void lock_controls(const V4l2Device& device, const V4l2Config& config, const V4l2Image& image,
                   std::vector<std::string>& warnings) {
  lock_exposure(device, config, image, warnings);
  lock_property(device, {"gain", V4L2_CID_AUTOGAIN, {0}, V4L2_CID_GAIN}, config.gain, warnings);
  if (image.format != V4l2Format::kGrey || config.white_balance_K) {
    lock_property(device, {"white balance", V4L2_CID_AUTO_WHITE_BALANCE, {0}, V4L2_CID_WHITE_BALANCE_TEMPERATURE},
                  config.white_balance_K, warnings);
  }
  lock_property(device, {"focus", V4L2_CID_FOCUS_AUTO, {0}, V4L2_CID_FOCUS_ABSOLUTE}, config.focus, warnings);
}

}  // namespace asperity
