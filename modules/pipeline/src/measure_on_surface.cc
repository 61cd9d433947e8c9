#include "measure_on_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "asperity/base/nan.h"
#include "asperity/profile/estimate_stiffness.h"
#include "asperity/profile/length_on_surface.h"
#include "asperity/profile/likely_compliance.h"

namespace asperity {

namespace {

constexpr double kDeepest_m = 1e-3;  // tips are no longer
// The compliance is the slope at the force in use; of a contact in which F = K δⁿ the depth is n c F, n from 1
// (springs) to 1.5 (Hertz's ball): relative, as if evenly spread above 1.
constexpr double kForceLaw = 0.5 / std::numbers::sqrt3;

}  // namespace

void measure_on_surface(const TipMotion& motion, const BasePathConfig& config, BasePathResult& base,
                        bool force_limited) {
  if (base.shape != PathShape::kCircle && base.shape != PathShape::kCurve && base.shape != PathShape::kDoublyCurved) {
    return;
  }
  if (motion.force_N.size() != base.path.size()) return;
  StiffnessEstimate stiffness;
  if (!force_limited) {
    stiffness = estimate_stiffness(motion, base.path, base.contact, {},
                                   base.shape == PathShape::kCurve ? config.curve_cutoff_cycles_per_mm : 0.0);
  }
  const LikelyCompliance compliance = likely_compliance(
      stiffness.compliance_mm_per_N, stiffness.compliance_stderr_mm_per_N, stiffness.degrees_of_freedom);

  // Weighted by the distance travelled, of which each part is lengthened by its own.
  std::vector<double> indentation_m(motion.force_N.size(), kNan);
  double sum_N = 0.0, sum_m = 0.0, travelled_m = 0.0;
  for (std::size_t i = 1; i < indentation_m.size(); ++i) {
    const double force_N = std::abs(motion.force_N[i]);
    if (base.contact[i] == 0 || !std::isfinite(force_N)) continue;
    indentation_m[i] = std::min(1e-3 * compliance.mean_mm_per_N * force_N, kDeepest_m);
    const double step_m = std::max(0.0, base.path.s_m[i] - base.path.s_m[i - 1]);
    sum_N += step_m * force_N;
    sum_m += step_m * indentation_m[i];
    travelled_m += step_m;
  }
  if (!(travelled_m > 0.0)) return;
  base.indentation_m = sum_m / travelled_m;
  base.indentation_sigma_m = std::min(
      std::hypot(1e-3 * compliance.sigma_mm_per_N * sum_N / travelled_m, kForceLaw * base.indentation_m), kDeepest_m);
  base.tip_s_m = base.path.s_m;
  base.path.s_m = length_on_surface(base.path, base.contact, indentation_m);
  base.length_m = *std::max_element(base.path.s_m.begin(), base.path.s_m.end());
}

}  // namespace asperity
