#include "asperity/profile/setting_class.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

namespace {

// Whole sections of the class's length in the profile; a length that rounding has shortened is whole.
std::size_t whole_sections(const SettingClass& one, std::size_t samples, double spacing_m, ProfileEnds ends) {
  double sections = static_cast<double>(samples) * spacing_m / (1e-3 * one.lambda_c_mm);
  if (ends == ProfileEnds::kCut) sections -= 1.0;  // half of λc at either end
  return static_cast<std::size_t>(std::floor(std::max(0.0, sections) + 1e-6));
}

}  // namespace

RoughnessConfig with_setting_class(const SettingClass& chosen, std::size_t samples, double spacing_m,
                                   RoughnessConfig config) {
  constexpr std::size_t kMost = 1000;
  const std::size_t sections = std::min(kMost, whole_sections(chosen, samples, spacing_m, config.ends));
  if (sections == 0) {
    throw Error("roughness: the profile is " + number_text(1e3 * static_cast<double>(samples) * spacing_m) +
                " mm long; a section of " + std::string(chosen.name) + " is " + number_text(chosen.lambda_c_mm) +
                " mm");
  }
  config.sections = static_cast<int>(sections);
  config.lambda_c_mm = chosen.lambda_c_mm;
  config.lambda_s_mm = 1e-3 * chosen.lambda_s_mm >= 2.0 * spacing_m ? chosen.lambda_s_mm : 0.0;
  return config;
}

const SettingClass& choose_setting_class(std::span<const double> height_m, double spacing_m,
                                         const RoughnessConfig& config) {
  const SettingClass* longest = nullptr;
  for (const SettingClass& one : kSettingClasses) {
    if (whole_sections(one, height_m.size(), spacing_m, config.ends) == 0) break;
    longest = &one;
    const double Ra_m =
        measure_roughness(height_m, spacing_m, with_setting_class(one, height_m.size(), spacing_m, config)).Ra_m;
    if (Ra_m <= one.most_Ra_m) return one;
  }
  if (longest != nullptr) return *longest;
  with_setting_class(kSettingClasses.front(), height_m.size(), spacing_m, config);  // refuses: not one section
  return kSettingClasses.front();
}

}  // namespace asperity
