#pragma once

#include <vector>

#include "second_scan.h"

namespace second_bench {

inline constexpr double kStep_s = 25e-6;

// The probe in the hand at each step of the integration, from time 0 on.
struct HandMotion {
  std::vector<double> s_m;                     // arc length of the ball's foot along the base
  std::vector<double> height_m;                // of the ball's lowest point over the base
  std::vector<double> normal_N;                // contact force along the local normal of what the ball stands on
  std::vector<Eigen::Vector3d> p_world_tip_m;  // the body's point that is the ball's lowest one at the mean attitude
  std::vector<Eigen::Quaterniond> q_world_marker;
  std::vector<Eigen::Vector3d> contact_world_N;  // on the tip

  std::size_t size() const { return s_m.size(); }
};

// Two masses, the probe and the hand, joined by the grip's spring and damper, along the normal and along the path; the
// ball on the relief by Hunt and Crossley's or Kelvin and Voigt's contact along the local normal, Coulomb friction
// along the local tangent (docs/second-bench.md).
HandMotion move_hand(const ScanPlan& plan);

}  // namespace second_bench
