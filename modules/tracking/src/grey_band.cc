#include "grey_band.h"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

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
  out.pixels.resize(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height));
  if (region.empty()) return out;
  const cv::Mat all(image.height, image.width, CV_8U, const_cast<std::uint8_t*>(image.pixels.data()));
  const cv::Mat part = all(cv::Rect(region.left, region.top, region.width(), region.height()));
  cv::Mat smooth;
  cv::GaussianBlur(part, smooth, cv::Size(), kSmooth_px);
  cv::Mat view(out.height, out.width, CV_8U, out.pixels.data());
  const double gain = 255.0 / band.width;
  smooth.convertTo(view, CV_8U, gain, -gain * band.low);
  return out;
}

}  // namespace asperity
