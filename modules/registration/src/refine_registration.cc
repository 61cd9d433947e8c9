#include "asperity/registration/refine_registration.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "path_chain.h"
#include "pose_motion.h"
#include "weak_turns.h"
#include "whitening.h"

namespace asperity {

namespace {

using registration::FacetHeights;
using registration::Matrix6;
using registration::PathChain;
using registration::Vector6;
using registration::Whitening;

constexpr std::size_t kLeastPoints = 30;
constexpr int kRounds = 3;
constexpr double kSmallStep = 1e-3;  // squared, in standard deviations
constexpr double kKnown_m = 5e-3;    // a motion known to this is left free: guesses are no better

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
    const Eigen::MatrixXd inverse = correlation.inverse();
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

// Pose, slow errors and the mean relief of each path.
struct State {
  Pose T_mesh_world;
  Eigen::VectorXd knots_m;
  Eigen::VectorXd level_m;
};

struct Equations {
  Eigen::MatrixXd information;  // of turn, shift, levels and knots
  Eigen::VectorXd right;
  double cost = 0.0;  // the mean of w² over its variance, times the points, and the prior's
  std::size_t rows = 0;
};

class Refinement {
 public:
  // The start's pose and middle count as a weak guess.
  Refinement(const PathChain& chain, const MeshSurface& surface, const RegistrationResult& guess,
             const RefineConfig& config)
      : chain_(chain),
        surface_(surface),
        guess_(guess.T_mesh_world),
        centre_m_(guess.centre_mesh_m),
        config_(config),
        slow_(has_slow_error(chain, config)),
        knots_at_(6 + static_cast<Eigen::Index>(chain.parts.size())) {
    if (slow_) precision_ = prior_precision(chain, config);
    const double turn_rad = config.guess_sigma_deg * std::numbers::pi / 180.0;
    guess_precision_ << Eigen::Vector3d::Constant(1.0 / (turn_rad * turn_rad)),
        Eigen::Vector3d::Constant(1.0 / (config.guess_sigma_m * config.guess_sigma_m));
  }

  bool slow() const { return slow_; }
  FacetHeights heights(const State& state) const {
    return measure_heights(chain_, state.knots_m, state.level_m, surface_, state.T_mesh_world, config_.outlier_sigmas);
  }
  Equations equations(const State& state, const FacetHeights& heights, const Whitening& whitening) const;
  double cost(const State& state, const FacetHeights& heights, const Whitening& whitening) const;
  State moved(const State& state, const Eigen::VectorXd& step) const {
    const Eigen::Quaterniond turn = exp_rotation(step.head<3>());
    State out = state;
    out.T_mesh_world.rotation = (turn * state.T_mesh_world.rotation).normalized();
    out.T_mesh_world.translation_m =
        turn * (state.T_mesh_world.translation_m - centre_m_) + centre_m_ + step.segment<3>(3);
    out.level_m += step.segment(6, out.level_m.size());
    if (slow_) out.knots_m += step.tail(step.size() - knots_at_);
    return out;
  }

 private:
  // Calls visit(i) for each point whose whitened height is complete.
  template <class Visit>
  void for_whitened(const FacetHeights& heights, std::size_t order, Visit visit) const {
    std::size_t run = 0;
    for (std::size_t i = 0; i < heights.d_m.size(); ++i) {
      if (chain_.begins[i] != 0) run = 0;
      run = heights.usable[i] != 0 ? run + 1 : 0;
      if (run > order) visit(i);
    }
  }
  static double whitened(const FacetHeights& heights, const Whitening& whitening, std::size_t i) {
    double w = heights.d_m[i];
    for (std::size_t k = 1; k <= whitening.a.size(); ++k) w += whitening.a[k - 1] * heights.d_m[i - k];
    return w;
  }

  const PathChain& chain_;
  const MeshSurface& surface_;
  Pose guess_;
  Eigen::Vector3d centre_m_;
  const RefineConfig& config_;
  bool slow_;
  Eigen::Index knots_at_;  // where they begin among the unknowns
  Eigen::MatrixXd precision_;
  Vector6 guess_precision_;
};

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
      row.head<6>() += factor * registration::pose_gradient(heights, at, centre_m_);
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
  const Vector6 from_guess = registration::pose_change(guess_, state.T_mesh_world, centre_m_);
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
  const Vector6 from_guess = registration::pose_change(guess_, state.T_mesh_world, centre_m_);
  return scale * sum / whitening.variance_m2 + state.level_m.squaredNorm() / (whitening.relief_m * whitening.relief_m) +
         from_guess.dot(guess_precision_.cwiseProduct(from_guess)) +
         (slow_ ? state.knots_m.dot(precision_ * state.knots_m) : 0.0);
}

bool is_held(const UndeterminedMotion& motion) { return !(motion.sigma_m < kKnown_m); }

// Keeps the pose along motions of which the path says nothing: they are made stiff.
void hold(Eigen::MatrixXd& information, std::span<const UndeterminedMotion> motions) {
  const double stiff = 1e6 * information.topLeftCorner<6, 6>().trace();
  for (const UndeterminedMotion& motion : motions) {
    if (!is_held(motion)) continue;
    Vector6 direction;
    direction << motion.turn, motion.shift;
    if (direction.norm() > 0.0) direction.normalize();
    information.topLeftCorner<6, 6>() += stiff * direction * direction.transpose();
  }
}

struct Refined {
  State state;
  FacetHeights heights;
  Eigen::MatrixXd information;
  double cost = std::numeric_limits<double>::infinity();
  int iterations = 0;
};

// Gauss–Newton with one filter, from one state.
Refined descend(const Refinement& problem, const State& start, const Whitening& whitening,
                std::span<const UndeterminedMotion> held, int max_iterations) {
  Refined out;
  out.state = start;
  out.heights = problem.heights(start);
  for (int k = 0; k < max_iterations; ++k) {
    ++out.iterations;
    Equations equations = problem.equations(out.state, out.heights, whitening);
    out.cost = equations.cost;
    if (equations.rows < kLeastPoints) return out;
    hold(equations.information, held);
    out.information = equations.information;
    const Eigen::VectorXd step = out.information.ldlt().solve(equations.right);
    if (!step.allFinite()) return out;
    double share = 1.0;
    bool fell = false;
    for (int halving = 0; halving < 5 && !fell; ++halving, share *= 0.5) {
      const State next = problem.moved(out.state, share * step);
      FacetHeights there = problem.heights(next);
      const double cost = problem.cost(next, there, whitening);
      if (!(cost < out.cost)) continue;
      fell = true;
      out.cost = cost;
      out.state = next;
      out.heights = std::move(there);
    }
    if (!fell || share * share * step.dot(out.information * step) < kSmallStep) break;
  }
  return out;
}

Matrix6 pose_covariance(const Eigen::MatrixXd& information) {
  const Eigen::MatrixXd pose_columns = Eigen::MatrixXd::Identity(information.rows(), 6);
  return information.ldlt().solve(pose_columns).topRows<6>();
}

// Of motions that were held at the start: known as well as a guess is.
Matrix6 held_covariance(std::span<const UndeterminedMotion> motions, double guess_sigma_m) {
  Matrix6 out = Matrix6::Zero();
  for (const UndeterminedMotion& motion : motions) {
    if (!is_held(motion)) continue;
    Vector6 direction;
    direction << motion.turn, motion.shift;
    const double sigma_m = std::min(motion.sigma_m, guess_sigma_m);
    out += sigma_m * sigma_m * direction * direction.transpose();
  }
  return out;
}

}  // namespace

RefinedRegistration refine_registration(std::span<const MeasuredPath> paths, const MeshSurface& surface,
                                        const RegistrationResult& start, std::span<const Pose> others,
                                        const RefineConfig& config) {
  RefinedRegistration out;
  out.registration = start;
  out.slow_error_world_m.resize(paths.size());
  if (!config.enabled) return out;
  const auto give_up = [&](const std::string& why) {
    out.registration.problems.push_back({"not_refined", "the pose was not refined: " + why, 1});
    return out;
  };

  const PathChain chain = registration::make_chain(paths, config.knot_m);
  const Refinement problem(chain, surface, start, config);
  const State first{start.T_mesh_world, Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(chain.knot_count)),
                    Eigen::VectorXd::Zero(static_cast<Eigen::Index>(chain.parts.size()))};
  const FacetHeights heights = problem.heights(first);
  if (heights.count < kLeastPoints || !(chain.spacing_m > 0.0)) return give_up("too few points lie over the mesh");
  const auto points_over = [&](double length_m) {
    return static_cast<std::size_t>(
        std::clamp(std::round(length_m / chain.spacing_m), 1.0, static_cast<double>(heights.count) / 10.0));
  };
  const std::size_t order = points_over(config.memory_m), smooth = points_over(config.slow_length_m / 8.0);

  // The valley of the start, with the relief's spectrum as it is there; then all valleys with that spectrum.
  Whitening whitening = registration::make_whitening(chain, heights, order, smooth);
  if (!(whitening.variance_m2 > 0.0)) return give_up("the path lies on the mesh exactly");
  Refined best = descend(problem, first, whitening, start.undetermined, config.max_iterations);
  int iterations = best.iterations;
  for (int round = 0; round < kRounds; ++round) {
    whitening = registration::make_whitening(chain, best.heights, order, smooth);
    if (!(whitening.variance_m2 > 0.0)) return give_up("the path lies on the mesh exactly");
    best = descend(problem, best.state, whitening, start.undetermined, config.max_iterations);
    iterations += best.iterations;
    if (round > 0) continue;
    for (const Pose& pose : others) {
      State other = first;
      other.T_mesh_world = pose;
      Refined there = descend(problem, other, whitening, start.undetermined, config.max_iterations);
      iterations += there.iterations;
      if (there.cost < best.cost) best = std::move(there);
    }
  }
  if (!std::isfinite(best.cost) || best.information.rows() == 0)
    return give_up("the path has no unbroken stretch over the mesh");
  RegistrationResult& result = out.registration;
  result.covariance = pose_covariance(best.information) + held_covariance(start.undetermined, config.guess_sigma_m);
  result.T_mesh_world = best.state.T_mesh_world;
  result.rms_m = best.heights.rms_m;
  result.iterations += iterations;
  registration::list_weak_turns(chain, config.undetermined_deg * std::numbers::pi / 180.0, result);
  result.verdict +=
      fmt::format(" With the slow error of the tracker allowed for: residual {:.4f} mm RMS", 1e3 * result.rms_m);
  for (std::size_t i = start.undetermined.size(); i < result.undetermined.size(); ++i) {
    result.verdict += (i == start.undetermined.size() ? "; but " : ", ") + result.undetermined[i].description;
  }
  result.verdict += ".";
  if (!problem.slow()) return out;
  for (std::size_t p = 0; p < paths.size(); ++p) {
    const PathChain::Part& part = chain.parts[p];
    for (std::size_t i = 0; i < part.points; ++i) {
      out.slow_error_world_m[p].push_back(registration::slow_error_m(chain, best.state.knots_m, part.first_point + i));
    }
  }
  return out;
}

}  // namespace asperity
