#include "pantograph.h"

#include <cmath>

namespace asperity {

namespace {

constexpr double kLeastSine = 0.05;  // of the angle between the distal arms

}  // namespace

std::optional<PantographState> pantograph_state(const PantographConfig& config,
                                                const Eigen::Vector2d& theta_rad) noexcept {
  if (!theta_rad.allFinite()) return std::nullopt;
  const double l = config.proximal_m, L = config.distal_m;
  const Eigen::Vector2d along1(std::cos(theta_rad.x()), std::sin(theta_rad.x()));
  const Eigen::Vector2d along2(std::cos(theta_rad.y()), std::sin(theta_rad.y()));
  const Eigen::Vector2d a = l * along1, b = Eigen::Vector2d(config.base_m, 0.0) + l * along2;
  const Eigen::Vector2d between = b - a;
  const double rest = L * L - 0.25 * between.squaredNorm();
  const double distance = between.norm();
  if (!(rest > 0.0) || !(distance > 0.0)) return std::nullopt;
  PantographState state;
  state.p_m = 0.5 * (a + b) + std::sqrt(rest) / distance * Eigen::Vector2d(-between.y(), between.x());
  const Eigen::Vector2d from_a = state.p_m - a, from_b = state.p_m - b;
  const double cross = from_a.x() * from_b.y() - from_a.y() * from_b.x();
  if (std::abs(cross) < kLeastSine * L * L) return std::nullopt;
  const double turned1 = l * (-from_a.x() * along1.y() + from_a.y() * along1.x());
  const double turned2 = l * (-from_b.x() * along2.y() + from_b.y() * along2.x());
  state.jacobian_m << from_b.y() * turned1, -from_a.y() * turned2, -from_b.x() * turned1, from_a.x() * turned2;
  state.jacobian_m /= cross;
  return state;
}

}  // namespace asperity
