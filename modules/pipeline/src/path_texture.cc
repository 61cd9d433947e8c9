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

// Moves a series along by `shift_m`: g(x) becomes g(x − shift).
void shift_phase(Fourier1d& texture, double shift_m) {
  const double phase = texture.omega_rad_per_mm() * shift_m * 1e3;
  for (std::size_t j = 0; j < texture.a_m.size(); ++j) {
    const double angle = static_cast<double>(j + 1) * phase, c = std::cos(angle), s = std::sin(angle);
    const double a = texture.a_m[j], b = texture.b_m[j];
    texture.a_m[j] = c * a - s * b;
    texture.b_m[j] = s * a + c * b;
  }
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
  PathTexture out{fit_fourier1d_path(heights, profile.spacing_m, config), profile.s_m[first]};
  shift_phase(out.series.fit.texture, out.start_m);
  return out;
}

}  // namespace asperity
