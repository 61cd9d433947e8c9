#pragma once

namespace asperity {

// How a place of a surface yields and rubs, all known.
struct RenderMaterial {
  double stiffness_N_per_m = 0.0;
  double compliance_kc = 1.0;
  double friction = 0.0;               // coefficient of sliding
  double static_friction_ratio = 1.2;  // coefficient of sticking over it
};

// (1 - part) a + part b: exactly a at 0 and b at 1.
inline RenderMaterial between(const RenderMaterial& a, const RenderMaterial& b, double part) noexcept {
  const double rest = 1.0 - part;
  return {rest * a.stiffness_N_per_m + part * b.stiffness_N_per_m, rest * a.compliance_kc + part * b.compliance_kc,
          rest * a.friction + part * b.friction, rest * a.static_friction_ratio + part * b.static_friction_ratio};
}

}  // namespace asperity
