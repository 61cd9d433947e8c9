#pragma once

#include <array>
#include <span>
#include <string_view>

#include "asperity/profile/measure_roughness.h"

namespace asperity {

// A class of settings for profile roughness, Sc1 to Sc5: cut-offs, section length, largest spacing of the heights, and
// the surfaces that it is for. The figures are those of ISO 4288:1996 (table 1) and ISO 3274:1996 (table 1); that
// ISO 21920-3:2021 keeps them is from open literature, its own table was not read.
struct SettingClass {
  std::string_view name;
  double lambda_c_mm = 0.0;
  double lambda_s_mm = 0.0;
  double most_spacing_m = 0.0;
  double most_Ra_m = 0.0;   // for surfaces of Ra up to this, and above that of the class before
  double most_RSm_m = 0.0;  // the same for periodic surfaces
};

inline constexpr std::array<SettingClass, 5> kSettingClasses{{
    {"Sc1", 0.08, 0.0025, 0.5e-6, 0.02e-6, 0.04e-3},
    {"Sc2", 0.25, 0.0025, 0.5e-6, 0.1e-6, 0.13e-3},
    {"Sc3", 0.8, 0.0025, 0.5e-6, 2e-6, 0.4e-3},
    {"Sc4", 2.5, 0.008, 1.5e-6, 10e-6, 1.3e-3},
    {"Sc5", 8.0, 0.025, 5e-6, 80e-6, 4e-3},
}};

// `config` with the cut-offs of a class and sections of its length: as many whole ones as the profile has (five are the
// standard's; more are a longer evaluation length).
// λs is left out where it is below two spacings: the heights do not resolve it. Throws Error if the profile is shorter
// than one section.
RoughnessConfig with_setting_class(const SettingClass& chosen, std::size_t samples, double spacing_m,
                                   RoughnessConfig config = {});

// The class for a profile that nothing is known of: that whose range of Ra holds the Ra which it measures itself, from
// the finest class on (ISO 4288:1996, 7.2.1). The coarsest that the profile is long enough for, if there is none.
// Throws Error if it is shorter than one section of Sc1, and as measure_roughness() does.
const SettingClass& choose_setting_class(std::span<const double> height_m, double spacing_m,
                                         const RoughnessConfig& config = {});

}  // namespace asperity
