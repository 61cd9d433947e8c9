#pragma once

#include <span>
#include <vector>

#include "asperity/profile/profile.h"
#include "asperity/profile/texture_noise.h"

namespace asperity {

struct TextureNoiseEstimate {
  TextureNoise noise;
  std::vector<double> texture_sigma_m;  // of texture_m, one a point; nan in gaps
  // Of height_m less its straight line, one a point; empty where the noises are not known. An error that all heights
  // share, or that grows evenly along them, is the base's: it is fitted to the same path.
  std::vector<double> height_sigma_m;
};

// The error that is expected in `profile.texture_m`, as a spectrum, in all and point by point (docs/texture-noise.md).
//
// Added noise: the motion's height is the tracker's at low and the twice integrated acceleration at high time
// frequencies, put together by their noises A and R (`errors`, one-sided): its error has the density
// A R/(A + R (2πf)⁴). The tip passes waves of k cycles/mm at f = k v, so over the path it is v times that, through the
// texture's high-pass (`cutoff_cycles_per_mm`, extract_texture.h). Misplaced heights: along the path the same two
// noises leave a standard deviation σ, σ² = R f_c π/(2√2), f_c where A = R (2πf_c)⁴; waves of k are then wrong by 2 (1
// − exp(−(2πkσ)²/2)) of their power. A texture that is moved as a whole is not wrong: what is slower than half a period
// over the whole time does not count.
//
// The standard error of the power has two parts: how well a tracker over that time can tell A (its Fisher information,
// 0.833 T f_c), and the chance of one stretch (∫S²/(L (∫S)²)). Without noises (0) nothing is determined.
TextureNoiseEstimate estimate_texture_noise(const Profile& profile, const HeightErrors& errors,
                                            double cutoff_cycles_per_mm);

// The noise of a texture of which only `texture_sigma_m` is known: integrated white acceleration, k⁻⁴ from the
// high-pass' cut-off on, with the mean square of the sigmas as its power, known to a quarter. Nothing without a
// positive sigma.
TextureNoise noise_of_sigma(std::span<const double> texture_m, std::span<const double> texture_sigma_m,
                            double spacing_m, double cutoff_cycles_per_mm);

// The power gain of the profile's high-pass at a frequency; 1 without a cut-off.
double texture_power_gain(double cycles_per_mm, double cutoff_cycles_per_mm);

}  // namespace asperity
