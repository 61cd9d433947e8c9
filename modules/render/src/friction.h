#pragma once

#include <Eigen/Core>

namespace asperity {

// Stick and slip of a proxy, after Salcudean and Vlaar 1997 and Harwin and Melder 2002: the hand pulls the proxy along
// the surface by the stiffness times the way that it lags behind.
struct Friction {
  double load_N = 0.0;    // with which the surfaces are pressed, their texture included
  double sliding = 0.0;   // coefficient
  double sticking = 0.0;  // coefficient, not below that of sliding
  double stiffness_N_per_m = 0.0;
};

// Whether the proxy sticks on, or begins to, where it lags by `lag_m`: up to the coefficient of sticking if it did
// before, of sliding if it slid. It does not where nothing is pressed.
bool sticks(const Friction& friction, bool stuck, const Eigen::Vector3d& lag_m) noexcept;

// The lag that sliding friction bears: lag_m shortened to sliding * load / stiffness. A slide that bears all of it has
// ended: see sticks().
Eigen::Vector3d sliding_lag_m(const Friction& friction, const Eigen::Vector3d& lag_m) noexcept;

// The force on the hand along the lag: the stiffness times the lag while it sticks, and sliding * load
// while it slides. `load_before_N`: for which the lag was made. The load may have changed with the texture since;
// the force follows at once, the lag in the next step. No lag, no force: it has no direction.
Eigen::Vector3d friction_force_N(const Friction& friction, bool stuck, const Eigen::Vector3d& lag_m,
                                 double load_before_N) noexcept;

}  // namespace asperity
