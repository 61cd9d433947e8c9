#pragma once

#include <cstdint>
#include <vector>

#include "asperity/geometry/pose.h"
#include "asperity/image/gray_image.h"
#include "asperity/simulation/render_tags.h"
#include "asperity/simulation/simulated_camera_config.h"
#include "coverage_raster.h"
#include "printed_figure.h"

namespace asperity {

// The camera at one exposure after another: begin(), draw() from far to near, then expose() or ideal().
class CameraView {
 public:
  explicit CameraView(const SimulatedCameraConfig& config);

  void begin();
  // A figure that moves evenly from one pose to another while the shutter is open.
  void draw(const PrintedFigure& figure, const Pose& T_camera_figure_open, const Pose& T_camera_figure_close);
  void expose(std::uint64_t frame, GrayImage& image);
  void ideal(IdealImage& image) const;

 private:
  bool project_vertices(const PrintedFigure& figure, const Pose& T_camera_figure,
                        std::vector<Eigen::Vector2d>& at_px) const;
  void add_sides(CoverageRaster& raster, const PrintedFigure& figure, const std::vector<PrintedFigure::Side>& sides,
                 const Pose& T_camera_figure, const std::vector<Eigen::Vector2d>& at_px, double weight) const;
  void make_background();

  SimulatedCameraConfig config_;
  CameraCalibration camera_;
  double greatest_tangent_ = 0.0;   // of the angle to the axis at which anything is drawn
  std::vector<float> light_;        // the part that vignetting leaves, a pixel each
  std::vector<float> background_;   // counts
  std::vector<float> brightness_;   // of the frame under way
  std::vector<float> normal_;       // standard normal deviates, equally likely
  std::vector<float> noise_sigma_;  // by brightness, counts
  CoverageRaster ink_, card_;
  std::vector<float> ink_cover_, card_cover_, scratch_;
  std::vector<std::vector<Eigen::Vector2d>> at_px_;  // by sub-exposure
  std::vector<Pose> poses_;
};

}  // namespace asperity
