#include "add/surface_look.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "asperity/base/base64.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/base/version.h"
#include "asperity/plot/format_drawing.h"
#include "asperity/profile/find_periodicity.h"
#include "asperity/profile/measure_areal_texture.h"
#include "asperity/profile/measure_roughness.h"
#include "asperity/profile/read_heights.h"
#include "asperity/session/texture_input.h"
#include "asperity/studio/result_figure.h"
#include "asperity/texture/evaluate_height.h"
#include "asperity/texture/texture_fit.h"

namespace asperity::studio {

namespace {

constexpr double kPicture_scale = 1.5;  // pixels for each of the drawing's

ReadHeightsConfig input_config(double spacing_m) {
  ReadHeightsConfig out;
  out.spacing_m = spacing_m;
  return out;
}

Json parameter(std::string_view name, double value, double factor, const char* unit) {
  return {{"key", std::string(name)},
          {"value", std::isfinite(value) ? fmt::format("{:.4g}", factor * value) : std::string()},
          {"unit", unit}};
}

std::pair<double, const char*> shown(ArealQuantity quantity) {
  switch (quantity) {
    case ArealQuantity::kHeight:
    case ArealQuantity::kAlong:
      return {1e6, "µm"};
    case ArealQuantity::kRatio:
      return {100.0, "%"};
    case ArealQuantity::kAngle:
      return {180.0 / std::numbers::pi, "°"};
    default:
      return {1.0, ""};
  }
}

std::size_t missing_in(std::span<const double> height_m) {
  return static_cast<std::size_t>(
      std::count_if(height_m.begin(), height_m.end(), [](double h) { return std::isnan(h); }));
}

void look(const HeightProfile& profile, Json& out) {
  const RoughnessResult found = measure_roughness(profile.height_m, profile.spacing_m);
  out["kind"] = "profile";
  out["points"] = profile.height_m.size();
  out["missing"] = missing_in(profile.height_m);
  out["size"] =
      fmt::format("{:.4g} mm, a height every {:.4g} µm",
                  1e3 * profile.spacing_m * static_cast<double>(profile.height_m.size()), 1e6 * profile.spacing_m);
  for (const RoughnessParameter& one : kRoughnessParameters) {
    out["parameters"].push_back(
        parameter(one.name, found.*one.value, one.is_length ? 1e6 : 1.0, one.is_length ? "µm" : ""));
  }
}

void look(const ArealMap& map, Json& out) {
  const ArealTextureResult found = measure_areal_texture(map);
  out["kind"] = "map";
  out["points"] = map.height_m.size();
  out["missing"] = missing_in(map.height_m);
  out["size"] =
      fmt::format("{:.4g} × {:.4g} mm, {} × {} heights", 1e3 * map.x_spacing_m * static_cast<double>(map.columns),
                  1e3 * map.y_spacing_m * static_cast<double>(map.rows), map.columns, map.rows);
  for (const ArealParameter& one : kArealParameters) {
    const auto [factor, unit] = shown(one.quantity);
    out["parameters"].push_back(parameter(one.name, found.*one.value, factor, unit));
  }
}

std::string picture_of(const std::filesystem::path& file, double spacing_m) {
  ResultFigureConfig config;
  config.input = input_config(spacing_m);
  const std::array<FigureSource, 1> sources{FigureSource{file.filename().string(), file}};
  const ResultFigure figure = make_result_figure(sources, {}, config);
  return base64(format_drawing(draw_figure(figure.figure), DrawingFormat::kPng, kPicture_scale));
}

}  // namespace

Json look_at_surface(const std::filesystem::path& file, double spacing_m) {
  Problems problems;
  const Heights heights = read_heights(file, input_config(spacing_m), &problems);
  Json out{{"kind", ""}, {"points", 0}, {"missing", 0}, {"size", ""}, {"picture", ""}, {"note", ""}};
  out["parameters"] = Json::array();
  try {
    std::visit([&](const auto& of) { look(of, out); }, heights);
    out["picture"] = picture_of(file, spacing_m);
  } catch (const Error& error) {
    problems.push_back({"not_shown", error.what(), 1});
  }
  std::string note;
  for (const Problem& problem : problems) note += (note.empty() ? "" : "; ") + problem.message;
  out["note"] = note;
  return out;
}

Texture texture_of_surface(const std::filesystem::path& file, double spacing_m, const std::string& name) {
  const ReadHeightsConfig config = input_config(spacing_m);
  const bool is_map = std::holds_alternative<ArealMap>(read_heights(file, config));
  TextureFitInput input;
  input.files = {file.string()};
  input.read_heights = [&](const std::vector<std::string>& files) {
    HeightProfile profile = read_strokes(files, config);
    return HeightLine{std::move(profile.height_m), profile.spacing_m};
  };
  input.pitch_m = [&](const std::vector<std::string>& files) {
    const HeightProfile profile = read_strokes(files, config);
    const Periodicity found = find_periodicity(profile.height_m, profile.spacing_m, {});
    return found.periodic ? found.pitch_m : 0.0;
  };
  input.read_areal_samples = [&](const std::vector<std::string>& files) {
    return read_areal_samples(files, config, 0.0);
  };
  input.is_texture_file = [](const std::string&) { return false; };
  input.roughness = [](const std::vector<std::vector<double>>& lines_m, double step_m) {
    return roughness_of(lines_m, step_m);
  };
  const std::string_view model = is_map ? "areal" : "fourier1d";
  const auto found = std::find(kFittedModelNames.begin(), kFittedModelNames.end(), model);
  FittedTexture fitted =
      fit_texture(static_cast<FittedModelChoice>(found - kFittedModelNames.begin()), input, TextureFitOptions{});
  fitted.texture.height_offset_m = height_offset_m(fitted.texture.model);
  fitted.texture.name = name;
  fitted.texture.source = {printable(file.filename().string(), 4000), Json::object(), kVersion};
  return std::move(fitted.texture);
}

}  // namespace asperity::studio
