#include "asperity/pipeline/path_texture.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "asperity/base/error.h"

namespace asperity {

namespace {

constexpr double kMoving = 0.25;  // of the usual speed

double usual_speed_mps(const Profile& profile) {
  std::vector<double> speeds_mps;
  for (const double speed : profile.speed_mps) {
    if (std::isfinite(speed)) speeds_mps.push_back(speed);
  }
  if (speeds_mps.empty()) return 0.0;
  const auto middle = speeds_mps.begin() + static_cast<std::ptrdiff_t>(speeds_mps.size() / 2);
  std::nth_element(speeds_mps.begin(), middle, speeds_mps.end());
  return *middle;
}

}  // namespace

PathTexture fit_path_texture(const Profile& profile, const FitFourier1dPathConfig& config) {
  const double usual_mps = usual_speed_mps(profile);
  const auto stroked = [&](std::size_t i) {
    return std::isfinite(profile.texture_m[i]) && profile.speed_mps[i] >= kMoving * usual_mps;
  };
  std::size_t first = 0, last = profile.size();
  while (first < last && !stroked(first)) ++first;
  while (last > first && !stroked(last - 1)) --last;
  if (last - first < 4) throw Error("path texture: the profile has no heights");
  const std::span<const double> heights(profile.texture_m.data() + first, last - first);
  return {fit_fourier1d_path(heights, profile.spacing_m, config), profile.s_m[first]};
}

}  // namespace asperity
