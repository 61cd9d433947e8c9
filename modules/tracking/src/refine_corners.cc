#include "asperity/tracking/refine_corners.h"

#include <algorithm>
#include <cmath>

#include "asperity/algebra/solve.h"
#include "asperity/recording/camera_model.h"
#include "blurred_pattern.h"
#include "tag_image_fit.h"

namespace asperity {
namespace {

using Corners = Eigen::Matrix<double, 2, 4>;

constexpr double kTagX[4] = {-1.0, 1.0, 1.0, -1.0};
constexpr double kTagY[4] = {-1.0, -1.0, 1.0, 1.0};

// Tag coordinates to the corners `q`, the last element 1.
std::optional<Eigen::Matrix<double, 8, 1>> homography_of(const Corners& q) {
  Eigen::Matrix<double, 8, 8> A;
  Eigen::Matrix<double, 8, 1> b;
  for (int i = 0; i < 4; ++i) {
    const double x = kTagX[i], y = kTagY[i];
    A.row(2 * i) << x, y, 1.0, 0.0, 0.0, 0.0, -q(0, i) * x, -q(0, i) * y;
    A.row(2 * i + 1) << 0.0, 0.0, 0.0, x, y, 1.0, -q(1, i) * x, -q(1, i) * y;
    b.segment<2>(2 * i) = q.col(i);
  }
  const Eigen::Matrix<double, 8, 1> h = solve_square(A, b);
  if (!h.allFinite()) return std::nullopt;
  return h;
}

// The corners of a homography, and their derivative by it.
Corners corners_of(const Eigen::Matrix<double, 8, 1>& h, Eigen::Matrix<double, 8, 8>& by_h) {
  Corners q;
  for (int i = 0; i < 4; ++i) {
    const double x = kTagX[i], y = kTagY[i], w = h[6] * x + h[7] * y + 1.0;
    q.col(i) = Eigen::Vector2d(h[0] * x + h[1] * y + h[2], h[3] * x + h[4] * y + h[5]) / w;
    by_h.row(2 * i) << x / w, y / w, 1.0 / w, 0.0, 0.0, 0.0, -q(0, i) * x / w, -q(0, i) * y / w;
    by_h.row(2 * i + 1) << 0.0, 0.0, 0.0, x / w, y / w, 1.0 / w, -q(1, i) * x / w, -q(1, i) * y / w;
  }
  return q;
}

// The image without distortion, in units of the tag: its centre and its half side there.
struct TagView {
  const CameraCalibration* camera;
  Eigen::Vector2d centre_px;
  double half_px;

  std::optional<Eigen::Vector2d> undistorted(const Eigen::Vector2d& pixel) const {
    const auto ray = unproject(*camera, pixel);
    if (!ray) return std::nullopt;
    return Eigen::Vector2d(
        (Eigen::Vector2d(camera->fx * ray->x() + camera->cx, camera->fy * ray->y() + camera->cy) - centre_px) /
        half_px);
  }
  // The same from a place close by, by Newton's steps until nothing is left; as exact, at a fraction of the time.
  bool undistort_near(const Eigen::Vector2d& pixel, Eigen::Vector2d& q) const {
    constexpr int kMostSteps = 4;
    constexpr double kClose_px = 1e-7;
    for (int i = 0; i < kMostSteps; ++i) {
      const Projection here = seen(q);
      const Eigen::Vector2d miss_px = pixel - here.pixel;
      const auto& J = here.by_point;
      const double determinant = J(0, 0) * J(1, 1) - J(0, 1) * J(1, 0);
      if (!(determinant > 0.0)) return false;
      q += Eigen::Vector2d(J(1, 1) * miss_px.x() - J(0, 1) * miss_px.y(),
                           J(0, 0) * miss_px.y() - J(1, 0) * miss_px.x()) /
           determinant;
      // What a step leaves is of the square of what it took away.
      if (miss_px.squaredNorm() < kClose_px) return true;
    }
    return false;
  }
  // The pixel of a place, and how it moves with it.
  Projection seen(const Eigen::Vector2d& q) const {
    const Eigen::Vector2d ideal = centre_px + half_px * q;
    const Eigen::Vector3d ray((ideal.x() - camera->cx) / camera->fx, (ideal.y() - camera->cy) / camera->fy, 1.0);
    Projection out = *project_with_derivative(*camera, ray);
    out.by_point.col(0) *= half_px / camera->fx;
    out.by_point.col(1) *= half_px / camera->fy;
    return out;
  }
};

// True if two cells of unlike colour meet within `reach_px` along a row or a column of the picture.
bool near_edge(const TagPattern& pattern, const TagImageModel::Place& at, double reach_px) {
  const int column = static_cast<int>(at.u), row = static_cast<int>(at.v);
  const auto differs = [&](double place, double cells_per_px, int dc, int dr) {
    const double inside = place - std::floor(place);
    const int side = inside < 0.5 ? -1 : 1;
    const double away = side < 0 ? inside : 1.0 - inside;
    if (away > reach_px * cells_per_px) return false;
    const int c = column + side * dc, r = row + side * dr;
    if (c < 0 || r < 0 || c >= pattern.cells || r >= pattern.cells) return false;
    return pattern.is_white(c, r) != pattern.is_white(column, row);
  };
  return differs(at.u, at.u_by_px.norm(), 1, 0) || differs(at.v, at.v_by_px.norm(), 0, 1);
}

// The pixels of the tag at which its picture says something: those near edges, and a quarter of the rest.
std::vector<TagPixel> choose_pixels(const GrayImage& image, const TagView& view, const TagPattern& pattern,
                                    const TagImageModel& model, const TagImageState& state, const Corners& corners_px,
                                    int most) {
  // The picture's own border and the blur of what lies behind it stay outside.
  const TagImageModel::Place middle = model.place(state, 0.0, 0.0);
  const double blur = std::max(middle.sigma_u, middle.sigma_v);
  const double inset = std::min(2.5 * blur + 0.1, std::max(0.7 * pattern.margin, 0.1));
  const double reach = (pattern.cells - 2.0 * inset) / pattern.border_cells();
  Corners box;
  for (int i = 0; i < 4; ++i) {
    const auto& h = state.homography;
    const double x = kTagX[i] * reach, y = kTagY[i] * reach, w = h[6] * x + h[7] * y + 1.0;
    if (!(w > 0.0)) return {};
    box.col(i) = view.seen(Eigen::Vector2d(h[0] * x + h[1] * y + h[2], h[3] * x + h[4] * y + h[5]) / w).pixel;
  }
  if (!box.allFinite()) return {};
  // Lens distortion bends the sides outwards by far less than this.
  constexpr double kBend_px = 2.0;
  const Eigen::Vector2d low = box.rowwise().minCoeff().cwiseMin(corners_px.rowwise().minCoeff()).array() - kBend_px;
  const Eigen::Vector2d high = box.rowwise().maxCoeff().cwiseMax(corners_px.rowwise().maxCoeff()).array() + kBend_px;
  const int left = std::max(0, static_cast<int>(std::floor(std::max(low.x(), -1.0))));
  const int top = std::max(0, static_cast<int>(std::floor(std::max(low.y(), -1.0))));
  const int right = std::min(image.width - 1, static_cast<int>(std::ceil(std::min(high.x(), 1.0 * image.width))));
  const int bottom = std::min(image.height - 1, static_cast<int>(std::ceil(std::min(high.y(), 1.0 * image.height))));

  std::vector<TagPixel> out;
  out.reserve(static_cast<std::size_t>(std::max(0, right - left + 1)) *
              static_cast<std::size_t>(std::max(0, bottom - top + 1)));
  // Two spreads, and as far as the detector may have been off.
  const auto& spread = state.spread_px2;
  const double reach_px = 0.5 + 2.0 * std::sqrt(0.5 * (spread[0] + spread[2]));
  // Half of a tag's pixels are near edges; where there are many, only every stride-th is looked at.
  const double area_px2 = (high - low).prod();
  const int stride = std::max(1, static_cast<int>(0.4 * area_px2 / most));
  for (int row = top; row <= bottom; ++row) {
    Eigen::Vector2d q = Eigen::Vector2d::Zero(), step = Eigen::Vector2d::Zero();
    bool known = false;
    // Each row begins elsewhere, so that no column is left out for good.
    for (int column = left + (row * 5) % stride; column <= right; column += stride) {
      const Eigen::Vector2d pixel(column, row), previous = q;
      q += step;
      if (!known || !view.undistort_near(pixel, q)) {
        const auto start = view.undistorted(pixel);
        known = false;
        step.setZero();
        if (!start) continue;
        q = *start;
      } else {
        step = q - previous;
      }
      known = true;
      const TagImageModel::Place at = model.place(state, q.x(), q.y());
      if (!(at.w > 0.0) || !(at.u > inset) || !(at.v > inset) || !(at.u < pattern.cells - inset) ||
          !(at.v < pattern.cells - inset)) {
        continue;
      }
      if (!near_edge(pattern, at, reach_px) && ((row / 2 + column / 2) & 3) != 0) continue;
      out.push_back({q.x(), q.y(), static_cast<double>(image.at(column, row))});
    }
  }
  if (out.size() <= static_cast<std::size_t>(most)) return out;
  const double share = static_cast<double>(most) / static_cast<double>(out.size());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (std::floor(static_cast<double>(i + 1) * share) > std::floor(static_cast<double>(i) * share))
      out[kept++] = out[i];
  }
  out.resize(kept);
  return out;
}

// Black and white from the pixels in the middle of cells; false where they are not told apart.
bool begin_shading(const TagPattern& pattern, const TagImageModel& model, const std::vector<TagPixel>& pixels,
                   TagImageState& state) {
  double sum[2] = {0.0, 0.0};
  int count[2] = {0, 0};
  for (const TagPixel& pixel : pixels) {
    const TagImageModel::Place at = model.place(state, pixel.qx, pixel.qy);
    const double value = blurred_pattern(pattern, at.u, at.v, at.sigma_u, at.sigma_v).value;
    if (value > 0.2 && value < 0.8) continue;
    sum[value >= 0.8 ? 1 : 0] += pixel.grey;
    ++count[value >= 0.8 ? 1 : 0];
  }
  if (count[0] == 0 || count[1] == 0) return false;
  const double black = sum[0] / count[0], white = sum[1] / count[1];
  constexpr double kLeastContrast = 5.0;  // grey levels
  state.shading << black, 0.0, 0.0, white - black, 0.0, 0.0;
  return white - black >= kLeastContrast;
}

}  // namespace

std::optional<RefinedCorners> refine_corners(const GrayImage& image, const CameraCalibration& camera,
                                             const TagPattern& pattern, const Corners& corners_px,
                                             const PointSpread& spread, const RefineCornersConfig& config) {
  if (pattern.border_cells() < 1 || !corners_px.allFinite()) return std::nullopt;
  TagView view{&camera, Eigen::Vector2d::Zero(), 1.0};
  Corners ideal_px;
  for (int i = 0; i < 4; ++i) {
    const auto q = view.undistorted(corners_px.col(i));
    if (!q) return std::nullopt;
    ideal_px.col(i) = *q;
  }
  view.centre_px = ideal_px.rowwise().mean();
  view.half_px =
      0.25 * ((ideal_px.col(0) - ideal_px.col(2)).norm() + (ideal_px.col(1) - ideal_px.col(3)).norm()) / std::sqrt(2.0);
  constexpr double kLeastHalf_px = 6.0;
  if (!(view.half_px >= kLeastHalf_px)) return std::nullopt;
  const Corners start_q = (ideal_px.colwise() - view.centre_px) / view.half_px;
  const auto homography = homography_of(start_q);
  if (!homography) return std::nullopt;

  TagImageState state;
  state.homography = *homography;
  state.spread_px2 = {spread.xx_px2, spread.xy_px2, spread.yy_px2};
  const TagImageModel model(pattern, view.seen({0.0, 0.0}).by_point.leftCols<2>());
  const std::vector<TagPixel> pixels =
      choose_pixels(image, view, pattern, model, state, corners_px, config.most_pixels);
  constexpr std::size_t kFewest = 100;
  if (pixels.size() < kFewest || !begin_shading(pattern, model, pixels, state)) return std::nullopt;
  const TagImageFit fit = fit_tag_image(model, pixels, state, config);
  if (!fit.converged || !fit.state.homography.allFinite()) return std::nullopt;

  RefinedCorners out;
  Eigen::Matrix<double, 8, 8> by_h;
  const Corners q = corners_of(fit.state.homography, by_h);
  for (int i = 0; i < 4; ++i) {
    const Projection seen = view.seen(q.col(i));
    out.corners_px.col(i) = seen.pixel;
    by_h.middleRows<2>(2 * i) = (seen.by_point.leftCols<2>() * by_h.middleRows<2>(2 * i)).eval();
  }
  const double moved_px = (out.corners_px - corners_px).colwise().norm().maxCoeff();
  if (!(moved_px <= config.largest_move_px)) return std::nullopt;
  out.covariance_px2 = by_h * fit.covariance * by_h.transpose();
  out.covariance_px2.diagonal().array() += config.model_sigma_px * config.model_sigma_px;
  out.covariance_px2 = (0.5 * (out.covariance_px2 + out.covariance_px2.transpose())).eval();
  if (!out.covariance_px2.allFinite()) return std::nullopt;
  out.spread = {fit.state.spread_px2[0], fit.state.spread_px2[1], fit.state.spread_px2[2]};
  out.black = fit.state.shading[0];
  out.white = fit.state.shading[0] + fit.state.shading[3];
  out.residual = fit.residual;
  out.pixels = static_cast<int>(pixels.size());
  out.iterations = fit.iterations;
  return out;
}

}  // namespace asperity
