#include "measure_on_surface.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "asperity/profile/estimate_stiffness.h"
#include "asperity/profile/length_on_surface.h"
#include "asperity/profile/likely_compliance.h"

namespace asperity {

namespace {

constexpr double kDeepest_m = 1e-3;  // tips are no longer

}  // namespace

void measure_on_surface(const TipMotion& motion, const BasePathConfig& config, BasePathResult& base) {
  if (base.shape != PathShape::kCircle && base.shape != PathShape::kCurve) return;
  if (motion.force_N.size() != base.path.size()) return;
  const StiffnessEstimate stiffness = estimate_stiffness(
      motion, base.path, base.contact, {}, base.shape == PathShape::kCurve ? config.curve_cutoff_cycles_per_mm : 0.0);
  const LikelyCompliance compliance = likely_compliance(
      stiffness.compliance_mm_per_N, stiffness.compliance_stderr_mm_per_N, stiffness.degrees_of_freedom);

  std::vector<double> indentation_m(motion.force_N.size(), 0.0);
  double sum_N = 0.0, sum_m = 0.0, count = 0.0;
  for (std::size_t i = 0; i < indentation_m.size(); ++i) {
    const double force_N = std::abs(motion.force_N[i]);
    if (base.contact[i] == 0 || !std::isfinite(force_N)) continue;
    indentation_m[i] = std::min(1e-3 * compliance.mean_mm_per_N * force_N, kDeepest_m);
    sum_N += force_N;
    sum_m += indentation_m[i];
    count += 1.0;
  }
  if (count == 0.0) return;
  base.indentation_m = sum_m / count;
  base.indentation_sigma_m = std::min(1e-3 * compliance.sigma_mm_per_N * sum_N / count, kDeepest_m);
  base.tip_s_m = base.path.s_m;
  base.path.s_m = length_on_surface(base.path, base.contact, indentation_m);
  base.length_m = *std::max_element(base.path.s_m.begin(), base.path.s_m.end());
}

}  // namespace asperity
