#include "coverage_raster.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace asperity {

void CoverageRaster::reset(int left, int top, int width, int height) {
  left_ = left;
  top_ = top;
  width_ = width;
  height_ = height;
  steps_.assign(static_cast<std::size_t>(width + 2) * static_cast<std::size_t>(height), 0.0F);
}

void CoverageRaster::add(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double weight) {
  // Window coordinates: the pixel i covers [i, i + 1].
  const Eigen::Vector2d shift(0.5 - left_, 0.5 - top_);
  Eigen::Vector2d upper = from + shift;
  Eigen::Vector2d lower = to + shift;
  double sign = -weight;  // downwards: the area to the right is outside
  if (upper.y() > lower.y()) {
    std::swap(upper, lower);
    sign = weight;
  }
  if (upper.y() == lower.y() || lower.y() <= 0.0 || upper.y() >= height_) return;
  const double slope = (lower.x() - upper.x()) / (lower.y() - upper.y());
  const double width = width_;
  const double first_y = std::max(upper.y(), 0.0);
  double x = upper.x() + (first_y - upper.y()) * slope;
  const int first_row = static_cast<int>(first_y);
  const int end_row = std::min(height_, static_cast<int>(std::ceil(lower.y())));
  for (int row = first_row; row < end_row; ++row) {
    float* const steps = steps_.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(width_ + 2);
    const double dy = std::min<double>(row + 1, lower.y()) - std::max<double>(row, first_y);
    const double next_x = x + slope * dy;
    const double d = dy * sign;
    const double x0 = std::clamp(std::min(x, next_x), 0.0, width);
    const double x1 = std::clamp(std::max(x, next_x), 0.0, width);
    x = next_x;
    const int first = static_cast<int>(x0);
    const int last = static_cast<int>(std::ceil(x1));
    if (last <= first + 1) {
      const double share = 0.5 * (x0 + x1) - first;
      steps[first] += static_cast<float>(d - d * share);
      steps[first + 1] += static_cast<float>(d * share);
      continue;
    }
    const double per_px = d / (x1 - x0);
    double passed = 0.0;  // of d, left of this pixel
    double before = 0.0;  // the area in the pixel before
    for (int column = first; column < last; ++column) {
      const double in = std::max(x0, static_cast<double>(column));
      const double out = std::min(x1, static_cast<double>(column + 1));
      const double here = per_px * (out - in);
      const double area = passed + here * (column + 1 - 0.5 * (in + out));
      steps[column] += static_cast<float>(area - before);
      before = area;
      passed += here;
    }
    steps[last] += static_cast<float>(d - before);
  }
}

void CoverageRaster::finish(std::vector<float>& coverage) const {
  const auto width = static_cast<std::size_t>(width_);
  const auto height = static_cast<std::size_t>(height_);
  coverage.resize(width * height);
  for (std::size_t row = 0; row < height; ++row) {
    const float* const steps = steps_.data() + row * (width + 2);
    float* const out = coverage.data() + row * width;
    double sum = 0.0;
    for (std::size_t column = 0; column < width; ++column) {
      sum += static_cast<double>(steps[column]);
      out[column] = static_cast<float>(sum);
    }
  }
}

int gaussian_reach_px(double sigma_px) { return static_cast<int>(std::ceil(4.0 * sigma_px)); }

void gaussian_blur(std::vector<float>& window, int width, int height, double sigma_px, std::vector<float>& scratch) {
  const int reach = gaussian_reach_px(sigma_px);
  if (reach == 0 || width <= 0 || height <= 0) return;
  std::vector<float> kernel(static_cast<std::size_t>(2 * reach + 1));
  double sum = 0.0;
  for (int i = -reach; i <= reach; ++i) sum += std::exp(-0.5 * i * i / (sigma_px * sigma_px));
  for (int i = -reach; i <= reach; ++i) {
    kernel[static_cast<std::size_t>(i + reach)] =
        static_cast<float>(std::exp(-0.5 * i * i / (sigma_px * sigma_px)) / sum);
  }
  const auto row_size = static_cast<std::size_t>(width);
  scratch.assign(window.size(), 0.0F);
  for (int row = 0; row < height; ++row) {
    float* const out = scratch.data() + static_cast<std::size_t>(row) * row_size;
    for (int i = std::max(-reach, -row); i <= std::min(reach, height - 1 - row); ++i) {
      const float* const in = window.data() + static_cast<std::size_t>(row + i) * row_size;
      const float factor = kernel[static_cast<std::size_t>(i + reach)];
      for (std::size_t column = 0; column < row_size; ++column) out[column] += factor * in[column];
    }
  }
  for (int row = 0; row < height; ++row) {
    const float* const in = scratch.data() + static_cast<std::size_t>(row) * row_size;
    float* const out = window.data() + static_cast<std::size_t>(row) * row_size;
    std::fill(out, out + width, 0.0F);
    for (int i = -reach; i <= reach; ++i) {
      const float factor = kernel[static_cast<std::size_t>(i + reach)];
      const int first = std::max(0, -i);
      const int end = std::min(width, width - i);
      for (int column = first; column < end; ++column) out[column] += factor * in[column + i];
    }
  }
}

}  // namespace asperity
