#include "profile_block.h"

#include <string_view>
#include <vector>

#include "thinned.h"

namespace asperity::studio {

void add_spectrum(const SurfaceSpectrum& spectrum, BlockWriter& block) {
  block.head()["spectrum"] = {{"segments", spectrum.segments}};
  block.add("spectrum_cycles_per_mm", spectrum.frequency_cycles_per_mm);
  block.add("spectrum_density_m2_mm", spectrum.density_m2_mm);
  block.add("spectrum_low_m2_mm", spectrum.low_m2_mm);
  block.add("spectrum_high_m2_mm", spectrum.high_m2_mm);
}

void add_profile(const Profile& profile, std::size_t max_points, BlockWriter& block) {
  const Chosen chosen = choose_samples(profile.size(), max_points);
  block.head()["profile"] = {{"samples", profile.size()},
                             {"every", chosen.every},
                             {"points", chosen.index.size()},
                             {"first_m", profile.size() > 0 ? profile.s_m[0] : 0.0},
                             {"spacing_m", profile.spacing_m * static_cast<double>(chosen.every)}};
  const auto add = [&](std::string_view name, const std::vector<double>& values) {
    block.add(name, gather_values(chosen, [&](std::size_t i) { return values.at(i); }));
  };
  add("profile_height_m", profile.height_m);
  add("profile_sigma_m", profile.sigma_m);
  add("profile_texture_m", profile.texture_m);
  add("profile_force_N", profile.force_N);
  add("profile_speed_mps", profile.speed_mps);
}

}  // namespace asperity::studio
