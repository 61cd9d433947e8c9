#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/base/version.h"
#include "asperity/import/stroke_file.h"
#include "asperity/json/config_json.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/pipeline/recorded_series.h"
#include "asperity/profile/find_periodicity.h"
#include "asperity/profile/read_heights.h"
#include "asperity/recording/read_recording.h"
#include "asperity/session/our_file.h"
#include "asperity/session/rendered_input.h"
#include "asperity/session/texture_input.h"
#include "asperity/texture/evaluate_height.h"
#include "asperity/texture/texture_file.h"
#include "asperity/texture/texture_fit.h"
#include "commands.h"
#include "option_units.h"
#include "stroke_input.h"
#include "units_json.h"

namespace asperity::app {

namespace {

// A table t_s,acceleration_mps2,speed_mps,force_N (more columns allowed). Throws Error naming file, line and
// column for a number that is missing or not finite, or times that are not even to a hundredth of a step.
SeriesTable read_series(const std::string& file) {
  constexpr std::uint64_t kLargestFile_bytes = 512ULL << 20;
  const std::string text = read_file(file, kLargestFile_bytes);
  CsvReader csv(text, file);
  const std::size_t time = csv.require("t_s");
  const std::size_t acceleration = csv.require("acceleration_mps2");
  const std::size_t speed = csv.require("speed_mps");
  const std::size_t force = csv.require("force_N");
  SeriesTable table;
  std::vector<double> t_s;
  while (csv.next()) {
    t_s.push_back(csv.finite(time));
    table.acceleration_mps2.push_back(csv.finite(acceleration));
    table.speed_mps.push_back(csv.finite(speed));
    table.force_N.push_back(csv.finite(force));
  }
  if (t_s.size() < 2) throw Error(file + ": fewer than two rows");
  const double step_s = (t_s.back() - t_s.front()) / static_cast<double>(t_s.size() - 1);
  if (!(step_s > 0.0)) throw Error(file + ": t_s does not rise");
  for (std::size_t i = 0; i < t_s.size(); ++i) {
    const double expected_s = t_s.front() + static_cast<double>(i) * step_s;
    if (!(std::abs(t_s[i] - expected_s) <= 1e-2 * step_s)) {
      throw Error(file + ": t_s is not even: row " + std::to_string(i + 1) + " has " + number_text(t_s[i]) + " where " +
                  number_text(expected_s) + " was expected");
    }
  }
  table.rate_Hz = 1.0 / step_s;
  return table;
}

struct FitSettings {
  FittedModelChoice model{};
  bool whole_path = false;
  double stroke_spacing_mm = 0.0;

  template <class V>
  void visit(V& v) {
    v.choice("model", model, kFittedModelNames, "model of the texture");
    v.field("whole_path", whole_path, "fourier1d: the whole path as one series instead of its best window");
    v.field("stroke_spacing_mm", stroke_spacing_mm,
            "areal: distance of the profiles from each other, in their order; 0: not given", {0.0, 1e6});
  }
};

struct TextureFitSettings {
  ReadHeightsConfig input;
  FitSettings fit;
  TextureFitOptions models;

  template <class V>
  void visit(V& v) {
    v.group("input", input);
    v.group("fit", fit);
    models.visit(v);
  }
};

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
      : Command(root, "fit", "Fit a haptic texture to profiles, strokes, an areal map or another texture") {
    require(
        parser().add_option("PROFILE", files_,
                            "profile.csv, heights, x,y,z or t_s,acceleration_mps2,speed_mps,force_N tables, a "
                            "*.texture.json, a Penn *.xml, a stroke's folder (import --stroke), or (autoregressive) a "
                            "recording"));
    require(parser().add_option("-o,--output", output_, "The texture's file"))->type_name("X.texture.json");
    parser().add_option("--model", model_, model_names())->type_name("NAME")->suggest(kFittedModelNames);
    parser()
        .add_option("--spacing", spacing_, "Distance of the heights, for a file without positions")
        ->type_name("LENGTH");
    parser().add_option("--name", name_, "Name of the texture; default: that of the file")->type_name("TEXT");
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
    if (!output_.ends_with(".json")) throw UsageError("-o: the file of a texture ends in .texture.json");
    refuse_stranger(output_, begins_as_texture, files_);
    if (files_.size() == 1) reads(files_.front());
    FittedTexture fitted = fit();
    (void)format_texture_files(fitted.texture, "texture");  // what no texture file may have is the input's fault
    reads("");
    finish(fitted);
    return kDone;
  }

 private:
  FittedTexture fit() {
    // A stroke has no heights: of the models that are made of series this one takes speed and force from it.
    if (model_.empty() && settings_.fit.model == FittedModelChoice{} && is_stroke_folder(files_.front()))
      set_field(fields(), "fit.model", "autoregressive");
    TextureFitInput input;
    Problems doubtful;
    input.files = files_;
    input.whole_path = settings_.fit.whole_path;
    input.read_heights = [&](const std::vector<std::string>& files) {
      doubtful.clear();  // files may be read twice
      units_.clear();
      HeightProfile profile = read_strokes(files, settings_.input, &doubtful, &units_);
      return HeightLine{std::move(profile.height_m), profile.spacing_m};
    };
    input.pitch_m = [&](const std::vector<std::string>& files) {
      const HeightProfile profile = read_strokes(files, settings_.input);
      const Periodicity found = find_periodicity(profile.height_m, profile.spacing_m, {});
      return found.periodic ? found.pitch_m : 0.0;
    };
    input.read_areal_samples = [&](const std::vector<std::string>& files) {
      units_.clear();
      return asperity::read_areal_samples(files, settings_.input, 1e-3 * settings_.fit.stroke_spacing_mm, &doubtful,
                                          &units_);
    };
    input.read_series = [](const std::string& file) { return asperity::app::read_series(file); };
    input.read_recording_or_series = [](const std::string& file) {
      if (is_stroke_folder(file)) return series_of_stroke(file);
      return std::filesystem::is_directory(file) ? series_of_recording(file) : asperity::app::read_series(file);
    };
    input.is_texture_file = [](const std::string& file) { return asperity::is_texture_file(file); };
    input.roughness = [](const std::vector<std::vector<double>>& lines_m, double spacing_m) {
      return roughness_of(lines_m, spacing_m);
    };
    if (is_stroke_folder(files_.front()) && chosen_model() != "autoregressive")
      throw UsageError(printable(files_.front(), 200) +
                       " is a stroke, which has no heights: fit it with --model autoregressive");
    // Another file than the default model reads: what it is, and what to do.
    if (chosen_model() != "autoregressive" && files_.front().ends_with(".xml")) {
      throw UsageError(
          printable(files_.front(), 200) +
          " is an XML file: models of the Penn Haptic Texture Toolkit are read with --model autoregressive");
    }
    try {
      FittedTexture fitted = fit_texture(settings_.fit.model, input, settings_.models);
      fitted.problems.insert(fitted.problems.begin(), doubtful.begin(), doubtful.end());
      return fitted;
    } catch (const TextureFitFilesError& error) {
      throw UsageError(error.what());
    }
  }

  std::string_view chosen_model() const { return kFittedModelNames[static_cast<std::size_t>(settings_.fit.model)]; }

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
    if (is_height_field(texture.model)) texture.height_offset_m = height_offset_m(texture.model);
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
    std::vector<StrokeSource> made_from;
    for (const auto& file : files_) {
      if (is_stroke_folder(file)) {
        made_from.push_back({std::filesystem::path(file).filename().string(), "", {}});
        continue;
      }
      for (StrokeSource& source : sources_of_input(file)) made_from.push_back(std::move(source));
    }
    if (!made_from.empty()) note_sources(texture, made_from);
    Json problems = Json::array();
    for (const auto& problem : fitted.problems)
      problems.push_back({{"kind", problem.kind}, {"message", problem.message}, {"count", problem.count}});
    report["problems"] = problems;
    texture.fit = {report, texture.fit ? texture.fit->place : texture.extra.size()};
    refuse_other_payloads(texture);
    write_texture(output_, texture);

    Json out;
    out["format"] = "asperity-texture-fit";
    out["version"] = 1;
    out["file"] = output_;
    out["model"] = texture.model_name();
    if (texture.height_offset_m) out["lift_m"] = *texture.height_offset_m;
    out["fit"] = report;
    out["roughness"] = texture.roughness;
    out["units"] = units_json(units_);
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
    if (texture.height_offset_m) text += fmt::format(", height offset {:.4g} µm", *texture.height_offset_m * 1e6);
    text += "\n" + units_lines(units_);
    for (const auto& problem : fitted.problems) text += "note: " + problem.message + "\n";
    say(text);
  }

  std::vector<std::string> files_;
  std::string output_;
  std::string model_;
  std::string spacing_;
  std::string name_;
  bool whole_path_ = false;
  std::vector<FileUnits> units_;
  TextureFitSettings settings_;
};

}  // namespace

std::unique_ptr<Command> make_texture_fit(Parser& root) { return std::make_unique<TextureFitCommand>(root); }

}  // namespace asperity::app
