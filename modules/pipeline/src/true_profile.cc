#include "asperity/pipeline/true_profile.h"

#include <array>
#include <cmath>
#include <span>

#include "asperity/base/error.h"
#include "asperity/profile/extract_texture.h"
#include "asperity/profile/resample_over_path.h"

namespace asperity {

Profile true_profile(const Truth& truth, const ProfileConfig& config) {
  const std::array<std::span<const double>, 1> channels{truth.height_m};
  const PathKnots knots = gather_knots(truth.s_m, channels, {}, config.spacing_m / 4.0);
  if (knots.s_m.size() < 8) throw Error("true_profile: the truth has fewer than 8 heights");
  count_points(knots.s_m.back() - knots.s_m.front(), config.spacing_m);
  const auto first = static_cast<std::ptrdiff_t>(std::ceil(knots.s_m.front() / config.spacing_m));
  const auto last = static_cast<std::ptrdiff_t>(std::floor(knots.s_m.back() / config.spacing_m));
  if (last <= first) throw Error("true_profile: the truth does not travel");
  const auto count = static_cast<std::size_t>(last - first + 1);
  Profile profile;
  profile.spacing_m = config.spacing_m;
  profile.s_m.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    profile.s_m.push_back((static_cast<double>(first) + static_cast<double>(i)) * config.spacing_m);
  }
  profile.height_m = resample_smooth(knots, first, count, config.spacing_m, config.max_hole_m);
  profile.texture_m = extract_texture(profile.height_m, config.spacing_m, config.cutoff_cycles_per_mm, config.bridge_m);
  return profile;
}

}  // namespace asperity
