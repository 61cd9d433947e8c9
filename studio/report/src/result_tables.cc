#include "result_tables.h"

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/json/parse_json.h"

namespace asperity::studio {

namespace {

constexpr std::size_t kDeepestResult = 32;

}  // namespace

Json parse_result(std::string_view text, const std::string& name) {
  JsonLimits limits;
  limits.bytes = kLargestResult_bytes;
  limits.depth = kDeepestResult;
  Json out = parse_json(text, name, limits);
  const Json* format = out.find("format");
  if (format == nullptr || *format != "asperity-result") throw Error(name + ": is not a result of asperity process");
  const Json* version = out.find("version");
  if (version == nullptr || *version != 1) {
    throw Error(name + ": has the version " + (version == nullptr ? "null" : shown(*version)) +
                "; this program reads version 1");
  }
  return out;
}

Profile parse_profile(std::string_view text, const std::string& name) {
  CsvReader csv(text, name);
  csv.accept_unterminated();
  Profile out;
  struct Column {
    std::optional<std::size_t> place;
    std::vector<double>& values;
  };
  const std::array<Column, 7> columns{{{csv.require("s_m"), out.s_m},
                                       {csv.require("height_m"), out.height_m},
                                       {csv.find("sigma_m"), out.sigma_m},
                                       {csv.find("texture_m"), out.texture_m},
                                       {csv.find("force_N"), out.force_N},
                                       {csv.find("speed_mps"), out.speed_mps},
                                       {csv.find("texture_sigma_m"), out.texture_sigma_m}}};
  while (csv.next()) {
    for (const Column& column : columns) {
      const double value = column.place ? csv.number(*column.place) : std::numeric_limits<double>::quiet_NaN();
      if (std::isinf(value)) csv.fail(*column.place, "is not finite");
      column.values.push_back(value);
    }
  }
  out.spacing_m = out.size() < 2 ? 0.0 : (out.s_m.back() - out.s_m.front()) / static_cast<double>(out.size() - 1);
  if (out.size() > 1 && !(out.spacing_m > 0.0)) throw Error(name + ": s_m does not rise");
  return out;
}

SurfaceSpectrum parse_spectrum(std::string_view text, const std::string& name) {
  CsvReader csv(text, name);
  csv.accept_unterminated();
  SurfaceSpectrum out;
  const std::size_t frequency = csv.require("cycles_per_mm"), density = csv.require("density_m2_mm"),
                    low = csv.require("low_m2_mm"), high = csv.require("high_m2_mm");
  const std::optional<std::size_t> noise = csv.find("noise_m2_mm");
  while (csv.next()) {
    out.frequency_cycles_per_mm.push_back(csv.number(frequency));
    out.density_m2_mm.push_back(csv.number(density));
    out.low_m2_mm.push_back(csv.number(low));
    out.high_m2_mm.push_back(csv.number(high));
    out.noise_m2_mm.push_back(noise ? csv.number(*noise) : std::numeric_limits<double>::quiet_NaN());
    for (const auto& [place, value] :
         {std::pair{frequency, out.frequency_cycles_per_mm.back()}, std::pair{density, out.density_m2_mm.back()}}) {
      if (!std::isfinite(value)) csv.fail(place, "is not finite");
    }
  }
  return out;
}

}  // namespace asperity::studio
