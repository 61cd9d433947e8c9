#pragma once

#include <array>

namespace asperity {

// A hand that holds a stylus, as seen from the tip: masses on springs and dampers whose other ends follow the hand's
// intention. Along the press direction the hand yields to the surface, as a hand that regulates a force does; across
// it, it insists on its path. Defaults and their sources are those of the virtual bench (docs/virtual-bench.md):
// fingers have 200–800 N/m and 2–6 N s/m (Hajian and Howe, 1997).
struct HandModelConfig {
  std::array<double, 3> press_direction{0.0, -1.0, 0.0};  // device axes; of any length but zero
  double press_mass_kg = 0.04;
  double press_stiffness_N_per_m = 300.0;
  double press_damping_N_s_per_m = 4.0;
  double press_adaptation_s = 0.25;  // in which the spring's other end follows the tip; 0: it never does
  double reach_m = 0.02;             // how far from the path it follows at most
  double across_mass_kg = 0.08;
  double across_stiffness_N_per_m = 2500.0;
  double across_damping_N_s_per_m = 15.0;

  template <class V>
  void visit(V& v) {
    v.field("press_direction", press_direction, "in which the hand presses, device axes; of any length but zero",
            {-1e6, 1e6});
    v.field("press_mass_kg", press_mass_kg, "mass at the tip along the press direction, kg", {1e-3, 10.0});
    v.field("press_stiffness_N_per_m", press_stiffness_N_per_m, "the hand's stiffness along it, N/m", {0.0, 1e5});
    v.field("press_damping_N_s_per_m", press_damping_N_s_per_m, "the hand's damping along it, N s/m", {0.0, 1e4});
    v.field("press_adaptation_s", press_adaptation_s,
            "time in which the hand yields to the height it meets, s; 0: never", {0.0, 100.0});
    v.field("reach_m", reach_m, "how far from its path the hand yields at most, m", {0.0, 1.0});
    v.field("across_mass_kg", across_mass_kg, "mass at the tip across the press direction, kg", {1e-3, 10.0});
    v.field("across_stiffness_N_per_m", across_stiffness_N_per_m, "the hand's stiffness across it, N/m", {0.0, 1e5});
    v.field("across_damping_N_s_per_m", across_damping_N_s_per_m, "the hand's damping across it, N s/m", {0.0, 1e4});
  }
};

}  // namespace asperity
