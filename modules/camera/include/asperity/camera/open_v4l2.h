#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "asperity/camera/camera_source.h"

namespace asperity {

inline constexpr std::array<std::string_view, 5> kV4l2FormatNames = {"any", "grey", "yuyv", "uyvy", "mjpg"};
enum class V4l2Format { kAny, kGrey, kYuyv, kUyvy, kMjpg };

// How a camera is to be set. What is not given is locked at what the camera has found for itself.
struct V4l2Config {
  int width = 0;   // px; 0: as it is set
  int height = 0;  // px
  double rate_Hz = 0.0;
  V4l2Format format = V4l2Format::kAny;  // any: the first it has of grey, yuyv, uyvy, mjpg at that size and rate
  std::optional<double> exposure_s = std::nullopt;
  std::optional<int> gain = std::nullopt;             // in the driver's units
  std::optional<int> white_balance_K = std::nullopt;  // the driver's colour temperature
  std::optional<int> focus = std::nullopt;            // in the driver's units
};

// A camera of Video4Linux2, such as a webcam at /dev/video0, for this process alone while it is open.
//
// Times: the driver's stamp of the buffer where it is of CLOCK_MONOTONIC, by its flags, else the time at which
// the buffer was taken (and a warning). Exposure, gain, white balance and focus are set to manual; warnings() names
// each that cannot be locked: poses drift while a camera adapts. Of several frames that wait the oldest is given
// first; four buffers, so a reader that is late loses frames in the camera.
//
// Throws Error if the device cannot be opened, is not a camera, is used by another, or has no image of the format and
// size asked for: the message states what it has. read() throws LinkLost once it is unplugged; frames that the driver
// marks as damaged are passed over.
std::unique_ptr<CameraSource> open_v4l2(const std::string& device, const V4l2Config& config = {});

}  // namespace asperity
