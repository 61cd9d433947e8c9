#include "refine_settings.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace asperity::registration {

RefineConfig with_few_knots(std::span<const MeasuredPath> paths, RefineConfig config, Problems& problems) {
  constexpr double kMostKnots = 500;  // a path: time goes with them
  double longest_m = 0.0;
  for (const MeasuredPath& path : paths) {
    double length_m = 0.0;
    for (std::size_t i = 1; i < path.p_world_m.size(); ++i) {
      const double step_m = (path.p_world_m[i] - path.p_world_m[i - 1]).norm();
      if (std::isfinite(step_m)) length_m += step_m;
    }
    longest_m = std::max(longest_m, length_m);
  }
  if (longest_m <= kMostKnots * config.knot_m) return config;
  config.knot_m = longest_m / kMostKnots;
  problems.push_back(
      {"wide_knots",
       fmt::format("a path is {:.3g} m long: its drift is interpolated over {:.3g} mm", longest_m, 1e3 * config.knot_m),
       1});
  return config;
}

std::vector<Whitening> learn_whitenings(const PathChain& chain, const FacetHeights& heights,
                                        const RefineConfig& config) {
  const auto points_over = [&](double length_m) {
    return static_cast<std::size_t>(std::clamp(std::round(length_m / chain.spacing_m), 1.0,
                                               std::max(1.0, static_cast<double>(heights.count) / 10.0)));
  };
  return make_whitenings(chain, heights, points_over(config.memory_m), points_over(config.slow_length_m / 8.0));
}

std::vector<UndeterminedMotion> held_motions(const RegistrationResult& start) {
  constexpr double kKnown_m = 5e-3;  // a motion known to this is left free: guesses are no better
  std::vector<UndeterminedMotion> out;
  for (const UndeterminedMotion& motion : start.undetermined) {
    if (!(motion.sigma_m < kKnown_m)) out.push_back(motion);
  }
  return out;
}

Matrix6 held_covariance(std::span<const UndeterminedMotion> held, double guess_sigma_m) {
  Matrix6 out = Matrix6::Zero();
  for (const UndeterminedMotion& motion : held) {
    Vector6 direction;
    direction << motion.rotation_rad, motion.shift_m;
    const double sigma_m = std::min(motion.sigma_m, guess_sigma_m);
    out += sigma_m * sigma_m * direction * direction.transpose();
  }
  return out;
}

}  // namespace asperity::registration
