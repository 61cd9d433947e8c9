#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "asperity/base/config_tree.h"
#include "asperity/base/csv.h"
#include "asperity/base/text.h"
#include "asperity/base/version.h"
#include "asperity/pipeline/config_json.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/pipeline/recorded_series.h"
#include "asperity/recording/read_recording.h"
#include "asperity/session/our_file.h"
#include "asperity/texture/evaluate_height.h"
#include "asperity/texture/texture_file.h"
#include "commands.h"
#include "option_units.h"
#include "read_series.h"
#include "texture_fit_settings.h"
#include "texture_input.h"

namespace asperity::app {

namespace {

using Json = nlohmann::ordered_json;

// A texture and what its fit says of it.
struct Fitted {
  Texture texture;
  Json report;
  Problems problems;

  void take(const Problems& more) { problems.insert(problems.end(), more.begin(), more.end()); }
};

class TextureFitCommand : public Command {
 public:
  explicit TextureFitCommand(Parser& root)
      : Command(root, "fit", "A haptic texture from profiles, strokes, an areal map or another texture") {
    require(parser().add_option("PROFILE", files_,
                                "profile.csv, heights, x,y,z or t_s,acceleration_mps2,speed_mps,force_N tables, a "
                                "*.texture.json, a Penn *.xml, or (autoregressive) a recording"));
    require(parser().add_option("-o,--output", output_, "The texture's file"))->type_name("X.texture.json");
    parser()
        .add_option(
            "--model", model_,
            "fourier1d (the default), fourier2d, heightmap, areal, stochastic, autoregressive or decaying_sinusoids")
        ->type_name("NAME");
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
    refuse_stranger(output_, begins_as_texture, files_);
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
      case FitModel::kStochastic:
        fit_noise(fitted);
        break;
      case FitModel::kAutoregressive:
        fit_vibrations(fitted);
        break;
      case FitModel::kDecayingSinusoids:
        fit_taps(fitted);
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

  void fit_noise(Fitted& fitted) {
    const HeightProfile profile = read_strokes(files_, settings_.input);
    fitted.texture.roughness = roughness_of({profile.height_m}, profile.spacing_m);
    const StochasticFit fit = fit_stochastic(profile.height_m, profile.spacing_m, settings_.stochastic);
    fitted.report["samples"] = fit.samples;
    fitted.report["sigma_m"] = fit.texture.sigma_m;
    fitted.report["skewness"] = fit.skewness;
    fitted.report["excess_kurtosis"] = fit.excess_kurtosis;
    fitted.report["kolmogorov_distance"] = fit.kolmogorov_distance;
    fitted.report["correlation_length_m"] = fit.correlation_length_m;
    fitted.report["not_white"] = fit.not_white;
    fitted.report["misplaced_power"] = fit.misplaced_power;
    fitted.take(fit.problems);
    fitted.texture.model = fit.texture;
  }

  void fit_vibrations(Fitted& fitted) {
    if (files_.size() > 1) throw UsageError("autoregressive takes one recording, or one Penn Haptic Texture XML");
    if (files_.front().ends_with(".xml")) {
      PennTexture penn = import_penn(files_.front(), settings_.penn);
      fitted.report["models"] = penn.texture.models.size();
      fitted.texture.friction = penn.friction;
      fitted.take(penn.problems);
      fitted.texture.model = std::move(penn.texture);
      return;
    }
    const SeriesTable table = std::filesystem::is_directory(files_.front()) ? series_of_recording(files_.front())
                                                                            : read_series(files_.front());
    AutoregressiveFit fit = fit_autoregressive({table.acceleration_mps2, table.speed_mps, table.force_N, table.rate_Hz},
                                               settings_.autoregressive);
    fitted.report["samples"] = fit.samples;
    fitted.report["models"] = fit.texture.models.size();
    fitted.report["order"] = fit.order;
    if (fit.held_out.samples > 0) {
      fitted.report["held_out"] = {{"variance_error", fit.held_out.variance_error},
                                   {"spectrum_error", fit.held_out.spectrum_error},
                                   {"worst_band_error", fit.held_out.worst_band_error},
                                   {"samples", fit.held_out.samples}};
    }
    fitted.take(fit.problems);
    fitted.texture.model = std::move(fit.texture);
  }

  // Acceleration along the normal, speed and force as the fused estimate has them.
  static SeriesTable series_of_recording(const std::string& folder) {
    const ProcessResult result = process_recording(read_recording(folder), {});
    try {
      RecordedSeries series = recorded_series(result);
      return {std::move(series.acceleration_mps2), std::move(series.speed_mps), std::move(series.force_N),
              series.rate_Hz};
    } catch (const Error& error) {
      throw Error(printable(folder, 200) + ": " + error.what());
    }
  }

  void fit_taps(Fitted& fitted) {
    std::vector<SeriesTable> tables;
    for (const auto& file : files_) tables.push_back(read_series(file));
    std::vector<TapRecording> taps;
    for (std::size_t i = 0; i < tables.size(); ++i) {
      const SeriesTable& table = tables[i];
      if (std::abs(table.rate_Hz - tables.front().rate_Hz) > 1e-3 * tables.front().rate_Hz)
        throw Error(files_[i] + ": another rate than " + files_.front());
      taps.push_back({table.acceleration_mps2, table.speed_mps.front(), table.force_N.front()});
    }
    FitDecayingSinusoidsConfig config = settings_.decaying_sinusoids;
    config.rate_Hz = tables.front().rate_Hz;
    const DecayingSinusoidsFit fit = fit_decaying_sinusoids(taps, config);
    fitted.report["taps"] = taps.size();
    fitted.report["rms_mps2"] = fit.rms_mps2;
    fitted.report["rms_error_mps2"] = fit.rms_error_mps2;
    fitted.report["converged"] = fit.converged;
    fitted.report["speed_and_force_determined"] = fit.speed_and_force_determined;
    fitted.take(fit.problems);
    fitted.texture.model = fit.texture;
  }

  // Files beside the texture's own are replaced if the texture that is there now names them.
  void refuse_other_payloads(const Texture& texture) const {
    std::string before;
    if (std::filesystem::exists(output_)) before = read_file(output_, std::uint64_t{1} << 24);
    for (const TexturePayload& payload : format_texture_files(texture, texture_stem(output_)).payloads) {
      const bool named = before.find('"' + payload.file + '"') != std::string::npos;
      refuse_stranger(
          std::filesystem::path(output_).parent_path() / payload.file, [named](std::string_view) { return named; },
          files_);
    }
  }

  void finish(Fitted& fitted) {
    Texture& texture = fitted.texture;
    if (is_height_field(texture.model)) texture.lift_m = lift_m(texture.model);
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
    refuse_other_payloads(texture);
    write_texture(output_, texture);

    Json out;
    out["format"] = "asperity-texture-fit";
    out["version"] = 1;
    out["file"] = output_;
    out["model"] = texture.model_name();
    if (texture.lift_m) out["lift_m"] = *texture.lift_m;
    out["fit"] = fitted.report;
    out["roughness"] = texture.roughness;
    out["config"] = config_tree<Json>(fields());
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
    if (fitted.report.contains("models"))
      text += fmt::format(", {} models", fitted.report["models"].get<std::size_t>());
    if (fitted.report.contains("held_out")) {
      const Json& error = fitted.report["held_out"];
      text += fmt::format(", on a held-out half: variance {:+.1f} %, spectrum {:.1f} %",
                          100.0 * error["variance_error"].get<double>(), 100.0 * error["spectrum_error"].get<double>());
    }
    if (texture.lift_m) text += fmt::format(", lift {:.4g} µm", *texture.lift_m * 1e6);
    text += "\n";
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

std::unique_ptr<Command> make_texture_fit(Parser& root) { return std::make_unique<TextureFitCommand>(root); }

}  // namespace asperity::app
