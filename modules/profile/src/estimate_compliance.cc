#include "asperity/profile/estimate_compliance.h"

#include <cmath>

#include "asperity/base/units.h"
#include "asperity/profile/blend_acceleration.h"
#include "asperity/signal/resample.h"
#include "asperity/signal/statistics.h"

namespace asperity {

double compliance_coefficient(double sigma_r2) { return std::exp(-sigma_r2); }

Compliance estimate_compliance(const TipMotion& motion, std::span<const Eigen::Vector3d> n_world,
                               const ComplianceConfig& config) {
  const std::vector<double> a_normal_mps2 = blend_acceleration(motion.a_world_tip_mps2, n_world);
  const std::vector<double> force_N = bridge_gaps(motion.force_N);
  Compliance out;
  const auto window_ns = static_cast<std::int64_t>(std::llround(config.window_s / kNanosecond_s));
  std::size_t begin = 0;
  while (begin < motion.size()) {
    std::size_t end = begin + 1;
    while (end < motion.size() && motion.t_ns[end] - motion.t_ns[begin] < window_ns) ++end;
    // The last, incomplete window is left out.
    if (end < motion.size() && end - begin >= 4) {
      const Eigen::Vector3d n = n_world[(begin + end) / 2];
      Eigen::Vector3d way_m = motion.p_world_tip_m[end] - motion.p_world_tip_m[begin];
      way_m -= way_m.dot(n) * n;
      ComplianceWindow window;
      window.force_N = mean(std::span(force_N).subspan(begin, end - begin));
      window.amplitude_mps2 = standard_deviation(std::span(a_normal_mps2).subspan(begin, end - begin));
      window.speed_mps = way_m.norm() / (static_cast<double>(motion.t_ns[end] - motion.t_ns[begin]) * kNanosecond_s);
      if (window.force_N >= config.min_force_N && window.speed_mps >= config.min_speed_mps &&
          window.amplitude_mps2 > 0.0) {
        window.ratio = window.force_N * window.speed_mps * window.speed_mps / window.amplitude_mps2;
        out.windows.push_back(window);
      }
    }
    begin = end;
  }
  if (out.windows.size() < static_cast<std::size_t>(config.min_windows)) return out;
  std::vector<double> ratio;
  for (const ComplianceWindow& window : out.windows) ratio.push_back(window.ratio);
  const double scale = 1.0 / mean(ratio);
  for (std::size_t i = 0; i < ratio.size(); ++i) out.windows[i].ratio = ratio[i] *= scale;
  out.sigma_r2 = variance(ratio);
  out.k_c = compliance_coefficient(out.sigma_r2);
  return out;
}

}  // namespace asperity
