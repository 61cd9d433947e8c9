#include "asperity/studio/result_figure.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/pipeline/read_path.h"
#include "asperity/profile/measure_surface_spectrum.h"
#include "asperity/texture/evaluate_height.h"
#include "asperity/texture/texture_file.h"
#include "figure_panels.h"
#include "kept_block.h"
#include "result_tables.h"

namespace asperity::studio {

namespace fs = std::filesystem;

namespace {

std::string called(const fs::path& file) { return printable(file.string(), 200); }

double number_in(const Json& object, const char* key) {
  const Json* value = object.find(key);
  return value != nullptr && value->is_number() ? value->get<double>() : kNan;
}

// Where the areal texture's heights are determined, at its own points; and their standard deviation.
void add_area(const ArealTexture& area, const std::string& title, std::vector<NamedMap>& out) {
  const SplineGrid& grid = area.surface;
  ArealMap height{grid.spacing_x_m, grid.spacing_y_m, grid.columns, grid.rows, {}};
  ArealMap sigma = height;
  for (std::size_t row = 0; row < grid.rows; ++row) {
    for (std::size_t column = 0; column < grid.columns; ++column) {
      const std::size_t i = row * grid.columns + column;
      const bool known = area.supported.empty() || area.supported.at(i) != 0;
      const double x_m = grid.origin_x_m + grid.spacing_x_m * static_cast<double>(column);
      const double y_m = grid.origin_y_m + grid.spacing_y_m * static_cast<double>(row);
      height.height_m.push_back(known ? evaluate_height(TextureModel(area), x_m, y_m).height_m : kNan);
      if (!area.sigma_m.empty()) sigma.height_m.push_back(known ? area.sigma_m.at(i) : kNan);
    }
  }
  out.push_back({title + ": height", std::move(height)});
  if (!sigma.height_m.empty()) out.push_back({title + ": standard deviation of the height", std::move(sigma)});
}

DrawnResult read_area(const FigureSource& source) {
  DrawnResult out;
  out.name = source.name;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(source.path))
    if (entry.path().filename().string().ends_with(".texture.json")) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    const Texture texture = read_texture(file);
    if (const auto* area = std::get_if<ArealTexture>(&texture.model))
      add_area(*area, texture.name.empty() ? source.name : texture.name, out.maps);
  }
  return out;
}

DrawnResult read_measured(const FigureSource& source) {
  const fs::path& folder = source.path;
  DrawnResult out;
  out.name = source.name;
  const Json result =
      parse_result(read_file(folder / "result.json", kLargestResult_bytes), called(folder / "result.json"));
  const Json* trustworthy = result.find("trustworthy");
  if (trustworthy != nullptr && trustworthy->is_boolean() && !trustworthy->get<bool>()) {
    const Json* verdict = result.find("verdict");
    out.invalid = verdict != nullptr && verdict->is_string() && !verdict->text().empty() ? verdict->text() : "invalid";
  }
  out.profile = parse_profile(read_file(folder / "profile.csv", kLargestProfile_bytes), called(folder / "profile.csv"));
  if (fs::is_regular_file(folder / "spectrum.csv"))
    out.spectrum =
        parse_spectrum(read_file(folder / "spectrum.csv", kLargestProfile_bytes), called(folder / "spectrum.csv"));
  if (fs::is_regular_file(folder / "trajectory.csv")) out.path = read_path(folder / "trajectory.csv").motion;
  if (const auto block = kept_block(folder / "report.html", result)) {
    ComplianceCurve curve{block_numbers(*block, "compliance_force_N"), block_numbers(*block, "compliance_ratio")};
    const Json compliance = result.value("compliance", Json::object());
    curve.exponent = number_in(compliance, "force_exponent");
    const Json* determined = compliance.find("determined");
    curve.determined = determined != nullptr && determined->is_boolean() && determined->get<bool>();
    if (!curve.force_N.empty() && curve.force_N.size() == curve.ratio.size()) out.compliance = std::move(curve);
  }
  return out;
}

// A profile.csv with all of its columns, or heights of any other kind.
DrawnResult read_heights_file(const FigureSource& source, const ResultFigureConfig& config) {
  DrawnResult out;
  out.name = source.name;
  if (source.path.filename() == "profile.csv") {
    out.profile = parse_profile(read_file(source.path, kLargestProfile_bytes), called(source.path));
    if (out.profile->size() > 1 && config.input.spacing_m == 0.0)
      out.spectrum = measure_surface_spectrum(out.profile->texture_m, out.profile->spacing_m, {});
    return out;
  }
  Heights heights = read_heights(source.path, config.input);
  if (auto* map = std::get_if<ArealMap>(&heights)) {
    out.maps.push_back({source.name + ": height", std::move(*map)});
    return out;
  }
  const auto& line = std::get<HeightProfile>(heights);
  Profile profile;
  profile.spacing_m = line.spacing_m;
  profile.height_m = line.height_m;
  profile.sigma_m = line.sigma_m;
  for (std::size_t i = 0; i < line.height_m.size(); ++i) profile.s_m.push_back(line.spacing_m * static_cast<double>(i));
  out.spectrum = measure_surface_spectrum(line.height_m, line.spacing_m, {});
  out.profile = std::move(profile);
  return out;
}

DrawnResult read_source(const FigureSource& source, const ResultFigureConfig& config) {
  if (!fs::exists(source.path)) throw Error(called(source.path) + ": no such file or folder");
  if (!fs::is_directory(source.path)) {
    if (!source.path.filename().string().ends_with(".json")) return read_heights_file(source, config);
    const Texture texture = read_texture(source.path);
    const auto* area = std::get_if<ArealTexture>(&texture.model);
    if (area == nullptr) {
      throw Error(called(source.path) + ": is a texture of model '" + std::string(texture.model_name()) +
                  "', which has no map; asperity texture synthesize makes a profile or an image of it");
    }
    DrawnResult out;
    out.name = source.name;
    add_area(*area, source.name, out.maps);
    return out;
  }
  if (fs::is_regular_file(source.path / "area.json")) return read_area(source);
  if (fs::is_regular_file(source.path / "result.json")) return read_measured(source);
  throw Error(called(source.path) +
              ": contains no result (neither result.json of process, register and merge nor area.json of area)");
}

struct FigureBuilder {
  const std::vector<DrawnResult>& results;
  std::span<const FigurePart> wanted;
  ResultFigure out{};

  bool wants(FigurePart part) const {
    return wanted.empty() || std::find(wanted.begin(), wanted.end(), part) != wanted.end();
  }

  void add(FigurePart part, std::optional<FigurePanel> panel, const char* missing) {
    if (!wants(part)) return;
    if (!panel) {
      out.missing.emplace_back(missing);
      return;
    }
    out.figure.panels.emplace_back(std::move(*panel));
    out.drawn.push_back(part);
  }
};

}  // namespace

ResultFigure make_result_figure(std::span<const FigureSource> sources, std::span<const FigurePart> parts,
                                const ResultFigureConfig& config) {
  std::vector<DrawnResult> results;
  for (const FigureSource& source : sources) results.push_back(read_source(source, config));
  FigureBuilder build{results, parts};
  const bool lines =
      std::any_of(results.begin(), results.end(), [](const DrawnResult& r) { return r.profile.has_value(); });
  const auto asked = [&](FigurePart part) {  // of maps alone, nobody misses a path
    return lines || (!parts.empty() && build.wants(part));
  };
  if (asked(FigurePart::kProfile))
    build.add(FigurePart::kProfile, profile_panel(results, config.band_sigmas), "no height profile");
  if (asked(FigurePart::kTexture))
    build.add(FigurePart::kTexture, texture_panel(results, config.band_sigmas), "no high-passed texture");
  if (asked(FigurePart::kSpectrum)) build.add(FigurePart::kSpectrum, spectrum_panel(results), "no spectrum");
  if (asked(FigurePart::kPath)) build.add(FigurePart::kPath, path_panel(results), "no path (trajectory.csv)");
  if (asked(FigurePart::kCompliance))
    build.add(FigurePart::kCompliance, compliance_panel(results), "no windows of the compliance (in report.html)");
  if (build.wants(FigurePart::kMap)) {
    for (const DrawnResult& result : results)
      for (const NamedMap& map : result.maps) {
        build.out.figure.panels.emplace_back(map_panel(map));
        build.out.drawn.push_back(FigurePart::kMap);
      }
    if (!lines || !parts.empty())
      if (std::find(build.out.drawn.begin(), build.out.drawn.end(), FigurePart::kMap) == build.out.drawn.end())
        build.out.missing.emplace_back("no areal map");
  }
  if (build.out.drawn.empty()) {
    std::string what;
    for (const std::string& missing : build.out.missing) what += (what.empty() ? "" : ", ") + missing;
    throw Error(called(sources.empty() ? fs::path() : sources.front().path) + ": nothing to draw: " + what);
  }
  if (parts.empty()) build.out.missing.clear();  // all that there is was asked for
  for (const DrawnResult& result : results) {
    build.out.figure.title += (build.out.figure.title.empty() ? "" : ", ") + result.name;
    if (!result.invalid.empty())
      build.out.figure.note += (build.out.figure.note.empty() ? "INVALID: " : "; ") +
                               (results.size() > 1 ? result.name + ": " : std::string()) +
                               printable(result.invalid, 100);
  }
  build.out.figure.title = printable(build.out.figure.title, 100);
  return std::move(build.out);
}

}  // namespace asperity::studio
