#include "asperity/pipeline/path_texture.h"

#include <cmath>
#include <span>

#include "asperity/base/error.h"

namespace asperity {

PathTexture fit_path_texture(const Profile& profile, const FitFourier1dPathConfig& config) {
  std::size_t first = 0, last = profile.size();
  while (first < last && !std::isfinite(profile.texture_m[first])) ++first;
  while (last > first && !std::isfinite(profile.texture_m[last - 1])) --last;
  if (last - first < 4) throw Error("path texture: the profile has no heights");
  const std::span<const double> heights(profile.texture_m.data() + first, last - first);
  return {fit_fourier1d_path(heights, profile.spacing_m, config), profile.s_m[first]};
}

}  // namespace asperity
