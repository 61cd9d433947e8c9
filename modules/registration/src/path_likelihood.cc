#include "path_likelihood.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

namespace asperity::registration {

namespace {

constexpr double kLeastRatio = 0.3, kMostRatio = 100.0;  // of the slow error
constexpr double kLargestSizeStep = 0.15;                // of a Gauss–Newton step

double median_of_values(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), half, values.end());
  return *half;
}

template <int kRows>
double log_determinant(const Eigen::Matrix<double, kRows, kRows>& positive) {
  return positive.ldlt().vectorD().array().log().sum();
}

}  // namespace

PathLikelihood::PathLikelihood(std::span<const MeasuredPath> paths, const RegistrationSurface& surface,
                               const PointSet& points, const MatchRules& rules, const WeighConfig& config)
    : points_(points),
      config_(config),
      blocks_(divide_into_blocks(paths, points, config)),
      matcher_(surface, points, blocks_.chosen, rules) {
  least_m_ = 1e-6 * points.radius_m;
  heights_.resize(blocks_.blocks.size());
  const bool oriented = std::all_of(paths.begin(), paths.end(), [](const MeasuredPath& path) {
    return path.q_world_marker.size() == path.p_world_m.size();
  });
  if (!oriented) return;
  std::vector<Eigen::Matrix3d> of_points;
  for (const MeasuredPath& path : paths) {
    for (std::size_t i = 0; i < path.p_world_m.size(); ++i) {
      if (path.p_world_m[i].allFinite()) of_points.push_back(path.q_world_marker[i].conjugate().toRotationMatrix());
    }
  }
  for (std::size_t i = 0; i < matcher_.size(); ++i) R_marker_world_.push_back(of_points[matcher_.chosen(i)]);
}

void PathLikelihood::measure(const CentredPose& pose, double log_size) {
  const double size = std::exp(log_size);
  matcher_.match(pose, 1.0 / size);
  for (std::size_t b = 0; b < blocks_.blocks.size(); ++b) {
    BlockHeight& height = heights_[b];
    height = {};
    std::size_t count = 0;
    Eigen::Vector3d n = Eigen::Vector3d::Zero();
    for (std::size_t i = blocks_.blocks[b].first; i < blocks_.blocks[b].first + blocks_.blocks[b].count; ++i) {
      const Match& m = matcher_.matches()[i];
      if (!m.usable) continue;
      ++count;
      height.d_m += m.distance_m;
      height.row.head<3>() += (m.y_m - pose.centre_m).cross(m.n);
      height.row[6] += m.distance_m - m.n.dot(m.y_m - pose.centre_m);
      n += m.n;
      if (!R_marker_world_.empty()) height.row.tail<3>() += R_marker_world_[i] * (pose.rotation.conjugate() * m.n);
    }
    height.usable = 2 * count >= blocks_.blocks[b].count;
    if (!height.usable) continue;
    const double share = 1.0 / static_cast<double>(count);
    height.d_m *= size * share;
    height.row.head<3>() *= size * share;
    height.row.segment<3>(3) = size * share * n;
    height.row[6] *= size * share;
    height.row.tail<3>() *= share;
    height.n_world = share * (pose.rotation.conjugate() * n);
  }
}

template <int kRows>
FilterSums<kRows> PathLikelihood::filter(const Scales& scales) const {
  FilterSums<kRows> out;
  for (std::size_t p = 0; p < blocks_.paths.size(); ++p) {
    filter_path<kRows>(blocks_, p, heights_, scales.slow_ratio, scales.noise_m[p], config_, out);
  }
  return out;
}

double PathLikelihood::scales_prior(double slow_ratio) const {
  const double away = std::log(slow_ratio) / (blocks_.stated ? config_.slow_ratio_spread : kUnstatedSpread);
  return away * away;
}

// Where the paths say nothing of a motion, it is still no larger than they are.
PathLikelihood::Prior<6> PathLikelihood::pose_prior(const CentredPose& pose) const {
  return motion_metric(points_, pose) / std::pow(0.5 * points_.radius_m, 2);
}

PathLikelihood::Prior<7> PathLikelihood::size_prior(const CentredPose& pose) const {
  Prior<7> out = Prior<7>::Zero();
  out.topLeftCorner<6, 6>() = pose_prior(pose);
  out(6, 6) = 1.0 / (kSizeSpread * kSizeSpread);
  return out;
}

// −2 log of the likelihood of the scales, the pose (and size) integrated out.
template <int kRows>
double PathLikelihood::restricted_cost(const Scales& scales, const Prior<kRows>& prior) const {
  const FilterSums<kRows> sums = filter<kRows>(scales);
  return sums.cost + log_determinant<kRows>(sums.information + prior);
}

// Of largest likelihood at the pose as it is.
PathLikelihood::Scales PathLikelihood::likeliest_scales(const Scales& near) const {
  // Coordinate search on a logarithmic grid that is halved. A path's noise is its own.
  const auto cost_of = [&](std::size_t p, double slow_ratio, double noise_m) {
    FilterSums<0> sums;
    filter_path<0>(blocks_, p, heights_, slow_ratio, noise_m, config_, sums);
    return sums.cost;
  };
  Scales best = near;
  std::vector<double> cost(blocks_.paths.size()), there(blocks_.paths.size());
  const auto total = [&](const std::vector<double>& costs, double slow_ratio) {
    return std::accumulate(costs.begin(), costs.end(), scales_prior(slow_ratio));
  };
  for (std::size_t p = 0; p < blocks_.paths.size(); ++p) cost[p] = cost_of(p, best.slow_ratio, best.noise_m[p]);
  for (double factor = 2.0; factor > 1.1; factor = std::sqrt(factor)) {
    for (int round = 0; round < 4; ++round) {
      const double before = total(cost, best.slow_ratio);
      for (const double slow : {factor, 1.0 / factor}) {
        const double other = std::clamp(best.slow_ratio * slow, kLeastRatio, kMostRatio);
        for (std::size_t p = 0; p < blocks_.paths.size(); ++p) there[p] = cost_of(p, other, best.noise_m[p]);
        if (!(total(there, other) < total(cost, best.slow_ratio))) continue;
        best.slow_ratio = other;
        cost = there;
      }
      for (std::size_t p = 0; p < blocks_.paths.size(); ++p) {
        for (const double noise : {factor, 1.0 / factor}) {
          const double other = std::max(best.noise_m[p] * noise, least_m_);
          const double then = cost_of(p, best.slow_ratio, other);
          if (!(then < cost[p])) continue;
          best.noise_m[p] = other;
          cost[p] = then;
        }
      }
      if (!(total(cost, best.slow_ratio) < before - 0.5)) break;
    }
  }
  return best;
}

// The same with the degrees of freedom that the pose has taken counted: the slow error can only be larger than it
// seems.
template <int kRows>
PathLikelihood::Scales PathLikelihood::restricted_scales(Scales scales, const Prior<kRows>& prior) const {
  constexpr double kStep = 1.12;
  const auto cost_of = [&](const Scales& at) { return restricted_cost(at, prior) + scales_prior(at.slow_ratio); };
  double cost = cost_of(scales);
  for (Scales next = scales; next.slow_ratio * kStep < kMostRatio;) {
    next.slow_ratio *= kStep;
    const double there = cost_of(next);
    if (!(there < cost)) break;
    scales = next;
    cost = there;
  }
  return scales;
}

// A first estimate of each path's noise, by the bends from block to block.
std::vector<double> PathLikelihood::noise_of_bends() const {
  std::vector<double> out;
  for (const PathBlocks::Path& path : blocks_.paths) {
    std::vector<double> bends_m;
    for (std::size_t b = path.first + 1; b + 1 < path.first + path.count; ++b) {
      if (!heights_[b - 1].usable || !heights_[b].usable || !heights_[b + 1].usable) continue;
      bends_m.push_back(std::abs(heights_[b - 1].d_m - 2.0 * heights_[b].d_m + heights_[b + 1].d_m));
    }
    out.push_back(std::max(least_m_, median_of_values(std::move(bends_m)) / (0.6745 * std::sqrt(6.0))));
  }
  return out;
}

PathLikelihood::Evaluation PathLikelihood::evaluate(const CentredPose& pose) {
  measure(pose);
  return evaluate_measured<6>(pose, pose_prior(pose));
}

template <int kRows>
PathLikelihood::Evaluation PathLikelihood::evaluate_measured(const CentredPose& pose, const Prior<kRows>& prior) const {
  Evaluation out;
  out.pose = pose;
  out.scales = restricted_scales<kRows>(likeliest_scales({1.0, noise_of_bends()}), prior);
  const FilterSums<kRows> sums = filter<kRows>(out.scales);
  out.cost = sums.cost + scales_prior(out.scales.slow_ratio);
  out.log_precision = log_determinant<kRows>(sums.information + prior);
  out.information = sums.information.template topLeftCorner<6, 6>();
  out.outlying =
      static_cast<double>(sums.outlying) / static_cast<double>(std::max<std::size_t>(1, blocks_.blocks.size()));
  // Curvature of the restricted likelihood, in steps of the logarithm that are about its width.
  constexpr double kStep = 0.3, kMostSigma = 2.0;
  const auto cost_at = [&](double step) {
    return restricted_cost<kRows>({out.scales.slow_ratio * std::exp(step), out.scales.noise_m}, prior);
  };
  const double curvature = (cost_at(kStep) + cost_at(-kStep) - 2.0 * (sums.cost + out.log_precision)) / (kStep * kStep);
  out.slow_ratio_sigma = std::sqrt(2.0 / std::max(curvature, 2.0 / (kMostSigma * kMostSigma)));
  return out;
}

PathLikelihood::Evaluation PathLikelihood::descend(const CentredPose& start, int rounds, int steps) {
  Evaluation best = evaluate(start);
  const double damping = 1.0 / std::pow(0.3 * points_.radius_m, 2);
  for (int round = 0; round < rounds; ++round) {
    CentredPose pose = best.pose;
    measure(pose);
    FilterSums<6> sums = filter<6>(best.scales);
    for (int k = 0; k < steps; ++k) {
      const Matrix6 hessian = sums.information + damping * motion_metric(points_, pose);
      const Vector6 step = -hessian.ldlt().solve(sums.gradient);
      if (!step.allFinite()) break;
      const double size2 = step.dot(hessian * step);
      bool fell = false;
      for (double share = 1.0; share > 0.1 && !fell; share *= 0.5) {
        const CentredPose next = moved(pose, share * step);
        measure(next);
        const FilterSums<6> there = filter<6>(best.scales);
        if (!(there.cost < sums.cost)) continue;
        fell = true;
        pose = next;
        sums = there;
      }
      if (!fell || size2 < 0.02) break;
    }
    const Evaluation now = evaluate(pose);
    if (!(now.restricted() < best.restricted())) break;
    const bool settled = best.restricted() - now.restricted() < 0.1;
    best = now;
    if (settled) break;
  }
  return best;
}

PathLikelihood::Scaled PathLikelihood::descend_with_size(const CentredPose& start, double log_size, int rounds,
                                                         int steps) {
  const double damping = 1.0 / std::pow(0.3 * points_.radius_m, 2);
  const auto prior = [](double at) { return std::pow(at / kSizeSpread, 2); };
  const auto evaluated = [&](const CentredPose& pose, double at) {
    measure(pose, at);
    Scaled out{evaluate_measured<7>(pose, size_prior(pose)), at, {}};
    out.at.cost += prior(at);
    return out;
  };
  Scaled best = evaluated(start, log_size);
  for (int round = 0; round < rounds; ++round) {
    CentredPose pose = best.at.pose;
    double size = best.log_size;
    measure(pose, size);
    FilterSums<7> sums = filter<7>(best.at.scales);
    sums.cost += prior(size);
    for (int k = 0; k < steps; ++k) {
      Eigen::Matrix<double, 7, 7> hessian = sums.information;
      hessian.topLeftCorner<6, 6>() += damping * motion_metric(points_, pose);
      hessian(6, 6) += 1.0 / (kSizeSpread * kSizeSpread);
      Eigen::Matrix<double, 7, 1> gradient = sums.gradient;
      gradient[6] += size / (kSizeSpread * kSizeSpread);
      Eigen::Matrix<double, 7, 1> step = -hessian.ldlt().solve(gradient);
      if (!step.allFinite()) break;
      step *= std::min(1.0, kLargestSizeStep / std::abs(step[6]));
      const double size2 = step.dot(hessian * step);
      bool fell = false;
      for (double share = 1.0; share > 0.1 && !fell; share *= 0.5) {
        const CentredPose next = moved(pose, share * step.head<6>());
        const double next_size = size + share * step[6];
        measure(next, next_size);
        FilterSums<7> there = filter<7>(best.at.scales);
        there.cost += prior(next_size);
        if (!(there.cost < sums.cost)) continue;
        fell = true;
        pose = next;
        size = next_size;
        sums = there;
      }
      if (!fell || size2 < 0.02) break;
    }
    const Scaled now = evaluated(pose, size);
    if (!(now.at.restricted() < best.at.restricted())) break;
    const bool settled = best.at.restricted() - now.at.restricted() < 0.1;
    best = now;
    if (settled) break;
  }
  measure(best.at.pose, best.log_size);
  best.information = filter<10>(best.at.scales).information;
  return best;
}

}  // namespace asperity::registration
