// A file of heights is refused with an Error, or its roughness is measured or refused with one.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "asperity/base/error.h"
#include "asperity/profile/measure_areal_texture.h"
#include "asperity/profile/measure_profile_texture.h"
#include "asperity/profile/measure_roughness.h"
#include "asperity/profile/read_heights.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  for (const double spacing_m : {0.0, 1e-6}) {
    try {
      const auto heights = asperity::parse_heights(text, "fuzz", {.spacing_m = spacing_m});
      if (const auto* map = std::get_if<asperity::ArealMap>(&heights)) {
        if (map->height_m.size() != map->columns * map->rows) std::abort();
        asperity::measure_areal_texture(*map);
        asperity::measure_areal_texture(*map, {.form = asperity::ArealForm::kQuadric, .lambda_c_mm = 0.08});
      } else {
        const auto& profile = std::get<asperity::HeightProfile>(heights);
        asperity::measure_roughness(profile.height_m, profile.spacing_m);
        asperity::measure_profile_texture(profile.height_m, profile.spacing_m);
      }
    } catch (const asperity::Error&) {
    }
  }
  return 0;
}
