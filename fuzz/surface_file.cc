// A file of a surface instrument is refused with an Error, or reads to a map of finite heights and gaps that GSF and
// SDF hold again.
#include <algorithm>
#include <cmath>
#include <optional>

#include "asperity/base/error.h"
#include "asperity/surface/format_surface_file.h"
#include "asperity/surface/parse_surface_file.h"
#include "fuzz_input.h"

using namespace asperity;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kMostHeights = 1 << 16;  // what is larger takes the time of many inputs
  std::optional<SurfaceFile> file;
  try {
    file = parse_surface_file(fuzz_text(data, size), "in");
  } catch (const Error& error) {
    must(std::string_view(error.what()).starts_with("in:"));
  }
  if (!file) return 0;
  const ArealMap& map = file->map;
  must(map.columns >= 1 && map.rows >= 1 && map.height_m.size() == map.columns * map.rows);
  must(map.x_spacing_m > 0.0 && (file->is_profile() || map.y_spacing_m > 0.0));
  for (const double height_m : map.height_m) must(std::isnan(height_m) || std::abs(height_m) <= 10.0);
  if (map.height_m.size() > kMostHeights) return 0;
  format_gsf(map);
  const std::optional<SurfaceFile> again = parse_surface_file(format_sdf(map, SdfForm::kText), "again");
  must(again && again->map.columns == map.columns && again->map.rows == map.rows);
  must(std::equal(map.height_m.begin(), map.height_m.end(), again->map.height_m.begin(),
                  [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }));
  return 0;
}
