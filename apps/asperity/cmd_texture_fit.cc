#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "asperity/base/csv.h"
#include "asperity/base/text.h"
#include "asperity/base/version.h"
#include "asperity/json/config_json.h"
#include "asperity/json/parse_json.h"
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

// "a (the default), b, c or d".
std::string model_names() {
  std::string out;
  for (std::size_t k = 0; k < kFittedModelNames.size(); ++k) {
    const bool is_last = k + 1 == kFittedModelNames.size();
    out.append(k == 0 ? "" : is_last ? " or " : ", ").append(kFittedModelNames[k]);
    if (k == 0) out += " (the default)";
  }
  return out;
}

// Acceleration along the normal, speed and force as the fused estimate has them.
SeriesTable series_of_recording(const std::string& folder) {
  const ProcessResult result = process_recording(read_recording(folder), {});
  try {
    RecordedSeries series = recorded_series(result);
    return {std::move(series.acceleration_mps2), std::move(series.speed_mps), std::move(series.force_N),
            series.rate_Hz};
  } catch (const Error& error) {
    throw Error(printable(folder, 200) + ": " + error.what());
  }
}

class TextureFitCommand : public Command {
 public:
  explicit TextureFitCommand(Parser& root)
      : Command(root, "fit", "A haptic texture from profiles, strokes, an areal map or another texture") {
    require(parser().add_option("PROFILE", files_,
                                "profile.csv, heights, x,y,z or t_s,acceleration_mps2,speed_mps,force_N tables, a "
                                "*.texture.json, a Penn *.xml, or (autoregressive) a recording"));
    require(parser().add_option("-o,--output", output_, "The texture's file"))->type_name("X.texture.json");
    parser().add_option("--model", model_, model_names())->type_name("NAME");
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
    FittedTexture fitted = fit();
    finish(fitted);
    return kDone;
  }

 private:
  FittedTexture fit() const {
    TextureFitInput input;
    input.files = files_;
    input.whole_path = settings_.fit.whole_path;
    input.read_heights = [&](const std::vector<std::string>& files) {
      HeightProfile profile = read_strokes(files, settings_.input);
      return HeightLine{std::move(profile.height_m), profile.spacing_m};
    };
    input.read_areal_samples = [&](const std::vector<std::string>& files) {
      return asperity::app::read_areal_samples(files, settings_.input, 1e-3 * settings_.fit.stroke_spacing_mm);
    };
    input.read_series = [](const std::string& file) { return asperity::app::read_series(file); };
    input.read_recording_or_series = [](const std::string& file) {
      return std::filesystem::is_directory(file) ? series_of_recording(file) : asperity::app::read_series(file);
    };
    input.is_texture_file = [](const std::string& file) { return asperity::app::is_texture_file(file); };
    input.roughness = [](const std::vector<std::vector<double>>& lines_m, double spacing_m) {
      return roughness_of(lines_m, spacing_m);
    };
    try {
      return fit_texture(settings_.fit.model, input, settings_.models);
    } catch (const TextureFitFilesError& error) {
      throw UsageError(error.what());
    }
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

  void finish(FittedTexture& fitted) {
    Texture& texture = fitted.texture;
    Json& report = fitted.report;
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
    texture.source = {printable(sources, kLongest_bytes), config_json(fields()).dump(2), kVersion};
    Json problems = Json::array();
    for (const auto& problem : fitted.problems)
      problems.push_back({{"kind", problem.kind}, {"message", problem.message}, {"count", problem.count}});
    report["problems"] = problems;
    Json extra = parse_json(texture.extra_json);
    extra["fit"] = report;
    texture.extra_json = extra.dump();
    refuse_other_payloads(texture);
    write_texture(output_, texture);

    Json out;
    out["format"] = "asperity-texture-fit";
    out["version"] = 1;
    out["file"] = output_;
    out["model"] = texture.model_name();
    if (texture.lift_m) out["lift_m"] = *texture.lift_m;
    out["fit"] = report;
    out["roughness"] = texture.roughness;
    out["config"] = config_json(fields());
    out["asperity"] = kVersion;
    print_json(out.dump_repaired(2));
    std::string text = fmt::format("{}: {}", output_, texture.model_name());
    for (const auto& [key, what] : {std::pair{"rms_height_m", "RMS height"},
                                    {"rms_error_m", "error"},
                                    {"surface_rms_m", "surface RMS"},
                                    {"map_rms_error_m", "image error"}}) {
      if (report.contains(key)) text += fmt::format(", {} {:.3g} µm", what, report[key].get<double>() * 1e6);
    }
    if (report.contains("spectrum_error"))
      text += fmt::format(", spectrum error {:.1f} %", 100.0 * report["spectrum_error"].get<double>());
    if (report.contains("models")) text += fmt::format(", {} models", report["models"].get<std::size_t>());
    if (report.contains("held_out")) {
      const Json& error = report["held_out"];
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
