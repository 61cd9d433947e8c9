#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "asperity/profile/profile.h"
#include "asperity/profile/texture_noise.h"

namespace asperity {

// As the profile was made (make_profile.h).
struct TextureNoiseConfig {
  double bridge_m = 2e-3;   // gap across which the high-pass goes on
  double max_stop_s = 1.0;  // a longer rest parts the profile
  std::size_t draws = 24;   // of errors; fewer of a long profile, whose noise varies little between draws
};

struct TextureNoiseEstimate {
  TextureNoise noise;
  std::vector<double> texture_sigma_m;  // of texture_m, one a point; nan in gaps
  // Of height_m less its straight line, one a point; empty where the noises are not known. An error that all heights
  // share, or that grows evenly along them, is the base's: it is fitted to the same path.
  std::vector<double> height_sigma_m;
};

// The error that is expected in `profile.texture_m`, as a spectrum, in all and point by point (docs/texture-noise.md).
//
// Added noise: errors with the density over time of height_error_density.h are drawn, read when the tip passed each
// point and taken through the texture's high-pass (`cutoff_cycles_per_mm`, extract_texture.h). Their mean square is the
// noise's power; its spectrum is v S(k v) for waves of k cycles/mm at the speed v, with that power. Misplaced heights:
// the same along the path moves the measured texture, less its noise, to and fro. A texture that is moved as a whole is
// not wrong.
//
// The standard error of the power has two parts: how well a tracker over that time can tell A (its Fisher information,
// 0.833 T f_c), and the chance of one stretch, the spread of the draws' powers. Without noises (0) nothing is
// determined.
TextureNoiseEstimate estimate_texture_noise(const Profile& profile, const HeightErrors& errors,
                                            double cutoff_cycles_per_mm, const TextureNoiseConfig& config = {});

// The noise of a texture of which only `texture_sigma_m` is known: integrated white acceleration, k⁻⁴ from the
// high-pass' cut-off on, with the mean square of the sigmas as its power, known to a quarter. Nothing without a
// positive sigma.
TextureNoise noise_of_sigma(std::span<const double> texture_m, std::span<const double> texture_sigma_m,
                            double spacing_m, double cutoff_cycles_per_mm);

// The power gain of the profile's high-pass at a frequency; 1 without a cut-off.
double texture_power_gain(double cycles_per_mm, double cutoff_cycles_per_mm);

}  // namespace asperity
