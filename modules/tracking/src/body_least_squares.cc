#include "body_least_squares.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "asperity/base/error.h"
#include "asperity/recording/camera_model.h"

namespace asperity {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Vector8 = Eigen::Matrix<double, 8, 1>;
using Matrix8 = Eigen::Matrix<double, 8, 8>;

// The root of the weight above which a corner counts as used.
constexpr double kInUse = 0.5;

// One up to half of `limit`, then falling smoothly to nothing at it: the corners of a sound frame all count fully, so
// that the least squares' own covariance holds.
double weight(double distance, double limit) {
  const double begin = 0.5 * limit;
  if (distance <= begin) return 1.0;
  if (distance >= limit) return 0.0;
  const double u = (distance - begin) / (limit - begin);
  return (1.0 - u * u) * (1.0 - u * u);
}

// The scale of distances d in the plane, whose squares have the median 2 ln 2, never below what is known of the
// corners.
double robust_scale(std::vector<double> squares) {
  const double n = static_cast<double>(squares.size());
  const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
  std::nth_element(squares.begin(), middle, squares.end());
  const double fitted = 2.0 * n / (2.0 * n - 6.0);
  return std::sqrt(std::max(1.0, *middle * fitted / (2.0 * std::log(2.0))));
}

Pose moved(const Pose& pose, const Vector6& step) {
  return {(exp_rotation(step.tail<3>()) * pose.rotation).normalized(), pose.translation_m + step.head<3>()};
}

}  // namespace

BodyLeastSquares::BodyLeastSquares(const CameraCalibration& camera, const std::vector<MarkerPlacement>& body,
                                   std::span<const SeenTag> seen, const BodyPoseConfig& config)
    : camera_(&camera), config_(&config) {
  observations_.reserve(seen.size());
  for (const SeenTag& tag : seen) {
    Observation one;
    one.p_marker_m = tag_corners_m(body[tag.tag]);
    one.corners_px = tag.corners_px;
    one.covariance = Matrix8::Identity() * (config.corner_sigma_px * config.corner_sigma_px);
    if (tag.has_covariance) one.covariance = tag.covariance_px2;
    if (!one.corners_px.allFinite() || Eigen::LLT<Matrix8>(one.covariance).info() != Eigen::Success) {
      throw Error("solve_body_pose: a tag's corners or their covariance are not finite");
    }
    observations_.push_back(one);
  }
}

bool BodyLeastSquares::evaluate(const Pose& pose, Residuals& out, bool with_derivative) const {
  out.r_px.resize(observations_.size());
  if (with_derivative) out.by_pose.resize(observations_.size());
  for (std::size_t i = 0; i < observations_.size(); ++i) {
    for (int corner = 0; corner < 4; ++corner) {
      const Eigen::Vector3d arm_m = pose.rotation * observations_[i].p_marker_m.col(corner);
      const auto seen = project_with_derivative(*camera_, arm_m + pose.translation_m);
      if (!seen || !seen->pixel.allFinite()) return false;
      out.r_px[i].segment<2>(2 * corner) = seen->pixel - observations_[i].corners_px.col(corner);
      if (!with_derivative) continue;
      out.by_pose[i].block<2, 3>(2 * corner, 0) = seen->by_point;
      out.by_pose[i].block<2, 3>(2 * corner, 3) = -seen->by_point * skew(arm_m);
    }
  }
  return true;
}

// The corners' errors and those of their tags' places: a tag that is off moves its corners together.
bool BodyLeastSquares::weigh_tags(const Residuals& at, double corner_px, std::vector<Metric>& out) const {
  const double placement2_m2 = config_->placement_sigma_m * config_->placement_sigma_m;
  out.resize(observations_.size());
  for (std::size_t i = 0; i < observations_.size(); ++i) {
    const auto by_place = at.by_pose[i].leftCols<3>();
    Matrix8 covariance = observations_[i].covariance + placement2_m2 * by_place * by_place.transpose();
    covariance.diagonal().array() += corner_px * corner_px;
    const Eigen::LLT<Matrix8> factor(covariance);
    if (factor.info() != Eigen::Success) return false;
    out[i].information = factor.solve(Matrix8::Identity());
    for (int corner = 0; corner < 4; ++corner) {
      out[i].own.block<2, 2>(0, 2 * corner) = covariance.block<2, 2>(2 * corner, 2 * corner).inverse();
    }
  }
  return true;
}

void BodyLeastSquares::distances2(const Residuals& residuals, const std::vector<Metric>& metric,
                                  std::vector<double>& out) const {
  out.resize(4 * observations_.size());
  for (std::size_t i = 0; i < observations_.size(); ++i) {
    for (int corner = 0; corner < 4; ++corner) {
      const Eigen::Vector2d r = residuals.r_px[i].segment<2>(2 * corner);
      out[4 * i + static_cast<std::size_t>(corner)] = r.dot(metric[i].own.block<2, 2>(0, 2 * corner) * r);
    }
  }
}

std::optional<double> BodyLeastSquares::loose_cost(const Pose& pose, double loose_px) const {
  Residuals residuals;
  if (!evaluate(pose, residuals, false)) return std::nullopt;
  double cost = 0.0;
  for (const Vector8& r : residuals.r_px) {
    for (int corner = 0; corner < 4; ++corner) {
      cost += std::log1p(r.segment<2>(2 * corner).squaredNorm() / (loose_px * loose_px));
    }
  }
  return cost;
}

double BodyLeastSquares::reweigh(const Residuals& at, const std::vector<Metric>& metric, std::vector<double>& squares,
                                 std::vector<double>& root_weights) const {
  distances2(at, metric, squares);
  const double scale = robust_scale(squares);
  root_weights.resize(squares.size());
  for (std::size_t k = 0; k < squares.size(); ++k) {
    root_weights[k] = std::sqrt(weight(std::sqrt(squares[k]), config_->outlier_sigmas * scale));
  }
  return scale;
}

std::optional<LeastSquaresPose> BodyLeastSquares::minimise(const Pose& start, double corner_px) const {
  LeastSquaresPose out;
  out.pose = start;
  Residuals here, there;
  std::vector<Metric> metric;
  if (!evaluate(out.pose, here, true) || !weigh_tags(here, corner_px, metric)) return std::nullopt;
  std::vector<double> squares, root_weights(4 * observations_.size());
  Matrix6 normal;
  double scale = 1.0;
  const auto weighted = [&](const Residuals& residuals, std::size_t i) {
    Vector8 r = residuals.r_px[i];
    for (int k = 0; k < 8; ++k) r[k] *= root_weights[4 * i + static_cast<std::size_t>(k / 2)];
    return r;
  };
  const auto weighted_cost = [&](const Residuals& residuals) {
    double cost = 0.0;
    for (std::size_t i = 0; i < observations_.size(); ++i) {
      const Vector8 r = weighted(residuals, i);
      cost += r.dot(metric[i].information * r);
    }
    return cost;
  };

  double damping = 1e-3;  // of the diagonal
  for (int iteration = 0; iteration < config_->most_iterations && !out.converged; ++iteration) {
    scale = reweigh(here, metric, squares, root_weights);
    normal.setZero();
    Vector6 gradient = Vector6::Zero();
    for (std::size_t i = 0; i < observations_.size(); ++i) {
      Eigen::Matrix<double, 8, 6> J = here.by_pose[i];
      for (int k = 0; k < 8; ++k) J.row(k) *= root_weights[4 * i + static_cast<std::size_t>(k / 2)];
      const Eigen::Matrix<double, 6, 8> JtL = J.transpose() * metric[i].information;
      normal.noalias() += JtL * J;
      gradient.noalias() += JtL * weighted(here, i);
    }
    const double cost = weighted_cost(here);
    bool accepted = false;
    for (int attempt = 0; attempt < 10 && !accepted; ++attempt) {
      Matrix6 damped = normal;
      damped.diagonal() *= 1.0 + damping;
      const Eigen::LDLT<Matrix6> factor(damped);
      if (factor.info() != Eigen::Success || !factor.isPositive()) return std::nullopt;
      const Vector6 step = -factor.solve(gradient);
      if (!step.allFinite()) return std::nullopt;
      const Pose next = moved(out.pose, step);
      if (evaluate(next, there, true) && weighted_cost(there) <= cost) {
        accepted = true;
        // The step in standard errors.
        constexpr double kSmall = 1e-3;
        out.converged = step.dot(normal * step) <= kSmall * kSmall * scale * scale;
        out.pose = next;
        std::swap(here, there);
        damping = std::max(1e-9, damping * 0.1);
      } else {
        damping *= 10.0;
      }
    }
    if (!accepted) {
      // No direction leads down: the minimum, within rounding.
      out.converged = true;
      break;
    }
  }

  reweigh(here, metric, squares, root_weights);
  double sum_px2 = 0.0;
  out.corners_of_tag.assign(observations_.size(), 0);
  for (std::size_t i = 0; i < observations_.size(); ++i) {
    for (int corner = 0; corner < 4; ++corner) {
      const std::size_t k = 4 * i + static_cast<std::size_t>(corner);
      out.robust_cost += std::log1p(squares[k] / 9.0);
      if (root_weights[k] <= kInUse) continue;
      ++out.corners_of_tag[i];
      ++out.corners_used;
      sum_px2 += here.r_px[i].segment<2>(2 * corner).squaredNorm();
    }
  }
  if (out.corners_used < 3) return std::nullopt;
  out.reprojection_px = std::sqrt(sum_px2 / out.corners_used);
  return out;
}

std::optional<BodyLeastSquares::AtMinimum> BodyLeastSquares::at_minimum(const LeastSquaresPose& minimum,
                                                                        double corner_px) const {
  Residuals here;
  std::vector<Metric> metric;
  if (!evaluate(minimum.pose, here, true) || !weigh_tags(here, corner_px, metric)) return std::nullopt;
  std::vector<double> squares, root_weights;
  reweigh(here, metric, squares, root_weights);
  AtMinimum out;
  out.normal.setZero();
  for (std::size_t i = 0; i < observations_.size(); ++i) {
    CornersAtPose tag;
    tag.p_marker_m = observations_[i].p_marker_m;
    tag.covariance_px2 = observations_[i].covariance;
    tag.residual_px = here.r_px[i];
    tag.by_pose = here.by_pose[i];
    Vector8 root;
    for (int k = 0; k < 8; ++k) root[k] = root_weights[4 * i + static_cast<std::size_t>(k / 2)];
    for (std::size_t corner = 0; corner < 4; ++corner) tag.used[corner] = root_weights[4 * i + corner] > kInUse;
    const Eigen::Matrix<double, 8, 6> J = root.asDiagonal() * here.by_pose[i];
    const Eigen::Matrix<double, 6, 8> JtW = J.transpose() * metric[i].information;
    out.normal.noalias() += JtW * J;
    tag.weighed = JtW * root.asDiagonal();
    out.corners.push_back(tag);
  }
  const Eigen::LDLT<Matrix6> factor(out.normal);
  if (!out.normal.allFinite() || factor.info() != Eigen::Success || !factor.isPositive()) return std::nullopt;
  return out;
}

}  // namespace asperity
