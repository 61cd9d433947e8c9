#include "fit_base_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "robust_plane.h"

namespace asperity {

namespace {

constexpr double kPiOfFit = std::numbers::pi;

Eigen::Matrix3d mean_fine(const PathEvidence& evidence) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Eigen::Matrix3d& m : evidence.coarse_fine_m2) sum += m;
  return sum / static_cast<double>(evidence.coarse_fine_m2.size());
}

// Smallest rotation from b to a for directions without a sign, in (-π/2, π/2].
double axial_difference(double a, double b) { return std::remainder(a - b, kPiOfFit); }

}  // namespace

Eigen::Vector3d mean_axis(const PathEvidence& evidence) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& a : evidence.coarse_axis) sum += a;
  return sum / static_cast<double>(evidence.coarse_axis.size());
}

PlaneCandidate fit_plane_candidate(const PathEvidence& evidence, const BasePathConfig& config) {
  std::vector<double> weights;
  const PlaneFit fit = fit_robust_plane(evidence.coarse_m, config.slow_error_m, weights);
  // Normals perpendicular to the stroke e1, n(φ) = e3 cos φ + e2 sin φ.
  const Eigen::Vector3d e2 = fit.axes.col(1), e3 = fit.axes.col(2);
  const Eigen::Vector3d axis = mean_axis(evidence);
  const double axis_2 = axis.dot(e2), axis_3 = axis.dot(e3);
  const bool axis_known = std::hypot(axis_2, axis_3) > 0.1;
  const double axis_phi = std::atan2(axis_2, axis_3);

  const Eigen::Matrix3d fine = mean_fine(evidence);
  const double axis_sigma = config.probe_axis_sigma_deg * kDegreeOfFit_rad;

  // A path that leaves the plane by more than the slow error says less about it.
  const double error_m2 = std::max(config.slow_error_m * config.slow_error_m, fit.scatter_m2.z());
  // The posterior on a grid of a tenth of a degree over the half circle about its mode: it may have two humps.
  constexpr int kGridSteps = 1800;
  std::vector<double> log_density(kGridSteps);
  const auto phi_of = [](int k) { return (static_cast<double>(k) / kGridSteps - 0.5) * kPiOfFit; };
  const auto weigh = [&](bool use_path) {
    for (int k = 0; k < kGridSteps; ++k) {
      const double phi = phi_of(k), c = std::cos(phi), s = std::sin(phi);
      double value = 0.0;
      if (use_path)
        value -= 0.5 * evidence.independent * (c * c * fit.scatter_m2.z() + s * s * fit.scatter_m2.y()) / error_m2;
      if (axis_known) value -= 0.5 * std::pow(axial_difference(phi, axis_phi) / axis_sigma, 2);
      log_density[static_cast<std::size_t>(k)] = value;
    }
    return static_cast<int>(std::max_element(log_density.begin(), log_density.end()) - log_density.begin());
  };
  int best = weigh(config.shape != PathShape::kLine);
  // No hand holds a probe along the surface: this path is of strokes that sink deeper as the force rises.
  if (axis_known && std::abs(axial_difference(phi_of(best), axis_phi)) > kLargestLean_rad) best = weigh(false);
  constexpr double kHump_rad = 30.0 * kDegreeOfFit_rad;
  double sum = 0.0, near = 0.0, first = 0.0, second = 0.0;
  for (int d = -kGridSteps / 2; d < kGridSteps / 2; ++d) {
    const auto k = static_cast<std::size_t>((best + d + kGridSteps) % kGridSteps);
    const double density = std::exp(log_density[k] - log_density[static_cast<std::size_t>(best)]);
    const double x = d * kPiOfFit / kGridSteps;
    sum += density;
    second += density * x * x;
    if (std::abs(x) > kHump_rad) continue;
    near += density;
    first += density * x;
  }
  // The mean of the hump about the mode: the mean over two humps would lie in neither.
  const double shift = first / near;
  const double phi = phi_of(best) + shift;

  PlaneCandidate out;
  out.normal = std::cos(phi) * e3 + std::sin(phi) * e2;
  out.stroke = fit.axes.col(0);
  if (axis.dot(out.normal) < 0.0) out.normal *= -1.0;
  out.sigma_rad = std::sqrt(std::max(second / sum - shift * shift, 0.0));
  double square = 0.0, tilt = 0.0, weight = 0.0;
  double offset = 0.0;
  for (std::size_t c = 0; c < evidence.path.size(); ++c) {
    const double d = out.normal.dot(evidence.path.p_m[c] - fit.centroid_m);
    if (evidence.weight[c] == 0.0) continue;
    weight += evidence.weight[c];
    offset += evidence.weight[c] * d;
  }
  // The level is that of the agreed points if some disagree, otherwise of all that was travelled.
  const bool agreed = *std::min_element(weights.begin(), weights.end()) > 0.0;
  out.point_m = fit.centroid_m + (agreed ? offset / weight : 0.0) * out.normal;
  // Without a force sensor a minority off the plane is the approach or the lifting.
  const auto off = static_cast<double>(std::count(weights.begin(), weights.end(), 0.0));
  const bool drop = !evidence.force_measured && off < 0.4 * static_cast<double>(weights.size());
  double kept = 0.0;
  for (std::size_t i = 0; i < evidence.coarse_m.size(); ++i) {
    if (!drop || weights[i] > 0.0) {
      square += std::pow(out.normal.dot(evidence.coarse_m[i] - out.point_m), 2);
      kept += 1.0;
    }
    tilt += std::pow(angle_rad(evidence.coarse_axis[i], out.normal), 2);
  }
  const double count = static_cast<double>(evidence.coarse_m.size());
  out.rms_m = std::sqrt(square / kept);
  out.tilt_rad = std::sqrt(tilt / count);
  out.fine_m2 = out.normal.dot(fine * out.normal);
  return out;
}

// A curvature below this is left to the texture's filter, which takes out a parabola (extract_texture.h).
constexpr double kSignificant = 2.5;

double circle_log_odds(const PlaneCandidate& plane, const CircleCandidate& circle, const PathEvidence& evidence,
                       const BasePathConfig& config) {
  constexpr double kNever = -50.0;
  if (!(circle.significance > kSignificant)) return kNever;
  const double axis_sigma = std::max(config.probe_axis_sigma_deg, 25.0) * kDegreeOfFit_rad;
  double odds = 0.0;
  if (mean_axis(evidence).norm() > 0.1) {
    odds += 0.5 * (plane.tilt_rad * plane.tilt_rad - circle.tilt_rad * circle.tilt_rad) / (axis_sigma * axis_sigma);
  }
  // Both are capped: a texture can be anisotropic, and a hand can follow a ruler or a compass.
  if (plane.fine_m2 > 0.0 && circle.fine_m2 > 0.0)
    odds += std::clamp(1.5 * std::log(circle.fine_m2 / plane.fine_m2), -4.0, 4.0);
  const double error_m2 = config.slow_error_m * config.slow_error_m;
  odds -= std::clamp(0.5 * std::min(evidence.independent, 8.0) *
                         std::log((error_m2 + circle.rms_m * circle.rms_m) / (error_m2 + plane.rms_m * plane.rms_m)),
                     -4.0, 40.0);
  return std::clamp(odds, kNever, -kNever);
}

}  // namespace asperity
