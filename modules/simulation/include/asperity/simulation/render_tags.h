#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "asperity/geometry/pose.h"
#include "asperity/image/gray_image.h"
#include "asperity/recording/calibration.h"
#include "asperity/simulation/simulated_camera_config.h"

namespace asperity {

// Brightness before noise and rounding, in counts, row by row as a GrayImage.
struct IdealImage {
  int width = 0;
  int height = 0;
  std::vector<float> counts;

  double at(int column, int row) const {
    return static_cast<double>(
        counts[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column)]);
  }
};

// The camera's view of a body of tags. World is the camera's frame. What is computed (docs/live-bench.md):
//   each cell's outline, projected exactly (camera_model.h) in pieces of at most 4 px, gives the exact area that ink
//   and paper cover of each pixel, averaged over the poses of the exposure; this is blurred by the lens at the tag's
//   distance, shaded and laid over the background; then come shot and read noise and rounding.
// Tags in one plane whose white margins of one cell meet are printed on one card.
// Tags that face away, or of which a corner is behind the camera or far outside of its view, are not drawn. The same
// config, poses and frame number give the same bytes. Not thread-safe.
class TagRenderer {
 public:
  // Throws Error for an unknown tag family or id, a size that is not positive, or a camera that cannot be.
  TagRenderer(const SimulatedCameraConfig& config, const std::vector<MarkerPlacement>& tags);
  ~TagRenderer();
  TagRenderer(TagRenderer&&) noexcept;
  TagRenderer& operator=(TagRenderer&&) noexcept;

  // One exposure, in which the body moves evenly from the first pose to the second. `frame` chooses the noise. `image`
  // is given its size; its memory is used again.
  void render(const Pose& T_world_marker_open, const Pose& T_world_marker_close, std::uint64_t frame, GrayImage& image);

  // The same without noise and rounding.
  void render_ideal(const Pose& T_world_marker_open, const Pose& T_world_marker_close, IdealImage& image);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace asperity
