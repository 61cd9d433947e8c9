// An instrument's file (of the corpus: SMD, and one of each other format) is refused with an Error, is none, or reads
// to heights that are written as SDF and read back exactly.
#include <cmath>

#include "asperity/base/error.h"
#include "asperity/surface/format_surface_file.h"
#include "asperity/surface/parse_surface_file.h"
#include "fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::optional<asperity::SurfaceFile> file;
  try {
    file = asperity::parse_surface_file(asperity::fuzz_text(data, size), "fuzz");
  } catch (const asperity::Error&) {
    return 0;
  }
  if (!file) return 0;
  const asperity::ArealMap& map = file->map;
  asperity::must(map.height_m.size() == map.columns * map.rows && map.x_spacing_m > 0.0);
  for (const double height_m : map.height_m) asperity::must(!std::isinf(height_m));
  const auto again = asperity::parse_surface_file(asperity::format_sdf(map, asperity::SdfForm::kText), "again");
  asperity::must(again && again->map.height_m.size() == map.height_m.size());
  for (std::size_t i = 0; i < map.height_m.size(); ++i) {
    const double a = map.height_m[i], b = again->map.height_m[i];
    asperity::must(a == b || (std::isnan(a) && std::isnan(b)));
  }
  return 0;
}
