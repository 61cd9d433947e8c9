#pragma once

#include <array>
#include <string_view>

namespace asperity {

enum class ContactMaterial { kStiff, kCork, kSoftRubber };
inline constexpr std::array<std::string_view, 3> kContactMaterialNames = {"stiff", "cork", "soft_rubber"};

// The contact between tip and object. Sources of the values: docs/virtual-bench.md.
struct SimulatedContactConfig {
  double tip_radius_m = 0.32e-3;     // thesis §3.1: diameter 0.64 mm near the tip
  double stiffness_N_per_m = 2.0e5;  // Hertz, E* = 2 GPa, linearised at 1 N
  double damping_ratio = 0.15;       // of the hand's mass on this stiffness
  double friction_static = 0.22;
  double friction_dynamic = 0.18;
  double friction_stribeck_mps = 5e-3;    // speed at which static friction has fallen by e
  double friction_bristle_per_m = 3.0e4;  // LuGre: friction coefficient per presliding displacement
  double friction_bristle_damping_s_per_m = 5.0;
  double friction_viscous_s_per_m = 0.2;  // coefficient gained per speed

  template <class V>
  void visit(V& v) {
    v.field("tip_radius_m", tip_radius_m, "radius of the probe's tip, m", {0.0, 0.01});
    v.field("stiffness_N_per_m", stiffness_N_per_m, "contact stiffness, N/m", {10.0, 5e6});
    v.field("damping_ratio", damping_ratio, "contact damping relative to critical", {0.0, 2.0});
    v.field("friction_static", friction_static, "coefficient of static friction", {0.0, 5.0});
    v.field("friction_dynamic", friction_dynamic, "coefficient of dynamic friction", {0.0, 5.0});
    v.field("friction_stribeck_mps", friction_stribeck_mps, "Stribeck speed, m/s", {1e-6, 10.0});
    v.field("friction_bristle_per_m", friction_bristle_per_m, "LuGre bristle stiffness per newton, 1/m", {1.0, 1e6});
    v.field("friction_bristle_damping_s_per_m", friction_bristle_damping_s_per_m,
            "LuGre bristle damping per newton, s/m", {0.0, 1e3});
    v.field("friction_viscous_s_per_m", friction_viscous_s_per_m, "viscous friction per newton, s/m", {0.0, 1e3});
  }
};

// The defaults of a material.
SimulatedContactConfig make_contact(ContactMaterial material);

}  // namespace asperity
