#include "error_by_draws.h"

#include <cmath>

#include "root_of_power.h"

namespace asperity {

double error_by_draws(double value, const FollowedValue& followed, const NoiseResponse& response, double power_sigma,
                      double scale_sigma, double own_sigma) {
  const double none = response.follows_power ? signed_square(value) : value;
  const double once = followed.once.mean(), twice = followed.twice.mean();
  const double line = 2.0 * none - once, parabola = 3.0 * none - 3.0 * once + twice;
  const double doubt = 0.5 * (response.hangs_on_extremes ? parabola - none : parabola - line);
  const double known = power_sigma * (parabola - none);
  const double spread = followed.once.deviation();
  if (!response.follows_power)
    return std::hypot(std::hypot(spread, doubt), std::hypot(known, parabola - none, own_sigma * value));
  const double scale = 2.0 * scale_sigma * none;
  const Root root = root_of_power(std::abs(none) + (none < 0.0 ? none - parabola : parabola - none),
                                  std::hypot(std::hypot(spread, doubt), std::hypot(known, scale)));
  return std::hypot(root.standard_error, root.value - std::abs(value));
}

}  // namespace asperity
