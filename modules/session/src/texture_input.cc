#include "asperity/session/texture_input.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <optional>
#include <utility>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "asperity/base/text.h"
#include "asperity/base/units.h"
#include "asperity/profile/measure_roughness.h"
#include "asperity/recording/fingerprint.h"

namespace asperity {

namespace {

constexpr std::uint64_t kLargestFile_bytes = 512ULL << 20;

struct Column {
  std::size_t index = 0;
  double unit_m = 1.0;
};

std::optional<Column> find_column(const CsvReader& csv, std::initializer_list<std::string_view> quantities) {
  for (std::size_t i = 0; i < csv.columns().size(); ++i) {
    const auto named = split_length_name(csv.columns()[i]);
    if (named && std::find(quantities.begin(), quantities.end(), named->quantity) != quantities.end()) {
      return Column{i, named->unit_m};
    }
  }
  return std::nullopt;
}

// A table of scattered heights; nullopt if its columns are not one's.
std::optional<std::vector<ArealSample>> read_scattered(const std::string& file, std::vector<FileUnits>* units) {
  const std::string text = read_file(file, kLargestFile_bytes);
  const std::string_view start = std::string_view(text).substr(0, text.find('\n'));
  // Instruments' files and text in other encodings are read_heights()'s.
  if (start.find('y') == std::string_view::npos || start.find('\0') != std::string_view::npos || !is_utf8(start))
    return std::nullopt;
  CsvReader csv(text, file);
  const auto x = find_column(csv, {"x"});
  const auto y = find_column(csv, {"y"});
  auto z = find_column(csv, {"texture"});
  if (!z) z = find_column(csv, {"height", "z"});
  if (!x || !y || !z) return std::nullopt;
  if (units != nullptr) units->push_back({file, {{z->unit_m, UnitOrigin::kHeader}, {x->unit_m, UnitOrigin::kHeader}}});
  std::vector<ArealSample> samples;
  while (csv.next()) {
    samples.push_back({csv.number(x->index) * x->unit_m, csv.number(y->index) * y->unit_m,
                       csv.empty(z->index) ? kNan : csv.number(z->index) * z->unit_m});
  }
  return samples;
}

Heights read_with_units(const std::string& file, const ReadHeightsConfig& config, Problems* problems,
                        std::vector<FileUnits>* units) {
  HeightsOrigin origin;
  Heights heights = read_heights(file, config, problems, &origin);
  if (units != nullptr) units->push_back({file, origin.units});
  return heights;
}

void add_map(const ArealMap& map, std::vector<ArealSample>& samples) {
  for (std::size_t r = 0; r < map.rows; ++r) {
    for (std::size_t c = 0; c < map.columns; ++c) {
      samples.push_back(
          {static_cast<double>(c) * map.x_spacing_m, static_cast<double>(r) * map.y_spacing_m, map.at(r, c)});
    }
  }
}

// Strokes count as draws of one texture: the same one twice is none the more.
NamedFingerprint fingerprint_of(const std::string& file, const HeightProfile& profile) {
  NamedFingerprint out{file, {}};
  out.of.points = sketch_values(profile.height_m);
  return out;
}

}  // namespace

bool is_texture_file(const std::string& file) { return file.ends_with(".json"); }

HeightProfile read_strokes(const std::vector<std::string>& files, const ReadHeightsConfig& config, Problems* problems,
                           std::vector<FileUnits>* units) {
  HeightProfile all;
  std::vector<NamedFingerprint> read;
  for (const std::string& file : files) {
    const Heights heights = read_with_units(file, config, problems, units);
    const auto* profile = std::get_if<HeightProfile>(&heights);
    if (!profile) throw Error(file + ": is an areal map, but heights along a line are needed");
    read.push_back(fingerprint_of(file, *profile));
    if (all.height_m.empty()) {
      all = *profile;
      continue;
    }
    if (std::abs(profile->spacing_m - all.spacing_m) > 1e-6 * all.spacing_m) {
      throw Error(file + ": heights " + number_text(profile->spacing_m) + " m apart, those of " + files.front() + " " +
                  number_text(all.spacing_m));
    }
    // One missing height a millimetre: no stage bridges from stroke to stroke.
    const auto gap = static_cast<std::size_t>(std::ceil(1e-3 / all.spacing_m)) + 1;
    all.height_m.insert(all.height_m.end(), gap, kNan);
    all.height_m.insert(all.height_m.end(), profile->height_m.begin(), profile->height_m.end());
  }
  check_independent(read);
  return all;
}

std::vector<ArealSample> read_areal_samples(const std::vector<std::string>& files, const ReadHeightsConfig& config,
                                            double stroke_spacing_m, Problems* problems,
                                            std::vector<FileUnits>* units) {
  std::vector<ArealSample> samples;
  std::size_t strokes = 0;
  std::vector<NamedFingerprint> read;
  for (const std::string& file : files) {
    if (const auto scattered = read_scattered(file, units)) {
      samples.insert(samples.end(), scattered->begin(), scattered->end());
      continue;
    }
    const Heights heights = read_with_units(file, config, problems, units);
    if (const auto* map = std::get_if<ArealMap>(&heights)) {
      add_map(*map, samples);
      continue;
    }
    if (!(stroke_spacing_m > 0.0))
      throw Error(file + ": holds heights along a line; give the distance between the strokes (fit.stroke_spacing_mm)");
    const auto& profile = std::get<HeightProfile>(heights);
    read.push_back(fingerprint_of(file, profile));
    for (std::size_t i = 0; i < profile.height_m.size(); ++i) {
      samples.push_back({static_cast<double>(i) * profile.spacing_m, static_cast<double>(strokes) * stroke_spacing_m,
                         profile.height_m[i]});
    }
    ++strokes;
  }
  check_independent(read);
  return samples;
}

std::map<std::string, double> roughness_of(const std::vector<std::vector<double>>& lines_m, double spacing_m) {
  std::map<std::string, double> sum;
  std::map<std::string, double> count;
  for (const auto& line : lines_m) {
    const RoughnessResult r = measure_roughness(line, spacing_m);
    for (const auto& [name, value] : {std::pair{"Ra_m", r.Ra_m},
                                      {"Rq_m", r.Rq_m * r.Rq_m},
                                      {"Rz_m", r.Rz_m},
                                      {"Rt_m", r.Rt_m},
                                      {"Rsk", r.Rsk},
                                      {"Rku", r.Rku},
                                      {"RSm_m", r.RSm_m}}) {
      if (!std::isfinite(value)) continue;
      sum[name] += value;
      count[name] += 1.0;
    }
  }
  for (auto& [name, value] : sum) value /= count[name];
  if (sum.contains("Rq_m")) sum["Rq_m"] = std::sqrt(sum["Rq_m"]);
  return sum;
}

}  // namespace asperity
