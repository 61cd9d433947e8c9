#include "asperity/pipeline/path_texture.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "asperity/base/error.h"

namespace asperity {

PathTexture fit_path_texture(const Profile& profile, const PathTextureConfig& config) {
  std::size_t first = 0, last = profile.size();
  while (first < last && !std::isfinite(profile.texture_m[first])) ++first;
  while (last > first && !std::isfinite(profile.texture_m[last - 1])) --last;
  if (last - first < 4) throw Error("path texture: the profile has no heights");
  const std::span<const double> heights(profile.texture_m.data() + first, last - first);
  const double length_mm = static_cast<double>(heights.size()) * profile.spacing_m * 1e3;

  FitFourier1dConfig fit;
  fit.length_mm = length_mm;
  fit.shortest_mm = length_mm;
  fit.max_gap_mm = length_mm;
  fit.seam_mm = std::min(config.seam_mm, 0.1 * length_mm);
  const double most = std::ceil(0.5 * static_cast<double>(heights.size())) - 1.0;
  fit.coefficients = static_cast<int>(std::clamp(std::round(config.harmonics_per_mm * length_mm), 1.0, most));
  PathTexture out;
  out.fit = fit_fourier1d(heights, profile.spacing_m, fit);
  out.start_m = profile.s_m[first];
  out.bridged = static_cast<double>(out.fit.bridged) / static_cast<double>(heights.size());
  return out;
}

}  // namespace asperity
