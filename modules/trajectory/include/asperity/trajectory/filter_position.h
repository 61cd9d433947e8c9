#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

namespace asperity {

// The thesis's constant matrices, an axis an entry (thesis §4.2). Diagonals are variances (erratum 8).
struct PositionFilterNoise {
  Eigen::Vector3d process_position_m2 = Eigen::Vector3d::Zero();     // Q, upper half, added at each sample
  Eigen::Vector3d process_velocity_m2ps2 = Eigen::Vector3d::Zero();  // Q, lower half, added at each sample
  Eigen::Vector3d process_cross_m2ps = Eigen::Vector3d::Zero();      // Q between them; zero in the thesis's
  Eigen::Vector3d measurement_m2 = Eigen::Vector3d::Ones();          // R
  Eigen::Vector3d initial_velocity_m2ps2 = Eigen::Vector3d::Ones();  // of the first state, whose velocity is zero
};

struct FilteredPosition {
  std::vector<Eigen::Vector3d> p_m;
  std::vector<Eigen::Vector3d> v_mps;
};

// The thesis's linear Kalman filter with the state [p ṗ], F = [1 Δt; 0 1], H = [1 0] (thesis §4.2, A.3):
// forward only (erratum 10). `measured_m` is a sample every `period_s`. F, Q and R couple no axes, so
// each is filtered by itself, exactly. Throws Error unless the period and R are positive.
FilteredPosition filter_position(std::span<const Eigen::Vector3d> measured_m, double period_s,
                                 const PositionFilterNoise& noise);

}  // namespace asperity
