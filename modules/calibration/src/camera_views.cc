#include "camera_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

namespace {

double cross(const Eigen::Vector2d& o, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return (a.x() - o.x()) * (b.y() - o.y()) - (a.y() - o.y()) * (b.x() - o.x());
}

// Andrew's monotone chain (1979).
double hull_area(std::vector<Eigen::Vector2d> points) {
  std::sort(points.begin(), points.end(), [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  std::vector<Eigen::Vector2d> hull(2 * points.size());
  std::size_t size = 0;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t base = size;
    for (const Eigen::Vector2d& p : points) {
      while (size >= base + 2 && cross(hull[size - 2], hull[size - 1], p) <= 0.0) --size;
      hull[size++] = p;
    }
    if (size > 0) --size;  // the last point begins the other chain
    std::reverse(points.begin(), points.end());
  }
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < size; ++i) twice += cross(hull[0], hull[i], hull[i + 1]);
  return 0.5 * twice;
}

}  // namespace

void check_views(std::span<const BoardView> views, int width, int height, const CameraFitConfig& config) {
  constexpr int kLargestSide = 100'000;
  constexpr std::size_t kFewestCorners = 8;
  if (width < 1 || height < 1 || width > kLargestSide || height > kLargestSide) {
    throw Error(fmt::format("calibrate camera: image size {}x{}", width, height));
  }
  if (views.size() < static_cast<std::size_t>(config.least_views)) {
    throw Error(
        fmt::format("calibrate camera: {} views of the board, at least {} are needed: take 15 to 25 images, the board "
                    "whole, sharp, tilted by 20 to 45 degrees in turn to all sides, and also in the image's corners",
                    views.size(), config.least_views));
  }
  for (const BoardView& view : views) {
    if (view.corner_px.size() < kFewestCorners || view.corner_px.size() != view.p_board_m.size()) {
      throw Error(
          fmt::format("calibrate camera: {}: {} corners for {} places on the board, must be as many and at least {}",
                      printable(view.name), view.corner_px.size(), view.p_board_m.size(), kFewestCorners));
    }
    for (const Eigen::Vector2d& pixel : view.corner_px) {
      if (pixel.x() >= -0.5 && pixel.y() >= -0.5 && pixel.x() <= width - 0.5 && pixel.y() <= height - 0.5) continue;
      throw Error(fmt::format("calibrate camera: {}: corner ({}, {}) px outside its image of {}x{} px",
                              printable(view.name), pixel.x(), pixel.y(), width, height));
    }
  }
}

double image_coverage(std::span<const BoardView* const> views, int width, int height) {
  std::vector<Eigen::Vector2d> corners;
  for (const BoardView* view : views) corners.insert(corners.end(), view->corner_px.begin(), view->corner_px.end());
  return hull_area(std::move(corners)) / (static_cast<double>(width) * static_cast<double>(height));
}

void refuse_narrow_coverage(double coverage, const CameraFitConfig& config) {
  if (coverage >= config.least_coverage) return;
  throw Error(fmt::format(
      "calibrate camera: the board was always in one part of the image ({:.0f} % of it, at least {:.0f} % are "
      "needed), which does not determine the distortion: take images with the board in every corner",
      100.0 * coverage, 100.0 * config.least_coverage));
}

}  // namespace asperity
