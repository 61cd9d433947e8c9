#pragma once

#include <vector>

#include <Eigen/Core>

namespace asperity {

// The exact area of each pixel that lies inside closed outlines, in a window of the image. Each piece of an outline
// adds the area to its right in each row, signed by its direction, and a running sum along the row finishes it:
// outlines that go clockwise as seen (y down) count positive, common sides of neighbours cancel.
class CoverageRaster {
 public:
  // An empty window; its memory is used again. Its first pixel's centre is at (left, top).
  void reset(int left, int top, int width, int height);

  // A straight piece of an outline, pixel coordinates, times `weight`. Beyond the window's left border it counts as on
  // it, exact if no piece crosses the border.
  void add(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double weight);

  // Turns what was added into coverage, row by row, `width` values each.
  void finish(std::vector<float>& coverage) const;

  int left() const { return left_; }
  int top() const { return top_; }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  int left_ = 0, top_ = 0, width_ = 0, height_ = 0;
  std::vector<float> steps_;  // width + 2 a row
};

// Convolves a window of `width` × `height` with a Gaussian, separably; what lies outside counts as 0. `scratch` is for
// its use.
void gaussian_blur(std::vector<float>& window, int width, int height, double sigma_px, std::vector<float>& scratch);

// How far such a blur reaches, px.
int gaussian_reach_px(double sigma_px);

}  // namespace asperity
