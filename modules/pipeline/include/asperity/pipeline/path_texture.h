#pragma once

#include "asperity/base/config.h"
#include "asperity/profile/profile.h"
#include "asperity/texture/fit_fourier1d.h"

namespace asperity {

struct PathTextureConfig {
  double harmonics_per_mm = 12.8;
  double seam_mm = 0.5;

  template <class V>
  void visit(V& v) {
    v.field("harmonics_per_mm", harmonics_per_mm, "of the texture along a whole scan (seed §6.5: 128 over 10 mm)",
            {0.1, 100.0});
    v.field("seam_mm", seam_mm, "length over which its end is blended into its start; 0: not", {0.0, 1e3});
  }
};

// A scan's whole profile as one texture, for the mesh that the scan was registered to.
struct PathTexture {
  FourierFit fit;
  double start_m = 0.0;  // arc length at which the texture has x = 0
  double bridged = 0.0;  // part of its length that is gaps, bridged by straight lines
};

// The Fourier series of `texture_m` from its first to its last height: where a texture of 10 mm repeats what was
// measured in one place (seed §6.5), this one has at each place of the path what was measured there.
// Throws Error as fit_fourier1d does, and for more harmonics than a texture file holds.
PathTexture fit_path_texture(const Profile& profile, const PathTextureConfig& config);

}  // namespace asperity
