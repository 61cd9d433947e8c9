#pragma once

#include <span>
#include <vector>

#include "asperity/geometry/motion.h"
#include "asperity/profile/base_path.h"

namespace asperity {

// How far the surface under the tip is above the tip along the normal, less what is constant or slow, m, one value a
// sample of `motion`; 0 where `contact` is (empty: everywhere 1). The probe's mass on the contact's spring: with the
// resonance f₀ of the contact, δ = n·a / (2πf₀)² (docs/profile-surface.md), of accelerations below f₀/2:
// above, the damping and not this sum decides. Throws Error if sizes differ or f₀ is not positive and below a fifth of
// the sampling rate.
std::vector<double> surface_above_tip_m(const TipMotion& motion, const BasePath& base, std::span<const char> contact,
                                        double contact_resonance_Hz);

}  // namespace asperity
