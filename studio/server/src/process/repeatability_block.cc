#include "process/repeatability_block.h"

#include <cmath>

namespace asperity::studio {

namespace {

std::vector<float> floats(const std::vector<double>& values) { return {values.begin(), values.end()}; }

Json metric_json(const char* key, const char* label, double value, const char* unit, double deviation) {
  Json out{{"group", "Repeatability"}, {"key", key}, {"label", label}};
  out["value"] = number_or_null(value);
  if (std::isfinite(deviation)) out["error"] = deviation;
  out["unit"] = unit;
  return out;
}

}  // namespace

BlockWriter repeatability_block(const Repeatability& r, const std::vector<RepeatedScan>& scans,
                                const std::vector<std::string>& names, const ComparisonConfig& config) {
  BlockWriter block("repeatability");
  Json list = Json::array();
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const ProfileComparison& with_first = r.with_first[i];
    const Periodicity& pattern = scans[i].periodicity;
    list.push_back({{"name", names.at(i)},
                    {"correlation", with_first.correlation},
                    {"rms_um", with_first.rms_um},
                    {"gain", with_first.gain},
                    {"shift_m", with_first.shift_m},
                    {"compared_m", with_first.compared_m},
                    {"pitch_m", pattern.periodic ? Json(pattern.pitch_m) : Json()},
                    {"depth_m", pattern.periodic ? Json(pattern.depth_m) : Json()}});
  }
  block.head()["scans"] = std::move(list);
  block.head()["figures"] = {
      metric_json("correlation", "Correlation with the first, mean ± sd", r.correlation.mean, "",
                  r.correlation.deviation),
      metric_json("spread_rms_m", "Spread of the heights, RMS", 1e6 * r.spread_rms_m, "µm", NAN),
      metric_json("pitch_m", "Pitch, mean ± sd", 1e3 * r.pitch_m.mean, "mm", 1e3 * r.pitch_m.deviation),
      metric_json("depth_m", "Depth, mean ± sd", 1e6 * r.depth_m.mean, "µm", 1e6 * r.depth_m.deviation)};
  block.head()["band_cycles_per_mm"] = {config.low_cycles_per_mm, r.band_high_cycles_per_mm};
  block.add("s_m", r.s_m);
  std::vector<float> heights;
  for (const std::vector<double>& one : r.height_m) heights.insert(heights.end(), one.begin(), one.end());
  block.add("height_m", heights, {r.height_m.size(), r.s_m.size()});
  block.add("mean_m", floats(r.mean_m));
  std::vector<float> low, high;
  for (std::size_t i = 0; i < r.mean_m.size(); ++i) {
    low.push_back(static_cast<float>(r.mean_m[i] - r.deviation_m[i]));
    high.push_back(static_cast<float>(r.mean_m[i] + r.deviation_m[i]));
  }
  block.add("low_m", low);
  block.add("high_m", high);
  return block;
}

}  // namespace asperity::studio
