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

double weight(double misfit, double limit) {
  const double begin = 0.5 * limit;
  misfit = std::abs(misfit);
  if (misfit <= begin) return 1.0;
  if (misfit >= limit) return 0.0;
  const double u = (misfit - begin) / (limit - begin);
  return (1.0 - u * u) * (1.0 - u * u);
}

double robust_scale(const std::vector<double>& residuals, std::vector<double>& work) {
  work.resize(residuals.size());
  std::transform(residuals.begin(), residuals.end(), work.begin(), [](double r) { return std::abs(r); });
  const auto middle = work.begin() + static_cast<std::ptrdiff_t>(work.size() / 2);
  std::nth_element(work.begin(), middle, work.end());
  return 1.4826 * *middle;
}

}  // namespace

void TagImageState::add(const FitVector& step) {
  homography += step.head<8>();
  spread_px2 += step.segment<3>(8);
  shading += step.tail<6>();
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
  return out;
}

double TagImageModel::grey(const TagImageState& state, const TagPixel& pixel) const {
  const Place at = place(state, pixel.qx, pixel.qy);
  const auto& s = state.shading;
  return s[0] + s[1] * at.x + s[2] * at.y +
         (s[3] + s[4] * at.x + s[5] * at.y) * blurred_pattern(*pattern_, at.u, at.v, at.sigma_u, at.sigma_v).value;
}

double TagImageModel::grey(const TagImageState& state, const TagPixel& pixel, FitVector& by_state) const {
  const Place at = place(state, pixel.qx, pixel.qy);
  const BlurredValue blurred = blurred_pattern(*pattern_, at.u, at.v, at.sigma_u, at.sigma_v);
  const auto& s = state.shading;
  const double contrast = s[3] + s[4] * at.x + s[5] * at.y;
  // A step of the homography that moves the picture's points by dq moves the picture's point seen here by −∂x/∂q dq.
  const Eigen::Vector2d by_x(contrast * blurred.by_u * cells_per_x_, contrast * blurred.by_v * cells_per_x_);
  const Eigen::Vector2d by_q = -at.x_by_q.transpose() * by_x;
  const double gx = by_q.x() / at.w, gy = by_q.y() / at.w, gq = gx * pixel.qx + gy * pixel.qy;
  by_state.head<8>() << gx * at.x, gx * at.y, gx, gy * at.x, gy * at.y, gy, -gq * at.x, -gq * at.y;
  const double by_uu = contrast * blurred.by_sigma_u / (2.0 * at.sigma_u);
  const double by_vv = contrast * blurred.by_sigma_v / (2.0 * at.sigma_v);
  const auto &gu = at.u_by_px, &gv = at.v_by_px;
  by_state.segment<3>(8) << by_uu * gu.x() * gu.x() + by_vv * gv.x() * gv.x(),
      2.0 * (by_uu * gu.x() * gu.y() + by_vv * gv.x() * gv.y()), by_uu * gu.y() * gu.y() + by_vv * gv.y() * gv.y();
  by_state.tail<6>() << 1.0, at.x, at.y, blurred.value, blurred.value * at.x, blurred.value * at.y;
  return s[0] + s[1] * at.x + s[2] * at.y + contrast * blurred.value;
}

TagImageFit fit_tag_image(const TagImageModel& model, const std::vector<TagPixel>& pixels, const TagImageState& start,
                          const RefineCornersConfig& config) {
  constexpr int kBlock = 64;
  const std::size_t n = pixels.size();
  TagImageFit out;
  out.state = start;
  Eigen::Matrix<double, kFitUnknowns, kBlock> block;
  Eigen::Matrix<double, kFitUnknowns, Eigen::Dynamic> by_state(kFitUnknowns, static_cast<Eigen::Index>(n));
  std::vector<double> residuals(n), weights(n), work, trial_residuals(n);
  FitMatrix normal;
  FitVector gradient;
  double sum_weights = 0.0, cost = 0.0;

  const auto linearise = [&] {
    FitVector column;
    for (std::size_t i = 0; i < n; ++i) {
      residuals[i] = model.grey(out.state, pixels[i], column) - pixels[i].grey;
      by_state.col(static_cast<Eigen::Index>(i)) = column;
    }
  };
  const auto accumulate = [&](double limit) {
    normal.setZero();
    gradient.setZero();
    sum_weights = cost = 0.0;
    for (std::size_t begin = 0; begin < n; begin += kBlock) {
      const std::size_t count = std::min<std::size_t>(kBlock, n - begin);
      for (std::size_t k = 0; k < count; ++k) {
        const std::size_t i = begin + k;
        weights[i] = weight(residuals[i], limit);
        sum_weights += weights[i];
        cost += weights[i] * residuals[i] * residuals[i];
        const auto column = by_state.col(static_cast<Eigen::Index>(i));
        block.col(static_cast<Eigen::Index>(k)) = std::sqrt(weights[i]) * column;
        gradient += weights[i] * residuals[i] * column;
      }
      const auto filled = block.leftCols(static_cast<Eigen::Index>(count));
      normal.noalias() += filled * filled.transpose();
    }
  };

  double damping = 1e-4;
  double floor = 0.2 * std::abs(start.shading[3]);  // lowered step by step: at first nearly every edge is off
  linearise();
  for (out.iterations = 0; out.iterations < config.most_iterations && !out.converged; ++out.iterations) {
    // Quantisation alone leaves 0.29 grey levels.
    const double scale = std::max({robust_scale(residuals, work), floor, 0.29});
    const bool settled = floor <= robust_scale(residuals, work) || floor < 0.29;
    floor *= 0.4;
    accumulate(6.0 * scale);
    bool accepted = false;
    FitVector step;
    for (int attempt = 0; attempt < 6 && !accepted; ++attempt) {
      FitMatrix damped = normal;
      damped.diagonal() *= 1.0 + damping;
      const Eigen::LLT<FitMatrix> factor(damped);
      if (factor.info() != Eigen::Success) return out;
      step = -factor.solve(gradient);
      TagImageState next = out.state;
      next.add(step);
      double next_cost = 0.0;
      for (std::size_t i = 0; i < n; ++i) {
        trial_residuals[i] = model.grey(next, pixels[i]) - pixels[i].grey;
        next_cost += weights[i] * trial_residuals[i] * trial_residuals[i];
      }
      if (next_cost <= cost) {
        accepted = true;
        out.state = next;
        damping = std::max(damping * 0.1, 1e-9);
      } else {
        damping = std::max(damping, 1e-6) * 10.0;
      }
    }
    if (!accepted) {
      out.converged = settled;
      if (settled) break;
      continue;
    }
    linearise();
    // Of the standard errors.
    constexpr double kSmall = 0.03;
    const double variance = std::max(cost / std::max(1.0, sum_weights - kFitUnknowns), 1e-12);
    out.converged =
        settled && step.head<8>().dot(normal.topLeftCorner<8, 8>() * step.head<8>()) < kSmall * kSmall * variance;
  }

  const double scale = std::max(robust_scale(residuals, work), 0.29);
  accumulate(6.0 * scale);
  if (!(sum_weights > 2.0 * kFitUnknowns)) {
    out.converged = false;
    return out;
  }
  const double variance = std::max(cost / (sum_weights - kFitUnknowns), 1.0 / 12.0);
  out.residual = std::sqrt(variance);
  const Eigen::LLT<FitMatrix> factor(normal);
  if (factor.info() != Eigen::Success) {
    out.converged = false;
    return out;
  }
  const FitMatrix inverse = factor.solve(FitMatrix::Identity());
  out.covariance = variance * inverse.topLeftCorner<8, 8>();
  return out;
}

}  // namespace asperity
