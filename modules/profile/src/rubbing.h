#pragma once

#include <span>
#include <vector>

#include "asperity/profile/estimate_friction.h"

namespace asperity {

// What each sample says; nan where it says nothing.
struct Rubbing {
  std::vector<double> t_s, angle_rad, slope, speed_mps, along_mps, force_N;
  std::vector<char> touching;  // in contact, with enough force
};

// The samples of a tip that moves along a base path; `contact` has one value a sample.
Rubbing look_at_samples(const TipMotion& motion, const BasePath& path, std::span<const char> contact,
                        const FrictionConfig& config);

// atan2(T, N) less the angle of the slope as a sensor with this time constant follows it; nan where the tip does not
// slide.
std::vector<double> friction_angles(const Rubbing& r, double delay_s, const FrictionConfig& config);

// Times at which the tip is held, between times of sliding: `sticks`, `stuck_share`, `breakaway` and its error.
void find_sticks(const Rubbing& r, const FrictionConfig& config, FrictionEstimate& out);

}  // namespace asperity
