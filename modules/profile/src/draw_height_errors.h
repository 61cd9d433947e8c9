#pragma once

#include <span>
#include <vector>

#include "asperity/profile/estimate_texture_noise.h"

namespace asperity {

// Errors of a profile, drawn: one vector a draw, one number a point; 0 where the profile has no height.
struct DrawnErrors {
  std::vector<std::vector<double>> height_m;     // of heights, less what the base takes (HeightErrors::base_degree)
  std::vector<std::vector<double>> added_m;      // the same through the texture's high-pass
  std::vector<std::vector<double>> misplaced_m;  // of a texture whose heights are at a wrong place
  double shape_variance_m2 = 0.0;                // of the place along the path, a shift of all not counted
};

// Noise with the density of height_error_density.h over time is read where and when the tip passed each point, so that
// what it drifts over a rest is a step, and what it does at a slow end is stretched. Along the path the same with the
// errors along it. `surface_m` is the texture that is misplaced. The same profile gives the same draws.
DrawnErrors draw_height_errors(const Profile& profile, const HeightErrors& errors, double cutoff_cycles_per_mm,
                               const TextureNoiseConfig& config, std::span<const double> surface_m);

}  // namespace asperity
