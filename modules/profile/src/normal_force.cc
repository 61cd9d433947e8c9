#include "asperity/profile/normal_force.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "asperity/base/error.h"

namespace asperity {

namespace {

constexpr double kSlow_mps = 5e-3;  // of a hand that rests: its tremor

// The direction of travel along the surface, shorter where the tip hardly moves.
Eigen::Vector3d travel(const Eigen::Vector3d& v_mps, const Eigen::Vector3d& normal) {
  const Eigen::Vector3d along_mps = v_mps - normal * normal.dot(v_mps);
  return along_mps / std::hypot(along_mps.norm(), kSlow_mps);
}

}  // namespace

NormalForce find_normal_force(const TipMotion& motion, std::span<const double> axial_N, const BasePath& path,
                              std::span<const char> contact, const std::optional<Eigen::Vector3d>& axis_in_marker,
                              double normal_sigma_rad, const FrictionAssumption& assumed) {
  const std::size_t n = motion.size();
  const bool three_axes = !motion.force_world_N.empty();
  if (axial_N.size() != n || path.n_world.size() != n || contact.size() != n || motion.v_world_tip_mps.size() != n ||
      motion.q_world_marker.size() != n || (three_axes && motion.force_world_N.size() != n)) {
    throw Error("normal force: motion, readings, base path and contact differ in size (" + std::to_string(n) +
                " samples)");
  }
  NormalForce out;
  out.force_N.assign(axial_N.begin(), axial_N.end());
  const bool measured = std::any_of(axial_N.begin(), axial_N.end(), [](double f) { return std::isfinite(f); });
  if (!three_axes && !measured) return out;
  out.source = three_axes       ? ForceSource::kThreeAxes
               : axis_in_marker ? ForceSource::kCorrectedAxial
                                : ForceSource::kAxial;

  double samples = 0.0, share_sum = 0.0, error_sum = 0.0, normal_sum_N = 0.0, against_sum_N = 0.0, travel_sum = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector3d& normal = path.n_world[i];
    const Eigen::Vector3d t = travel(motion.v_world_tip_mps[i], normal);
    double share = kNan, slope = 0.0;
    if (axis_in_marker) {
      const Eigen::Vector3d axis = motion.q_world_marker[i] * *axis_in_marker;
      share = axis.dot(normal) - assumed.coefficient * axis.dot(t);
      slope = axis.dot(t);
    }
    if (three_axes) {
      out.force_N[i] = normal.dot(motion.force_world_N[i]);
    } else if (share >= assumed.least_share) {
      out.force_N[i] = axial_N[i] / share;
    }
    if (contact[i] == 0 || !(t.norm() > 0.7)) continue;
    if (three_axes && std::isfinite(out.force_N[i])) {
      normal_sum_N += out.force_N[i];
      against_sum_N -= t.dot(motion.force_world_N[i]);
      travel_sum += t.norm();
    }
    samples += 1.0;
    if (!std::isfinite(share)) continue;
    share_sum += share;
    if (share >= assumed.least_share) error_sum += std::pow(assumed.sigma * slope / share, 2);
  }
  if (samples == 0.0) return out;
  out.share = share_sum / samples;
  if (three_axes) {
    out.tangential_share = against_sum_N / normal_sum_N / (travel_sum / samples);
    out.relative_sigma = std::abs(out.tangential_share) * normal_sigma_rad;
  } else if (axis_in_marker && out.share >= assumed.least_share) {
    // A normal turned by φ changes a·n by up to sin(angle) φ.
    const double turned = std::sqrt(std::max(0.0, 1.0 - out.share * out.share)) * normal_sigma_rad / out.share;
    out.relative_sigma = std::hypot(std::sqrt(error_sum / samples), turned);
  } else {
    out.source = ForceSource::kAxial;
  }
  return out;
}

}  // namespace asperity
