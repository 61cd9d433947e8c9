#include "refinement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "asperity/algebra/solve.h"
#include "pose_motion.h"

namespace asperity::registration {

namespace {

// The inverse of the knots' prior covariance; paths without a slow error get none, which holds them at zero.
Eigen::MatrixXd prior_precision(const PathChain& chain, const RefineConfig& config) {
  const auto size = 3 * static_cast<Eigen::Index>(chain.knot_count);
  Eigen::MatrixXd precision = Eigen::MatrixXd::Zero(size, size);
  for (const PathChain::Part& part : chain.parts) {
    const auto knots = static_cast<Eigen::Index>(part.knots);
    Eigen::MatrixXd correlation(knots, knots);
    for (Eigen::Index a = 0; a < knots; ++a) {
      for (Eigen::Index b = 0; b < knots; ++b) {
        correlation(a, b) = std::exp(-std::abs(static_cast<double>(a - b)) * config.knot_m / config.slow_length_m);
      }
    }
    const Eigen::MatrixXd inverse = inverse_of(correlation);
    const Eigen::Matrix3d covariance = config.slow_factor * config.slow_factor * part.covariance_m2;
    const Eigen::Matrix3d weight = covariance.inverse();
    for (Eigen::Index a = 0; a < knots; ++a) {
      for (Eigen::Index b = 0; b < knots; ++b) {
        const auto row = 3 * (static_cast<Eigen::Index>(part.first_knot) + a);
        const auto column = 3 * (static_cast<Eigen::Index>(part.first_knot) + b);
        precision.block<3, 3>(row, column) = inverse(a, b) * weight;
      }
    }
  }
  return precision;
}

bool has_slow_error(const PathChain& chain, const RefineConfig& config) {
  return config.slow_factor > 0.0 &&
         std::all_of(chain.parts.begin(), chain.parts.end(), [](const PathChain::Part& part) {
           return Eigen::LLT<Eigen::Matrix3d>(part.covariance_m2).info() == Eigen::Success &&
                  part.covariance_m2.trace() > 0.0;
         });
}

}  // namespace

Refinement::Refinement(const PathChain& chain, const MeshSurface& surface, const RegistrationResult& start,
                       const std::optional<Pose>& guess, const RefineConfig& config)
    : chain_(chain),
      surface_(surface),
      guess_(guess.value_or(start.T_mesh_world)),
      centre_m_(start.centre_mesh_m),
      config_(config),
      slow_(has_slow_error(chain, config)),
      knots_at_(6 + static_cast<Eigen::Index>(chain.parts.size())) {
  if (slow_) precision_ = prior_precision(chain, config);
  const double turn_rad = config.guess_sigma_deg * std::numbers::pi / 180.0;
  guess_precision_ << Eigen::Vector3d::Constant(1.0 / (turn_rad * turn_rad)),
      Eigen::Vector3d::Constant(1.0 / (config.guess_sigma_m * config.guess_sigma_m));
}

State Refinement::moved(const State& state, const Eigen::VectorXd& step) const {
  const Eigen::Quaterniond turn = exp_rotation(step.head<3>());
  State out = state;
  out.T_mesh_world.rotation = (turn * state.T_mesh_world.rotation).normalized();
  out.T_mesh_world.translation_m =
      turn * (state.T_mesh_world.translation_m - centre_m_) + centre_m_ + step.segment<3>(3);
  out.level_m += step.segment(6, out.level_m.size());
  if (slow_) out.knots_m += step.tail(step.size() - knots_at_);
  return out;
}

Equations Refinement::equations(const State& state, const FacetHeights& heights, const Whitening& whitening) const {
  const Eigen::Index head = knots_at_, size = head + (slow_ ? state.knots_m.size() : 0);
  Equations out;
  out.information = Eigen::MatrixXd::Zero(size, size);
  out.right = Eigen::VectorXd::Zero(size);
  const std::size_t order = whitening.a.size();
  const Eigen::Matrix3d R_world_mesh = state.T_mesh_world.rotation.conjugate().toRotationMatrix();
  Eigen::VectorXd row = Eigen::VectorXd::Zero(size);
  for_whitened(heights, order, [&](std::size_t i) {
    Eigen::Index first = size, last = head;  // of the knots that this row touches
    const auto add = [&](std::size_t at, double factor) {
      row.head<6>() += factor * pose_gradient(heights, at, centre_m_);
      row[6 + static_cast<Eigen::Index>(chain_.part_of[at])] -= factor;
      if (!slow_) return;
      const auto [knot, share] = chain_.knots[at];
      const Eigen::Index column = head + 3 * static_cast<Eigen::Index>(knot);
      const Eigen::Vector3d by_error = -factor * (R_world_mesh * heights.normal[at]);
      row.segment<3>(column) += (1.0 - share) * by_error;
      row.segment<3>(column + 3) += share * by_error;
      first = std::min(first, column);
      last = std::max(last, column + 6);
    };
    add(i, 1.0);
    for (std::size_t k = 1; k <= order; ++k) add(i - k, whitening.a[k - 1]);
    const double w = whitened(heights, whitening, i);
    const Eigen::Index span = last - first;
    out.information.topLeftCorner(head, head) += row.head(head) * row.head(head).transpose();
    out.right.head(head) -= w * row.head(head);
    if (span > 0) {
      out.information.block(0, first, head, span) += row.head(head) * row.segment(first, span).transpose();
      out.information.block(first, first, span, span) +=
          row.segment(first, span) * row.segment(first, span).transpose();
      out.right.segment(first, span) -= w * row.segment(first, span);
      row.segment(first, span).setZero();
    }
    row.head(head).setZero();
    ++out.rows;
  });
  out.information.bottomLeftCorner(size - head, head) = out.information.topRightCorner(head, size - head).transpose();
  out.information /= whitening.variance_m2;
  out.right /= whitening.variance_m2;

  const double level_precision = 1.0 / (whitening.relief_m * whitening.relief_m);
  out.information.diagonal().segment(6, state.level_m.size()).array() += level_precision;
  out.right.segment(6, state.level_m.size()) -= level_precision * state.level_m;
  const Vector6 from_guess = pose_change(guess_, state.T_mesh_world, centre_m_);
  out.information.diagonal().head<6>() += guess_precision_;
  out.right.head<6>() -= guess_precision_.cwiseProduct(from_guess);
  if (slow_) {
    out.information.bottomRightCorner(size - head, size - head) += precision_;
    out.right.tail(size - head) -= precision_ * state.knots_m;
  }
  out.cost = cost(state, heights, whitening);
  return out;
}

double Refinement::cost(const State& state, const FacetHeights& heights, const Whitening& whitening) const {
  double sum = 0.0;
  std::size_t rows = 0;
  for_whitened(heights, whitening.a.size(), [&](std::size_t i) {
    const double w = whitened(heights, whitening, i);
    sum += w * w;
    ++rows;
  });
  if (rows < kLeastPoints) return std::numeric_limits<double>::infinity();
  const double scale = static_cast<double>(chain_.p_world_m.size()) / static_cast<double>(rows);
  const Vector6 from_guess = pose_change(guess_, state.T_mesh_world, centre_m_);
  return scale * sum / whitening.variance_m2 + state.level_m.squaredNorm() / (whitening.relief_m * whitening.relief_m) +
         from_guess.dot(guess_precision_.cwiseProduct(from_guess)) +
         (slow_ ? state.knots_m.dot(precision_ * state.knots_m) : 0.0);
}

}  // namespace asperity::registration
