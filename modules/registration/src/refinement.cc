#include "refinement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "pose_motion.h"

namespace asperity::registration {

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

// The inverse of the knots' prior covariance C exp(−|Δs|/length): of a first-order Markov chain, three blocks wide.
// Knots of paths without a slow error are held at zero.
Triplets prior_precision(const PathChain& chain, const RefineConfig& config) {
  constexpr double kHeld = 1e18;  // 1 nm
  Triplets out;
  const double rho = std::exp(-config.knot_m / config.slow_length_m), one = 1.0 / (1.0 - rho * rho);
  const auto add = [&](std::size_t a, std::size_t b, const Eigen::Matrix3d& block) {
    for (Eigen::Index i = 0; i < 3; ++i)
      for (Eigen::Index j = 0; j < 3; ++j) {
        if (block(i, j) == 0.0) continue;
        out.emplace_back(static_cast<int>(3 * a) + static_cast<int>(i), static_cast<int>(3 * b) + static_cast<int>(j),
                         block(i, j));
      }
  };
  for (const PathChain::Part& part : chain.parts) {
    const Eigen::Matrix3d covariance = config.slow_factor * config.slow_factor * part.covariance_m2;
    const Eigen::Matrix3d weight =
        part.is_slow ? Eigen::Matrix3d(covariance.inverse()) : Eigen::Matrix3d(kHeld * Eigen::Matrix3d::Identity());
    for (std::size_t k = 0; k < part.knots; ++k) {
      const std::size_t knot = part.first_knot + k;
      const bool end = k == 0 || k + 1 == part.knots;
      const double diagonal = !part.is_slow || part.knots == 1 ? 1.0 : one * (end ? 1.0 : 1.0 + rho * rho);
      add(knot, knot, diagonal * weight);
      if (!part.is_slow || k + 1 == part.knots) continue;
      add(knot, knot + 1, -one * rho * weight);
      add(knot + 1, knot, -one * rho * weight);
    }
  }
  return out;
}

// A row of the equations: few unknowns, in ascending groups.
class Row {
 public:
  explicit Row(Eigen::Index size) : value_(Eigen::VectorXd::Zero(size)), seen_(static_cast<std::size_t>(size), 0) {}
  template <class Vector>
  void add(Eigen::Index at, const Vector& values) {
    for (Eigen::Index k = 0; k < values.size(); ++k) add_one(at + k, values[k]);
  }
  void add_one(Eigen::Index at, double value) {
    if (seen_[static_cast<std::size_t>(at)] == 0) {
      seen_[static_cast<std::size_t>(at)] = 1;
      touched_.push_back(at);
    }
    value_[at] += value;
  }
  const std::vector<Eigen::Index>& touched() {
    std::sort(touched_.begin(), touched_.end());
    return touched_;
  }
  double operator[](Eigen::Index at) const { return value_[at]; }
  void clear() {
    for (const Eigen::Index at : touched_) {
      value_[at] = 0.0;
      seen_[static_cast<std::size_t>(at)] = 0;
    }
    touched_.clear();
  }

 private:
  Eigen::VectorXd value_;
  std::vector<char> seen_;
  std::vector<Eigen::Index> touched_;
};

// Sums of outer products: the unknowns at the head with all, dense; knots with the knots near them, by bands; the rest
// entry by entry.
class Accumulator {
 public:
  Accumulator(Eigen::Index head, Eigen::Index size)
      : head_(head),
        size_(size),
        top_(Eigen::MatrixXd::Zero(head, size)),
        band_(Eigen::MatrixXd::Zero(kBand, size - head)) {}

  void add(Row& row, double weight) {
    const std::vector<Eigen::Index>& touched = row.touched();
    for (std::size_t a = 0; a < touched.size(); ++a) {
      const Eigen::Index i = touched[a];
      const double scaled = weight * row[i];
      for (std::size_t b = a; b < touched.size(); ++b) {
        const Eigen::Index j = touched[b];
        const double product = scaled * row[j];
        if (i < head_) {
          top_(i, j) += product;
        } else if (j - i < kBand) {
          band_(j - i, i - head_) += product;
        } else {
          far_.emplace_back(static_cast<int>(j), static_cast<int>(i), product);
        }
      }
    }
  }
  Eigen::MatrixXd& top() { return top_; }

  // The lower triangle, with `knots` added to that of the knots.
  Eigen::SparseMatrix<double> matrix(const Triplets& knots) {
    Triplets all = std::move(far_);
    for (Eigen::Index i = 0; i < head_; ++i)
      for (Eigen::Index j = i; j < size_; ++j)
        if (top_(i, j) != 0.0) all.emplace_back(static_cast<int>(j), static_cast<int>(i), top_(i, j));
    for (Eigen::Index i = 0; i < band_.cols(); ++i)
      for (Eigen::Index k = 0; k < kBand && i + k < band_.cols(); ++k)
        if (band_(k, i) != 0.0)
          all.emplace_back(static_cast<int>(head_ + i + k), static_cast<int>(head_ + i), band_(k, i));
    for (const auto& entry : knots)
      if (entry.row() >= entry.col())
        all.emplace_back(static_cast<int>(head_) + entry.row(), static_cast<int>(head_) + entry.col(), entry.value());
    Eigen::SparseMatrix<double> out(size_, size_);
    out.setFromTriplets(all.begin(), all.end());
    return out;
  }

 private:
  static constexpr Eigen::Index kBand = 12;
  Eigen::Index head_, size_;
  Eigen::MatrixXd top_, band_;
  Triplets far_;
};

// Cauchy's cost of a residual in standard deviations, and its weight: a link of two places that only look alike must
// not pull.
constexpr double kCauchy = 2.0;
double cauchy_cost(double r) { return kCauchy * kCauchy * std::log1p(r * r / (kCauchy * kCauchy)); }
double cauchy_weight(double r) { return 1.0 / (1.0 + r * r / (kCauchy * kCauchy)); }

}  // namespace

Refinement::Refinement(const PathChain& chain, const MeshSurface& surface, std::vector<PosePrior> priors,
                       const RefineConfig& config)
    : chain_(chain), surface_(surface), priors_(std::move(priors)), config_(config) {
  slow_ = config.slow_factor > 0.0 &&
          std::any_of(chain.parts.begin(), chain.parts.end(), [](const PathChain::Part& part) { return part.is_slow; });
  knots_at_ = levels_at() + static_cast<Eigen::Index>(chain.parts.size());
  if (slow_) {
    precision_ = prior_precision(chain, config);
    const auto count = 3 * static_cast<Eigen::Index>(chain.knot_count);
    prior_knots_.resize(count, count);
    prior_knots_.setFromTriplets(precision_.begin(), precision_.end());
  }
  const double turn_rad = config.guess_sigma_deg * std::numbers::pi / 180.0;
  guess_precision_ << Eigen::Vector3d::Constant(1.0 / (turn_rad * turn_rad)),
      Eigen::Vector3d::Constant(1.0 / (config.guess_sigma_m * config.guess_sigma_m));
}

State Refinement::moved(const State& state, const Eigen::VectorXd& step) const {
  State out = state;
  for (std::size_t k = 0; k < state.T_mesh_world.size(); ++k) {
    const auto at = 6 * static_cast<Eigen::Index>(k);
    const Eigen::Vector3d& centre_m = priors_[k].centre_mesh_m;
    const Eigen::Quaterniond turn = exp_rotation(step.segment<3>(at));
    out.T_mesh_world[k].rotation = (turn * state.T_mesh_world[k].rotation).normalized();
    out.T_mesh_world[k].translation_m =
        turn * (state.T_mesh_world[k].translation_m - centre_m) + centre_m + step.segment<3>(at + 3);
  }
  out.tip_m += step.segment(tips_at(), out.tip_m.size());
  out.bulge += step[bulge_at()];
  out.level_m += step.segment(levels_at(), out.level_m.size());
  if (slow_) out.knots_m += step.tail(step.size() - knots_at_);
  return out;
}

Equations Refinement::equations(const State& state, const FacetHeights& heights,
                                std::span<const Whitening> whitening) const {
  const Eigen::Index size = this->size();
  Equations out;
  out.right = Eigen::VectorXd::Zero(size);
  Accumulator sum(knots_at_, size);
  Row row(size);
  // The gradient of a point's position along `direction` (mesh frame), times `factor`.
  const auto add_point = [&](std::size_t i, const Eigen::Vector3d& direction, double factor) {
    const PathChain::Part& part = chain_.parts[chain_.part_of[i]];
    const auto pose = 6 * static_cast<Eigen::Index>(part.placement);
    const Eigen::Vector3d turn = (heights.p_mesh_m[i] - priors_[part.placement].centre_mesh_m).cross(direction);
    row.add(pose, Eigen::Vector3d(factor * turn));
    row.add(pose + 3, Eigen::Vector3d(factor * direction));
    const Eigen::Vector3d world = factor * (state.T_mesh_world[part.placement].rotation.conjugate() * direction);
    if (part.has_tip) {
      row.add(tips_at() + 3 * static_cast<Eigen::Index>(part.tip),
              Eigen::Vector3d(chain_.R_world_marker[i].transpose() * world));
    }
    if (!slow_ || !part.is_slow) return;
    const auto [knot, share] = chain_.knots[i];
    const Eigen::Index column = knots_at_ + 3 * static_cast<Eigen::Index>(knot);
    row.add(column, Eigen::Vector3d(-(1.0 - share) * world));
    row.add(column + 3, Eigen::Vector3d(-share * world));
  };
  const auto close = [&](double residual, double weight) {
    sum.add(row, weight);
    for (const Eigen::Index at : row.touched()) out.right[at] -= weight * residual * row[at];
    row.clear();
  };
  for (std::size_t p = 0; p < chain_.parts.size(); ++p) {
    const Whitening& filter = whitening[p];
    if (!(filter.variance_m2 > 0.0)) continue;
    const auto level = levels_at() + static_cast<Eigen::Index>(p);
    for_whitened(chain_.parts[p], heights, filter.a.size(), [&](std::size_t i) {
      const auto add = [&](std::size_t at, double factor) {
        add_point(at, heights.normal[at], factor);
        row.add_one(bulge_at(), -factor * heights.bulge_m[at]);
        row.add_one(level, -factor);
      };
      add(i, 1.0);
      for (std::size_t k = 1; k <= filter.a.size(); ++k) add(i - k, filter.a[k - 1]);
      close(whitened(heights, filter, i), 1.0 / filter.variance_m2);
      ++out.rows;
    });
  }
  for (const OverlapLink& link : links_) {
    const LinkResidual r = link_residual(link, heights);
    if (!r.known) continue;
    add_point(link.a, r.direction, 1.0);
    add_point(link.b, r.direction, -(1.0 - link.share));
    add_point(link.b + 1, r.direction, -link.share);
    close(r.value_m, cauchy_weight(r.value_m / link.sigma_m) / (link.sigma_m * link.sigma_m));
  }

  Eigen::MatrixXd& top = sum.top();
  for (std::size_t p = 0; p < chain_.parts.size(); ++p) {
    const auto at = levels_at() + static_cast<Eigen::Index>(p);
    const ReliefLevel& level = whitening[p].level;
    if (!(level.sigma_m > 0.0)) {
      top(at, at) += 1e18;
      continue;
    }
    const double precision = 1.0 / (level.sigma_m * level.sigma_m);
    top(at, at) += precision;
    out.right[at] -= precision * (state.level_m[static_cast<Eigen::Index>(p)] - level.mean_m);
  }
  for (std::size_t t = 0; t < chain_.tip_sigma_m.size(); ++t) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      const Eigen::Index within = 3 * static_cast<Eigen::Index>(t) + k, at = tips_at() + within;
      const double precision = 1.0 / (chain_.tip_sigma_m[t][k] * chain_.tip_sigma_m[t][k]);
      top(at, at) += precision;
      out.right[at] -= precision * state.tip_m[within];
    }
  }
  top(bulge_at(), bulge_at()) += 1.0 / (kBulgeSigma * kBulgeSigma);
  out.right[bulge_at()] -= (state.bulge - kBulge) / (kBulgeSigma * kBulgeSigma);
  for (std::size_t k = 0; k < priors_.size(); ++k) {
    const auto at = 6 * static_cast<Eigen::Index>(k);
    const Vector6 from_guess = pose_change(priors_[k].T_mesh_world, state.T_mesh_world[k], priors_[k].centre_mesh_m);
    top.diagonal().segment<6>(at) += guess_precision_;
    out.right.segment<6>(at) -= guess_precision_.cwiseProduct(from_guess);
    // Along motions of which the paths say nothing the pose is made stiff.
    const double stiff = 1e6 * top.diagonal().segment<6>(at).sum();
    for (const UndeterminedMotion& motion : priors_[k].held) {
      Vector6 direction;
      direction << motion.rotation_rad, motion.shift_m;
      if (direction.norm() > 0.0) direction.normalize();
      top.block<6, 6>(at, at) += stiff * direction * direction.transpose();
    }
  }
  if (slow_) out.right.tail(size - knots_at_) -= prior_knots_ * state.knots_m;
  out.information = sum.matrix(precision_);
  out.cost = cost(state, heights, whitening);
  return out;
}

double Refinement::likelihood_cost(const State& state, const FacetHeights& heights,
                                   std::span<const Whitening> whitening) const {
  double out = 0.0;
  std::size_t all_rows = 0;
  for (std::size_t p = 0; p < chain_.parts.size(); ++p) {
    const Whitening& filter = whitening[p];
    const PathChain::Part& part = chain_.parts[p];
    if (!(filter.variance_m2 > 0.0)) continue;
    double sum = 0.0;
    std::size_t rows = 0;
    for_whitened(part, heights, filter.a.size(), [&](std::size_t i) {
      const double w = whitened(heights, filter, i);
      sum += w * w;
      ++rows;
    });
    all_rows += rows;
    const double away_m = state.level_m[static_cast<Eigen::Index>(p)] - filter.level.mean_m;
    out += away_m * away_m / (filter.level.sigma_m * filter.level.sigma_m);
    // Points that do not count are as good as the rest; a path without any has left the mesh.
    const auto points = static_cast<double>(part.points);
    out += rows > 0 ? points / static_cast<double>(rows) * sum / filter.variance_m2
                    : points * config_.outlier_sigmas * config_.outlier_sigmas;
  }
  if (all_rows < kLeastPoints) return std::numeric_limits<double>::infinity();
  for (const OverlapLink& link : links_) {
    const LinkResidual r = link_residual(link, heights);
    if (r.known) out += cauchy_cost(r.value_m / link.sigma_m);
  }
  for (std::size_t t = 0; t < chain_.tip_sigma_m.size(); ++t) {
    out += state.tip_m.segment<3>(3 * static_cast<Eigen::Index>(t)).cwiseQuotient(chain_.tip_sigma_m[t]).squaredNorm();
  }
  out += (state.bulge - kBulge) * (state.bulge - kBulge) / (kBulgeSigma * kBulgeSigma);
  return out + (slow_ ? state.knots_m.dot(prior_knots_ * state.knots_m) : 0.0);
}

double Refinement::cost(const State& state, const FacetHeights& heights, std::span<const Whitening> whitening) const {
  double out = likelihood_cost(state, heights, whitening);
  for (std::size_t k = 0; k < priors_.size(); ++k) {
    const Vector6 from_guess = pose_change(priors_[k].T_mesh_world, state.T_mesh_world[k], priors_[k].centre_mesh_m);
    out += from_guess.dot(guess_precision_.cwiseProduct(from_guess));
  }
  return out;
}

}  // namespace asperity::registration
