#include "asperity/profile/measure_length_error.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "asperity/base/units.h"
#include "asperity/signal/statistics.h"

namespace asperity {

namespace {

constexpr double kAlongStep_m = 1e-3;
constexpr double kLevel_m = 0.1e-3;      // of the relief over the base, as deep textures are
constexpr double kTurnStep_m = 4e-3;     // longer than what a tip jumps aside at a hole, over which no error changes
constexpr double kFades_s = 0.5;         // correlation time of a smoothed position's error
constexpr double kClosest = 0.25;        // of what following bends closer adds: what the next closer one may
constexpr double kIndependent_Hz = 1.0;  // slow errors of the height a second, as find_base_path.h takes them

// The samples between which the path lies: the last of the rest before it and the first of that after it.
struct Ends {
  std::size_t first = 0, last = 0;
};

Ends find_ends(const BasePathResult& base) {
  const std::vector<double>& s_m = base.path.s_m;
  Ends out;
  double low_m = std::numeric_limits<double>::infinity(), high_m = -low_m;
  for (std::size_t i = 0; i < s_m.size(); ++i) {
    if (base.contact[i] == 0) continue;
    if (s_m[i] > high_m) {
      high_m = s_m[i];
      out.last = i;
    }
    if (s_m[i] <= low_m) {
      low_m = s_m[i];
      out.first = i;
    }
  }
  return out;
}

// The position's covariance without what the tip's place in the marker gives it.
Eigen::Matrix3d own_covariance_m2(const TipMotion& motion, std::size_t i) {
  const Eigen::Matrix3d R = motion.q_world_marker[i].toRotationMatrix();
  return motion.cov_world_tip_m2[i] - R * motion.sigma_tip_in_marker_m.cwiseAbs2().asDiagonal() * R.transpose();
}

// A step along the path.
struct Step {
  std::size_t from = 0, to = 0;  // samples
  Eigen::Vector3d along_world;   // unit
};

std::vector<Step> find_steps(const BasePathResult& base, const Ends& ends, double step_m) {
  std::vector<Step> out;
  std::size_t from = ends.first;
  for (std::size_t i = ends.first; i <= ends.last; ++i) {
    if (base.contact[i] == 0 || base.path.s_m[i] - base.path.s_m[from] < step_m) continue;
    const Eigen::Vector3d way_m = base.path.p_world_m[i] - base.path.p_world_m[from];
    if (way_m.norm() > 0.0) out.push_back({from, i, way_m.normalized()});
    from = i;
  }
  return out;
}

double along_variance_m2(const TipMotion& motion, std::size_t i, const Eigen::Vector3d& along) {
  return std::max(0.0, along.dot(own_covariance_m2(motion, i) * along));
}

// Of −∫ e·dt: the sum over pairs of steps, each with what has faded of those before it.
double turned_variance_m2(const TipMotion& motion, const std::vector<Step>& steps) {
  double out_m2 = 0.0;
  Eigen::Vector3d before = Eigen::Vector3d::Zero();  // Σ Δt of earlier steps, faded
  for (std::size_t k = 1; k < steps.size(); ++k) {
    const double time_s =
        static_cast<double>(motion.t_ns[steps[k].from] - motion.t_ns[steps[k - 1].from]) * kNanosecond_s;
    before *= std::exp(-time_s / kFades_s);
    const Eigen::Vector3d turned = steps[k].along_world - steps[k - 1].along_world;
    out_m2 += turned.dot(own_covariance_m2(motion, steps[k].from) * (turned + 2.0 * before));
    before += turned;
  }
  return std::max(0.0, out_m2);
}

}  // namespace

LengthErrors measure_length_error(const TipMotion& motion, const BasePathResult& base,
                                  const Eigen::Vector3d& tip_in_marker_m, double tip_radius_m,
                                  double indentation_sigma_m) {
  LengthErrors out;
  const std::size_t n = motion.size();
  if (n == 0 || motion.cov_world_tip_m2.size() != n || base.path.size() != n || base.contact.size() != n) return out;
  const Ends ends = find_ends(base);
  if (ends.last <= ends.first) return out;
  const std::vector<Step> steps = find_steps(base, ends, kAlongStep_m);
  if (steps.empty()) return out;

  const double ends_m2 = along_variance_m2(motion, ends.first, steps.front().along_world) +
                         along_variance_m2(motion, ends.last, steps.back().along_world);
  Eigen::Vector3d turned_marker = Eigen::Vector3d::Zero();  // Σ ΔRᵀ t
  double turned_normal = 0.0;                               // Σ Δn·t
  std::vector<double> normal_m2, along_m2;
  for (const Step& step : steps) {
    const Eigen::Matrix3d R0 = motion.q_world_marker[step.from].toRotationMatrix();
    const Eigen::Matrix3d R1 = motion.q_world_marker[step.to].toRotationMatrix();
    turned_marker += (R1 - R0).transpose() * step.along_world;
    turned_normal += (base.path.n_world[step.to] - base.path.n_world[step.from]).dot(step.along_world);
    along_m2.push_back(along_variance_m2(motion, step.to, step.along_world));
    const Eigen::Vector3d& normal = base.path.n_world[step.to];
    normal_m2.push_back(std::max(0.0, normal.dot(own_covariance_m2(motion, step.to) * normal)));
  }
  const double duration_s = static_cast<double>(motion.t_ns[ends.last] - motion.t_ns[ends.first]) * kNanosecond_s;
  const double level_m = std::hypot(std::hypot(kLevel_m, indentation_sigma_m),
                                    std::sqrt(mean(normal_m2) / std::max(1.0, kIndependent_Hz * duration_s)));
  const double turned_probe = tip_in_marker_m.norm() > 0.0 ? -turned_marker.dot(tip_in_marker_m.normalized()) : 0.0;
  const double ball_m = tip_radius_m / std::numbers::sqrt3 * (turned_normal - turned_probe);
  const double tip_m = turned_marker.cwiseProduct(motion.sigma_tip_in_marker_m).norm();
  const double length_m = base.path.s_m[ends.last] - base.path.s_m[ends.first];
  out.ends_m = std::sqrt(ends_m2);
  out.turned_m = std::sqrt(turned_variance_m2(motion, find_steps(base, ends, kTurnStep_m)));
  out.bends_m = kClosest * std::abs(base.bends_m);
  out.place_m = std::sqrt(mean(along_m2));
  out.scale_sigma = std::hypot(std::hypot(tip_m, ball_m), level_m * turned_normal) / length_m;
  return out;
}

}  // namespace asperity
