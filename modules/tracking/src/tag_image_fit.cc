#include "tag_image_fit.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "blurred_pattern.h"

namespace asperity {
namespace {

// A pixel is a box one px wide: no image is sharper.
constexpr double kLeastSpread_px2 = 1.0 / 12.0;

// The growth is modelled to first order only.
constexpr double kMostGrowth_px = 1.0;

double weight(double misfit, double limit) {
  const double begin = 0.5 * limit;
  misfit = std::abs(misfit);
  if (misfit <= begin) return 1.0;
  if (misfit >= limit) return 0.0;
  const double u = (misfit - begin) / (limit - begin);
  return (1.0 - u * u) * (1.0 - u * u);
}

// Of the residuals of those pixels that are not `clipped`.
double robust_scale(const std::vector<double>& residuals, const std::vector<char>& clipped, std::vector<double>& work) {
  work.clear();
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    if (clipped[i] == 0) work.push_back(std::abs(residuals[i]));
  }
  if (work.empty()) return 0.0;
  const auto middle = work.begin() + static_cast<std::ptrdiff_t>(work.size() / 2);
  std::nth_element(work.begin(), middle, work.end());
  return 1.4826 * *middle;
}

}  // namespace

void TagImageState::add(const FitVector& step) {
  homography += step.head<8>();
  spread_px2 += step.segment<3>(8);
  shading += step.segment<6>(11);
  growth_px = std::clamp(growth_px + step[17], -kMostGrowth_px, kMostGrowth_px);
  spread_px2[0] = std::max(spread_px2[0], kLeastSpread_px2);
  spread_px2[2] = std::max(spread_px2[2], kLeastSpread_px2);
  const double most = std::sqrt((spread_px2[0] - 0.99 * kLeastSpread_px2) * (spread_px2[2] - 0.99 * kLeastSpread_px2));
  spread_px2[1] = std::clamp(spread_px2[1], -most, most);
}

TagImageModel::TagImageModel(const TagPattern& pattern, const Eigen::Matrix2d& px_by_q)
    : pattern_(&pattern), cells_per_x_(0.5 * pattern.border_cells()), q_by_px_(px_by_q.inverse()) {}

TagImageModel::Place TagImageModel::place(const TagImageState& state, double qx, double qy) const {
  const auto& h = state.homography;
  Place out;
  // (x, y) from (h0 − q h6) x + (h1 − q h7) y = q − h2, and the same for the second row.
  const double a = h[0] - qx * h[6], b = h[1] - qx * h[7], c = h[3] - qy * h[6], d = h[4] - qy * h[7];
  const double rx = qx - h[2], ry = qy - h[5], determinant = a * d - b * c;
  out.x = (d * rx - b * ry) / determinant;
  out.y = (a * ry - c * rx) / determinant;
  out.w = h[6] * out.x + h[7] * out.y + 1.0;
  // ∂q/∂x is that 2×2 matrix over w.
  const double scale = out.w / determinant;
  out.x_by_q << d * scale, -b * scale, -c * scale, a * scale;
  out.u = pattern_->margin + (out.x + 1.0) * cells_per_x_;
  out.v = pattern_->margin + (out.y + 1.0) * cells_per_x_;
  const Eigen::Matrix2d by_px = cells_per_x_ * out.x_by_q * q_by_px_;
  out.u_by_px = by_px.row(0);
  out.v_by_px = by_px.row(1);
  const auto& s = state.spread_px2;
  const auto sigma = [&](const Eigen::Vector2d& g) {
    return std::sqrt(g.x() * g.x() * s[0] + 2.0 * g.x() * g.y() * s[1] + g.y() * g.y() * s[2]);
  };
  out.sigma_u = sigma(out.u_by_px);
  out.sigma_v = sigma(out.v_by_px);
  const auto &gu = out.u_by_px, &gv = out.v_by_px;
  out.covariance_uv = gu.x() * gv.x() * s[0] + (gu.x() * gv.y() + gu.y() * gv.x()) * s[1] + gu.y() * gv.y() * s[2];
  return out;
}

double TagImageModel::grey(const TagImageState& state, const TagPixel& pixel, FitVector& by_state) const {
  const Place at = place(state, pixel.qx, pixel.qy);
  const BlurredValue blurred = blurred_pattern(*pattern_, at.u, at.v, at.sigma_u, at.sigma_v, at.covariance_uv);
  const auto& s = state.shading;
  const double contrast = s[3] + s[4] * at.x + s[5] * at.y;
  const double slope_per_px = (blurred.by_u * at.u_by_px + blurred.by_v * at.v_by_px).norm();
  const double value = blurred.value + state.growth_px * slope_per_px;
  // A step of the homography that moves the picture's points by dq moves the picture's point seen here by −∂x/∂q dq.
  const Eigen::Vector2d by_x(contrast * blurred.by_u * cells_per_x_, contrast * blurred.by_v * cells_per_x_);
  const Eigen::Vector2d by_q = -at.x_by_q.transpose() * by_x;
  const double gx = by_q.x() / at.w, gy = by_q.y() / at.w, gq = gx * pixel.qx + gy * pixel.qy;
  by_state.head<8>() << gx * at.x, gx * at.y, gx, gy * at.x, gy * at.y, gy, -gq * at.x, -gq * at.y;
  const double by_uu = contrast * blurred.by_sigma_u / (2.0 * at.sigma_u);
  const double by_vv = contrast * blurred.by_sigma_v / (2.0 * at.sigma_v);
  const auto &gu = at.u_by_px, &gv = at.v_by_px;
  const double by_uv = contrast * blurred.by_covariance;
  by_state.segment<3>(8) << by_uu * gu.x() * gu.x() + by_vv * gv.x() * gv.x() + by_uv * gu.x() * gv.x(),
      2.0 * (by_uu * gu.x() * gu.y() + by_vv * gv.x() * gv.y()) + by_uv * (gu.x() * gv.y() + gu.y() * gv.x()),
      by_uu * gu.y() * gu.y() + by_vv * gv.y() * gv.y() + by_uv * gu.y() * gv.y();
  by_state.tail<7>() << 1.0, at.x, at.y, value, value * at.x, value * at.y, contrast * slope_per_px;
  return s[0] + s[1] * at.x + s[2] * at.y + contrast * value;
}

namespace {

// The pixels' misfits at a state, and the normal equations under weights.
class Linearised {
 public:
  explicit Linearised(std::size_t n) : residuals_(n), clipped_(n), rows_(n) {}

  void evaluate(const TagImageModel& model, const std::vector<TagPixel>& pixels, double brightest,
                const TagImageState& state) {
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const double grey = model.grey(state, pixels[i], rows_[i]);
      const double seen = std::clamp(grey, 0.0, brightest);
      clipped_[i] = seen != grey ? 1 : 0;
      if (clipped_[i] != 0) rows_[i].setZero();
      residuals_[i] = seen - pixels[i].grey;
    }
  }

  double cost(const std::vector<double>& weights) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < weights.size(); ++i) sum += weights[i] * residuals_[i] * residuals_[i];
    return sum;
  }

  void accumulate(const std::vector<double>& weights, FitMatrix& normal, FitVector& gradient) const {
    normal.setZero();
    gradient.setZero();
    for (std::size_t i = 0; i < weights.size(); ++i) {
      if (weights[i] == 0.0) continue;
      const FitVector& row = rows_[i];
      for (int k = 0; k < kFitUnknowns; ++k) {
        const double scaled = weights[i] * row[k];
        double* const column = normal.data() + k * kFitUnknowns;
        for (int j = 0; j <= k; ++j) column[j] += scaled * row[j];
      }
      gradient += (weights[i] * residuals_[i]) * row;
    }
    normal.triangularView<Eigen::StrictlyLower>() = normal.transpose();
  }

  const std::vector<double>& residuals() const { return residuals_; }
  // Pixels at which the model is darker or brighter than the camera can tell: they say nothing of the edges.
  const std::vector<char>& clipped() const { return clipped_; }

 private:
  std::vector<double> residuals_;
  std::vector<char> clipped_;
  std::vector<FitVector> rows_;
};

// Quantisation alone leaves 0.29 grey levels.
constexpr double kLeastScale = 0.29;

// Levenberg–Marquardt from `out.state`, with weights by the residuals' scale but never below `floor`, which is lowered
// step by step. Ends when a step is below `small` standard errors.
class Descent {
 public:
  Descent(const TagImageModel& model, const std::vector<TagPixel>& pixels, double brightest)
      : model_(&model),
        pixels_(&pixels),
        brightest_(brightest),
        here_(pixels.size()),
        there_(pixels.size()),
        weights_(pixels.size()) {}

  bool run(TagImageFit& out, double floor, double small, int most_iterations) {
    double damping = 1e-6;
    here_.evaluate(*model_, *pixels_, brightest_, out.state);
    bool converged = false;
    for (int i = 0; i < most_iterations && !converged; ++i, ++out.iterations) {
      const double seen = std::max(robust_scale(here_.residuals(), here_.clipped(), work_), kLeastScale);
      const bool settled = floor <= seen;
      accumulate(6.0 * std::max(seen, floor));
      floor *= 0.25;
      bool accepted = false;
      FitVector step;
      for (int attempt = 0; attempt < 6 && !accepted; ++attempt) {
        FitMatrix damped = normal_;
        damped.diagonal() *= 1.0 + damping;
        const Eigen::LLT<FitMatrix> factor(damped);
        if (factor.info() != Eigen::Success) return false;
        step = -factor.solve(gradient_);
        TagImageState next = out.state;
        next.add(step);
        there_.evaluate(*model_, *pixels_, brightest_, next);
        if (there_.cost(weights_) <= cost_) {
          accepted = true;
          out.state = next;
          std::swap(here_, there_);
          damping = std::max(damping * 0.1, 1e-9);
        } else {
          damping = std::max(damping * 10.0, 1e-4);
        }
      }
      if (!settled) continue;
      const auto moved = step.head<8>();
      const double moved2 = moved.dot(normal_.topLeftCorner<8, 8>() * moved);
      // Without a direction that leads down this is the minimum, within rounding.
      converged = !accepted || moved2 < small * small * variance();
    }
    return converged;
  }

  // The pixels outside of covered cells: where more than a quarter of a cell's pixels do not fit, something lies on it,
  // and its edge may lie on the cells beside it, where it moves edges by less than a pixel's own misfit tells.
  std::vector<TagPixel> uncovered(const TagImageState& state, int cells) const {
    constexpr double kOdd = 3.0;  // of the residual's scale: one pixel in 370 by noise alone
    constexpr int kFewest = 4;
    const auto side = static_cast<std::size_t>(cells);
    std::vector<int> seen(side * side, 0), odd(side * side, 0);
    std::vector<std::size_t> cell_of(pixels_->size());
    std::vector<double> work;
    const double limit = kOdd * std::max(robust_scale(here_.residuals(), here_.clipped(), work), kLeastScale);
    for (std::size_t i = 0; i < pixels_->size(); ++i) {
      const TagImageModel::Place at = model_->place(state, (*pixels_)[i].qx, (*pixels_)[i].qy);
      const auto index = [&](double place) { return static_cast<std::size_t>(std::clamp(place, 0.0, cells - 1.0)); };
      cell_of[i] = index(at.v) * side + index(at.u);
      ++seen[cell_of[i]];
      odd[cell_of[i]] += std::abs(here_.residuals()[i]) > limit ? 1 : 0;
    }
    std::vector<char> covered(side * side, 0);
    for (std::size_t k = 0; k < seen.size(); ++k) {
      if (odd[k] < kFewest || 4 * odd[k] < seen[k]) continue;
      const std::size_t row = k / side, column = k % side;
      for (std::size_t r = row - std::min<std::size_t>(row, 1); r <= std::min(row + 1, side - 1); ++r) {
        for (std::size_t c = column - std::min<std::size_t>(column, 1); c <= std::min(column + 1, side - 1); ++c) {
          covered[r * side + c] = 1;
        }
      }
    }
    std::vector<TagPixel> out;
    out.reserve(pixels_->size());
    for (std::size_t i = 0; i < pixels_->size(); ++i) {
      if (covered[cell_of[i]] == 0) out.push_back((*pixels_)[i]);
    }
    return out;
  }

  // The covariance at the state where run() ended; false where it is not determined.
  bool finish(TagImageFit& out) {
    accumulate(6.0 * std::max(robust_scale(here_.residuals(), here_.clipped(), work_), kLeastScale));
    const Eigen::LLT<FitMatrix> factor(normal_);
    if (!(sum_weights_ > 2.0 * kFitUnknowns) || factor.info() != Eigen::Success) return false;
    out.residual = std::sqrt(variance());
    out.covariance = variance() * factor.solve(FitMatrix::Identity()).topLeftCorner<8, 8>();
    return true;
  }

 private:
  void accumulate(double limit) {
    sum_weights_ = 0.0;
    for (std::size_t i = 0; i < weights_.size(); ++i) {
      weights_[i] = weight(here_.residuals()[i], limit);
      if (here_.clipped()[i] == 0) sum_weights_ += weights_[i];
    }
    cost_ = here_.cost(weights_);
    here_.accumulate(weights_, normal_, gradient_);
  }
  double variance() const {
    return std::max(cost_ / std::max(1.0, sum_weights_ - kFitUnknowns), kLeastScale * kLeastScale);
  }

  const TagImageModel* model_;
  const std::vector<TagPixel>* pixels_;
  double brightest_;
  Linearised here_, there_;
  std::vector<double> weights_, work_;
  FitMatrix normal_;
  FitVector gradient_;
  double sum_weights_ = 0.0, cost_ = 0.0;
};

// The grey level at which the camera's white saturates: where many pixels share the brightest.
double find_brightest(const std::vector<TagPixel>& pixels) {
  constexpr double kBright = 230.0;
  constexpr double kMany = 0.05;
  double brightest = 0.0;
  std::size_t count = 0;
  for (const TagPixel& pixel : pixels) {
    if (pixel.grey > brightest) count = 0;
    brightest = std::max(brightest, pixel.grey);
    count += pixel.grey == brightest ? 1 : 0;
  }
  const bool saturates =
      brightest >= kBright && static_cast<double>(count) > kMany * static_cast<double>(pixels.size());
  return saturates ? brightest : 255.0;
}

}  // namespace

TagImageFit fit_tag_image(const TagImageModel& model, const std::vector<TagPixel>& pixels, const TagImageState& start,
                          const RefineCornersConfig& config) {
  TagImageFit out;
  out.state = start;
  const double brightest = find_brightest(pixels);
  // At first nearly every edge is off, by up to the whole contrast.
  double floor = 0.2 * std::abs(start.shading[3]);
  // The way there is found with few pixels; all of them then take one or two more steps.
  constexpr std::size_t kFew = 350;
  const std::size_t stride = pixels.size() / kFew;
  if (stride > 1) {
    std::vector<TagPixel> few;
    few.reserve(pixels.size() / stride + 1);
    for (std::size_t i = 0; i < pixels.size(); i += stride) few.push_back(pixels[i]);
    Descent coarse(model, few, brightest);
    if (!coarse.run(out, floor, 0.2, config.most_iterations)) return out;
    floor = 0.0;
  }
  Descent fine(model, pixels, brightest);
  // A step of a standard error leaves far less than one: the model is nearly linear there.
  if (!fine.run(out, floor, 1.0, config.most_iterations)) return out;
  const std::vector<TagPixel> uncovered = fine.uncovered(out.state, model.cells());
  if (uncovered.size() == pixels.size()) {
    out.converged = fine.finish(out);
    return out;
  }
  // Less than a third of a tag fits many pictures.
  if (3 * uncovered.size() < pixels.size()) return out;
  Descent rest(model, uncovered, brightest);
  out.converged = rest.run(out, 0.0, 0.3, config.most_iterations) && rest.finish(out);
  return out;
}

}  // namespace asperity
