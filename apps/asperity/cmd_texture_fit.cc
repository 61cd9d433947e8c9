#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "asperity/base/text.h"
#include "asperity/base/version.h"
#include "asperity/pipeline/config_json.h"
#include "asperity/texture/evaluate_height.h"
#include "asperity/texture/fit_areal.h"
#include "asperity/texture/fit_fourier1d.h"
#include "asperity/texture/fit_fourier1d_samples.h"
#include "asperity/texture/fit_fourier2d.h"
#include "asperity/texture/make_height_map.h"
#include "asperity/texture/texture_file.h"
#include "commands.h"
#include "option_units.h"
#include "texture_input.h"

namespace asperity::app {

namespace {

using Json = nlohmann::ordered_json;

enum class FitModel { kFourier1d, kFourier2d, kHeightMap, kAreal };
constexpr std::array<std::string_view, 4> kFitModelNames{"fourier1d", "fourier2d", "heightmap", "areal"};

struct FitSettings {
  FitModel model = FitModel::kFourier1d;
  bool whole_path = false;
  double stroke_spacing_mm = 0.0;

  template <class V>
  void visit(V& v) {
    v.choice("model", model, kFitModelNames, "what the texture is");
    v.field("whole_path", whole_path, "fourier1d: the whole path as one series instead of its best window");
    v.field("stroke_spacing_mm", stroke_spacing_mm, "areal: how far profiles lie apart, in their order; 0: not given",
            {0.0, 1e6});
  }
};

struct TextureFitSettings {
  ReadHeightsConfig input;
  FitSettings fit;
  FitFourier1dConfig fourier1d;
  FitFourier1dPathConfig path;
  FitFourier2dConfig fourier2d;
  MakeHeightMapConfig heightmap;
  FitArealConfig areal;

  template <class V>
  void visit(V& v) {
    v.group("input", input);
    v.group("fit", fit);
    v.group("fourier1d", fourier1d);
    v.group("path", path);
    v.group("fourier2d", fourier2d);
    v.group("heightmap", heightmap);
    v.group("areal", areal);
  }
};

// A texture and what its fit says of it.
struct Fitted {
  Texture texture;
  Json report;
  Problems problems;

  void take(const Problems& more) { problems.insert(problems.end(), more.begin(), more.end()); }
};

class TextureFitCommand : public Command {
 public:
  explicit TextureFitCommand(CLI::App& root)
      : Command(root, "fit", "A haptic texture from profiles, strokes, an areal map or another texture") {
    require(parser().add_option("PROFILE", files_, "profile.csv, heights, x,y,z tables, or a *.texture.json"));
    require(parser().add_option("-o,--output", output_, "The texture's file"))->type_name("X.texture.json");
    parser().add_option("--model", model_, "fourier1d (the default), fourier2d, heightmap or areal")->type_name("NAME");
    parser()
        .add_option("--spacing", spacing_, "Distance of the heights, for a file without positions")
        ->type_name("LENGTH");
    parser().add_option("--name", name_, "The texture's name; the file's unless given")->type_name("TEXT");
    parser().add_flag("--whole-path", whole_path_, "One series over the whole path");
  }

  std::vector<ConfigField> fields() override { return list_fields("", settings_); }

  void apply_options() override {
    if (!spacing_.empty()) settings_.input.spacing_m = length_option_m("--spacing", spacing_);
    if (whole_path_) settings_.fit.whole_path = true;
    if (model_.empty()) return;
    try {
      set_field(fields(), "fit.model", model_);
    } catch (const Error& error) {
      throw UsageError(std::string("--model: ") + error.what());
    }
  }

  int run(const Observer&) override {
    if (!output_.ends_with(".json")) throw UsageError("-o: a texture's file is called *.texture.json");
    Fitted fitted;
    switch (settings_.fit.model) {
      case FitModel::kFourier1d:
        fit_series(fitted);
        break;
      case FitModel::kFourier2d:
        fit_surface(fitted);
        break;
      case FitModel::kHeightMap:
        fit_image(fitted);
        break;
      case FitModel::kAreal:
        fit_area(fitted);
        break;
    }
    finish(fitted);
    return kDone;
  }

 private:
  // The profile or profiles as a series, and of the profiles the roughness.
  Fourier1d series_of(const std::vector<std::string>& files, Fitted& fitted) {
    const HeightProfile profile = read_strokes(files, settings_.input);
    fitted.texture.roughness = roughness_of({profile.height_m}, profile.spacing_m);
    const double nyquist = 0.5e-3 / profile.spacing_m;
    Fourier1d series;
    if (settings_.fit.whole_path) {
      FourierPathFit path = fit_fourier1d_path(profile.height_m, profile.spacing_m, settings_.path);
      fitted.report["rms_height_m"] = path.fit.rms_height_m;
      fitted.report["rms_error_m"] = path.fit.rms_error_m;
      fitted.report["relative_residual"] = path.fit.relative_residual;
      fitted.take(path.problems);
      series = std::move(path.fit.texture);
    } else {
      FourierFit window = fit_fourier1d(profile.height_m, profile.spacing_m, settings_.fourier1d);
      fitted.report["first_sample"] = window.first_sample;
      fitted.report["samples"] = window.samples;
      fitted.report["bridged"] = window.bridged;
      fitted.report["rms_height_m"] = window.rms_height_m;
      fitted.report["rms_error_m"] = window.rms_error_m;
      fitted.take(window.problems);
      series = std::move(window.texture);
    }
    fitted.texture.band_cycles_per_mm = {0.0,
                                         std::min(nyquist, static_cast<double>(series.a_m.size()) / series.length_mm)};
    return series;
  }

  void fit_series(Fitted& fitted) { fitted.texture.model = series_of(files_, fitted); }

  void fit_surface(Fitted& fitted) {
    if (files_.size() > 2) throw UsageError("fourier2d takes one profile, or one along x and one along y");
    const Fourier1d x = series_of({files_.front()}, fitted);
    Fitted across;
    const Fourier1d y = files_.size() == 2 ? series_of({files_.back()}, across) : x;
    Fourier2dFit fit = fit_fourier2d(x, y, settings_.fourier2d);
    fitted.report["kind"] = kFourier2dKindNames.at(static_cast<std::size_t>(fit.texture.kind));
    fitted.report["surface_rms_m"] = fit.rms_height_m;
    fitted.report["source_rms_m"] = fit.source_rms_m;
    if (fit.texture.kind == Fourier2dKind::kIsotropic) fitted.report["spectrum_error"] = fit.spectrum_error;
    fitted.take(across.problems);
    fitted.take(fit.problems);
    fitted.texture.model = std::move(fit.texture);
  }

  void fit_image(Fitted& fitted) {
    if (is_texture_file(files_.front())) {
      if (files_.size() > 1) throw UsageError("heightmap takes one texture");
      fitted.texture = read_texture(files_.front());
    } else {
      fit_surface(fitted);
    }
    HeightMapFit fit = make_height_map(fitted.texture.model, settings_.heightmap);
    fitted.report["map_rms_m"] = fit.rms_height_m;
    fitted.report["map_rms_error_m"] = fit.rms_error_m;
    fitted.report["quantisation_m"] = fit.quantisation_m;
    if (fit.clipped > 0)
      fitted.take({{"clipped", std::to_string(fit.clipped) + " pixels lie outside the range", fit.clipped}});
    fitted.texture.model = std::move(fit.texture);
  }

  void fit_area(Fitted& fitted) {
    const auto samples = read_areal_samples(files_, settings_.input, 1e-3 * settings_.fit.stroke_spacing_mm);
    ArealFit fit = fit_areal(samples, settings_.areal);
    fitted.report["samples"] = samples.size();
    fitted.report["rms_height_m"] = fit.rms_height_m;
    fitted.report["rms_error_m"] = fit.rms_error_m;
    fitted.report["supported_part"] = fit.supported_part;
    fitted.report["relative_residual"] = fit.relative_residual;
    fitted.take(fit.problems);
    const SplineGrid& grid = fit.texture.surface;
    const double spacing_m = std::max(grid.spacing_x_m, grid.spacing_y_m);
    fitted.texture.model = std::move(fit.texture);
    const auto& surface = std::get<ArealTexture>(fitted.texture.model).surface;
    const double length_m = static_cast<double>(surface.columns - 4) * surface.spacing_x_m;
    const double step_m = std::min(0.25 * surface.spacing_x_m, length_m / 64.0);
    fitted.texture.roughness = roughness_of(lines_through(fitted.texture.model, length_m, step_m), step_m);
    fitted.texture.band_cycles_per_mm = {0.0, 0.5e-3 / spacing_m};
  }

  void finish(Fitted& fitted) {
    Texture& texture = fitted.texture;
    texture.lift_m = lift_m(texture.model);
    texture.name = name_;
    if (name_.empty()) {
      texture.name = std::filesystem::path(output_).filename().string();
      for (const char* ending : {".json", ".texture"}) {
        if (texture.name.ends_with(ending)) texture.name.resize(texture.name.size() - std::string_view(ending).size());
      }
    }
    std::string sources;
    for (const auto& file : files_)
      sources += (sources.empty() ? "" : ", ") + std::filesystem::path(file).filename().string();
    constexpr std::size_t kLongest_bytes = 4000;
    texture.source = {printable(sources, kLongest_bytes), config_json(fields()), kVersion};
    Json problems = Json::array();
    for (const auto& problem : fitted.problems)
      problems.push_back({{"kind", problem.kind}, {"message", problem.message}, {"count", problem.count}});
    fitted.report["problems"] = problems;
    Json extra = Json::parse(texture.extra_json);
    extra["fit"] = fitted.report;
    texture.extra_json = extra.dump();
    write_texture(output_, texture);

    Json out;
    out["format"] = "asperity-texture-fit";
    out["version"] = 1;
    out["file"] = output_;
    out["model"] = texture.model_name();
    out["lift_m"] = *texture.lift_m;
    out["fit"] = fitted.report;
    out["roughness"] = texture.roughness;
    out["config"] = Json::parse(config_json(fields()));
    out["asperity"] = kVersion;
    print_json(out.dump(2, ' ', false, Json::error_handler_t::replace));
    std::string text = fmt::format("{}: {}", output_, texture.model_name());
    for (const auto& [key, what] : {std::pair{"rms_height_m", "RMS height"},
                                    {"rms_error_m", "error"},
                                    {"surface_rms_m", "surface RMS"},
                                    {"map_rms_error_m", "image error"}}) {
      if (fitted.report.contains(key))
        text += fmt::format(", {} {:.3g} µm", what, fitted.report[key].get<double>() * 1e6);
    }
    if (fitted.report.contains("spectrum_error"))
      text += fmt::format(", spectrum error {:.1f} %", 100.0 * fitted.report["spectrum_error"].get<double>());
    text += fmt::format(", lift {:.4g} µm\n", *texture.lift_m * 1e6);
    for (const auto& problem : fitted.problems) text += "note: " + problem.message + "\n";
    say(text);
  }

  std::vector<std::string> files_;
  std::string output_;
  std::string model_;
  std::string spacing_;
  std::string name_;
  bool whole_path_ = false;
  TextureFitSettings settings_;
};

}  // namespace

std::unique_ptr<Command> make_texture_fit(CLI::App& root) { return std::make_unique<TextureFitCommand>(root); }

}  // namespace asperity::app
