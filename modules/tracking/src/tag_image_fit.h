#pragma once

#include <vector>

#include <Eigen/Core>

#include "asperity/tracking/refine_corners.h"

namespace asperity {

inline constexpr int kFitUnknowns = 18;
using FitVector = Eigen::Matrix<double, kFitUnknowns, 1>;
using FitMatrix = Eigen::Matrix<double, kFitUnknowns, kFitUnknowns>;

// The unknowns of refine_corners. Places in the image without distortion are in half sides of the tag from
// its centre, so that all of `homography` is of order one; its last element is 1.
struct TagImageState {
  Eigen::Matrix<double, 8, 1> homography;  // by rows, from the tag's (x, y) in [−1, 1]²
  Eigen::Vector3d spread_px2;              // xx, xy, yy
  Eigen::Matrix<double, 6, 1> shading;     // β at the centre, by x, by y; γ likewise: grey levels

  double growth_px = 0.0;  // by which white seems to have grown into black

  void add(const FitVector& step);
};

// A pixel to be compared.
struct TagPixel {
  double qx = 0.0, qy = 0.0;  // its place without distortion, in half sides from the tag's centre
  double grey = 0.0;
};

// The model of refine_corners at one pixel.
class TagImageModel {
 public:
  // `px_by_q`: how the pixel moves with its place (qx, qy), at the tag's centre.
  TagImageModel(const TagPattern& pattern, const Eigen::Matrix2d& px_by_q);

  // Where the picture's point that is seen at (qx, qy) lies, in cells, and the spread there, in cells.
  struct Place {
    double x = 0.0, y = 0.0, w = 1.0;
    Eigen::Matrix2d x_by_q;
    double u = 0.0, v = 0.0, sigma_u = 0.0, sigma_v = 0.0, covariance_uv = 0.0;
    Eigen::Vector2d u_by_px, v_by_px;
  };
  Place place(const TagImageState& state, double qx, double qy) const;
  int cells() const { return pattern_->cells; }

  // The grey level, and its derivative by the unknowns.
  double grey(const TagImageState& state, const TagPixel& pixel, FitVector& by_state) const;

 private:
  const TagPattern* pattern_;
  double cells_per_x_;  // half the border
  Eigen::Matrix2d q_by_px_;
};

struct TagImageFit {
  TagImageState state;
  Eigen::Matrix<double, 8, 8> covariance;  // of `homography`
  double residual = 0.0;
  int iterations = 0;
  bool converged = false;
};

// The robust least squares of refine_corners over `pixels`.
TagImageFit fit_tag_image(const TagImageModel& model, const std::vector<TagPixel>& pixels, const TagImageState& start,
                          const RefineCornersConfig& config);

}  // namespace asperity
