#pragma once

#include "asperity/profile/profile.h"
#include "asperity/texture/fit_fourier1d_samples.h"

namespace asperity {

// A scan's whole profile as one texture, for the mesh that the scan was registered to.
struct PathTexture {
  FourierPathFit series;
  double start_m = 0.0;  // arc length at which the stroke begins
};

// The Fourier series of `texture_m` from where the stroke begins to where it ends (a quarter of its median speed; a
// rest before it wanders over its place with the tracker's error): where a texture of 10 mm repeats what was measured
// in one place (seed §6.5), this one has at each place of the path what was measured there, x being the profile's s_m.
// Throws Error as fit_fourier1d_path does.
PathTexture fit_path_texture(const Profile& profile, const FitFourier1dPathConfig& config);

}  // namespace asperity
