#include "grey_band.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "asperity/vision/vision.h"

namespace asperity {

std::vector<GreyBand> grey_bands() {
  constexpr int kWidth = 64, kStep = 32;
  std::vector<GreyBand> out;
  for (int low = 0; low + kWidth <= 256; low += kStep) out.push_back({low, kWidth});
  return out;
}

GrayImage stretch_band(const GrayImage& image, const ImageRegion& region, const GreyBand& band) {
  constexpr double kSmooth_px = 0.8;
  GrayImage out;
  out.width = region.width();
  out.height = region.height();
  if (region.empty()) return out;
  out = vision().blur(image, {region.left, region.top, out.width, out.height}, kSmooth_px);
  const double gain = 255.0 / band.width;
  for (std::uint8_t& level : out.pixels) {
    level = static_cast<std::uint8_t>(std::clamp(std::nearbyint(gain * (level - band.low)), 0.0, 255.0));
  }
  return out;
}

}  // namespace asperity
