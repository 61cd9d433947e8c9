#include "asperity/profile/height_error_density.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace asperity {

namespace {

double interpolated_density(const std::vector<double>& at, const std::vector<double>& density_m2ps,
                            double frequency_Hz) {
  if (density_m2ps.size() != at.size()) return 0.0;
  const auto next = std::upper_bound(at.begin(), at.end(), frequency_Hz);
  if (next == at.begin() || next == at.end()) return 0.0;
  const auto i = static_cast<std::size_t>(next - at.begin());
  const double share = (frequency_Hz - at[i - 1]) / (at[i] - at[i - 1]);
  return density_m2ps[i - 1] + share * (density_m2ps[i] - density_m2ps[i - 1]);
}

double fourth(double x) { return x * x * x * x; }

double rotation_density(const HeightErrors& errors, double omega) {
  const double tracker = errors.rotation_tracker_psd_rad2ps;
  const double rate = errors.rotation_rate_psd_rad2ps3, accel = errors.rotation_accel_psd_rad2ps5;
  if (!(tracker > 0.0)) return 0.0;
  if (rate > 0.0) return rate * tracker / (rate + tracker * omega * omega);
  return accel > 0.0 ? accel * tracker / (accel + tracker * fourth(omega)) : 0.0;
}

double object_density(const std::vector<ObjectAxisError>& axes, double slow_time_s, double omega) {
  double out = 0.0;
  for (const ObjectAxisError& axis : axes) {
    if (!(axis.pose_psd > 0.0) || !(axis.motion_psd > 0.0)) continue;
    const double share = axis.motion_psd / (axis.motion_psd + axis.pose_psd * fourth(omega));
    const double slow = 4.0 * std::pow(axis.slow_sigma, 2) * slow_time_s / (1.0 + std::pow(omega * slow_time_s, 2));
    out += axis.weight * (share * axis.pose_psd + share * share * slow);
  }
  return out;
}

}  // namespace

double height_error_density_m2ps(const HeightErrors& errors, double frequency_Hz) {
  if (!(errors.accel_psd_m2ps3 > 0.0) || !(errors.tracker_psd_m2ps > 0.0)) return 0.0;
  const double omega = 2.0 * std::numbers::pi * frequency_Hz;
  const double rotation = rotation_density(errors, omega);
  const double accel = errors.accel_psd_m2ps3 * (1.0 + errors.accel_corner_Hz / frequency_Hz) +
                       errors.accel_walk_psd_m2ps5 / (omega * omega) + std::pow(errors.force_across_mps2, 2) * rotation;
  const double tracker = errors.tracker_psd_m2ps;
  const double share = accel / (accel + tracker * fourth(omega));
  const double slow = 4.0 * std::pow(errors.tracker_slow_sigma_m, 2) * errors.tracker_slow_time_s /
                      (1.0 + std::pow(omega * errors.tracker_slow_time_s, 2));
  const double crosstalk = interpolated_density(errors.crosstalk_Hz, errors.crosstalk_m2ps, frequency_Hz);
  return share * tracker + share * share * slow + (1.0 - share) * (1.0 - share) * crosstalk +
         std::pow(errors.lever_m, 2) * rotation + object_density(errors.object, errors.object_slow_time_s, omega) +
         interpolated_density(errors.crosstalk_Hz, errors.leaning_m2ps, frequency_Hz);
}

}  // namespace asperity
