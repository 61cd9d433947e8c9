#pragma once

#include <optional>

#include <Eigen/Core>

namespace asperity {

// A five-bar linkage in a plane: motor 1 at the origin, motor 2 at (d, 0), arms l to the elbows, arms L from there to
// the tip on the side of +y. Angles from +x, counter-clockwise.
struct PantographConfig {
  double proximal_m = 0.05;  // l
  double distal_m = 0.07;    // L
  double base_m = 0.02;      // d
};

// Where the tip is and J = ∂p/∂θ, by which τ = Jᵀ f.
struct PantographState {
  Eigen::Vector2d p_m = Eigen::Vector2d::Zero();
  Eigen::Matrix2d jacobian_m = Eigen::Matrix2d::Zero();  // m per radian
};

// With elbows A = l (cos θ1, sin θ1) and B = (d, 0) + l (cos θ2, sin θ2) the tip is at (A + B)/2 plus what Pythagoras
// leaves of L, square to B − A. |p − A| = |p − B| = L differentiated: rows (p − A)ᵀ and (p − B)ᵀ times ṗ are
// (p − A)·A′ θ̇1 and (p − B)·B′ θ̇2. None if the angles are not finite, the elbows are too far apart, or the distal
// arms are within 3° of one line, where the motors do not hold the tip. Realtime-safe: yes.
std::optional<PantographState> pantograph_state(const PantographConfig& config,
                                                const Eigen::Vector2d& theta_rad) noexcept;

}  // namespace asperity
