#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "v4l2_system.h"

namespace asperity {

// A kind of image that a camera has, at one size.
struct V4l2Mode {
  std::uint32_t fourcc = 0;
  int width = 0, height = 0;
  double fastest_Hz = 0.0;  // 0: not told
};

// The format on the wire that was agreed on with the driver.
struct V4l2Image {
  V4l2Format format = V4l2Format::kAny;
  int width = 0, height = 0;
  std::size_t bytes_per_line = 0;
  double rate_Hz = 0.0;  // 0: not told
};

// All modes; for sizes within a range its least and its largest. At most 1000.
std::vector<V4l2Mode> list_modes(const V4l2Device& device);

// Chooses and sets format, size and rate as asked for. Throws Error saying what there is; a rate that the driver
// changes is added to `warnings`.
V4l2Image agree_on_format(const V4l2Device& device, const V4l2Config& config, std::vector<std::string>& warnings);

}  // namespace asperity
