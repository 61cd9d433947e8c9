#include "roughness_of.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "area_heights.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/base/version.h"
#include "asperity/import/stroke_file.h"
#include "asperity/profile/estimate_texture_noise.h"
#include "asperity/profile/measure_roughness_under_noise.h"
#include "asperity/profile/rounding_floor.h"
#include "asperity/profile/setting_class.h"
#include "asperity/session/texture_input.h"
#include "command.h"
#include "roughness_figure.h"
#include "roughness_tables.h"
#include "stroke_input.h"
#include "units_json.h"

namespace asperity::app {

namespace {

namespace fs = std::filesystem;

// All of standard input, of at most as much as a file of heights may hold.
std::string read_standard_input() {
  constexpr std::size_t kLargest_bytes = std::size_t{512} << 20;
  std::string out;
  std::array<char, 65536> piece;
  while (true) {
    const ssize_t got = ::read(STDIN_FILENO, piece.data(), piece.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw Error("standard input cannot be read");
    if (got == 0) return out;
    out.append(piece.data(), static_cast<std::size_t>(got));
    if (out.size() > kLargest_bytes) throw Error("standard input: more than 512 MiB");
  }
}

class Measurement {
 public:
  Measurement(std::string file, const RoughnessSettings& settings, const Json& config, bool with_figure)
      : file_(std::move(file)), settings_(settings), config_(config), with_figure_(with_figure) {}

  RoughnessFound measure() const {
    Problems problems;
    HeightsOrigin origin;
    if (file_ == "-") {
      const Heights heights =
          parse_heights(read_standard_input(), "standard input", settings_.input, &problems, &origin);
      return with(of_heights(heights, origin), problems);
    }
    if (is_stroke_folder(file_)) {
      refuse_noise("a stroke");
      return of_stroke();
    }
    if (is_texture_file(file_)) {
      refuse_class();
      AreaHeights area = read_area_heights(file_, settings_.areal);
      if (settings_.noise.rms_um > 0.0) area.noise = stated_noise();
      origin.units.height = {1.0, UnitOrigin::kFile};
      origin.arithmetic_rms_m = arithmetic_rms_m(area.map.height_m);
      return of_map(area, origin);
    }
    std::error_code error;
    const fs::path profile = fs::path(file_) / "profile.csv";
    if (fs::is_directory(file_, error) && !fs::exists(profile, error))
      throw Error(printable(file_, 200) + ": is a folder without a profile.csv; name the file, or a result of process");
    const fs::path read = fs::is_directory(file_, error) ? profile : fs::path(file_);
    const Heights heights = read_heights(read, settings_.input, &problems, &origin);
    return with(of_heights(heights, origin), problems);
  }

 private:
  // What the file's own checksums show comes before its values.
  static RoughnessFound with(RoughnessFound found, const Problems& problems) {
    for (auto problem = problems.rbegin(); problem != problems.rend(); ++problem)
      found.text = "warning     " + printable(problem->message, 600) + "\n" + found.text;
    if (!problems.empty()) found.json["problems"] = Json::array();
    for (const Problem& problem : problems)
      found.json["problems"].push_back({{"kind", problem.kind}, {"message", printable(problem.message, 600)}});
    return found;
  }

  RoughnessFound of_heights(const Heights& heights, const HeightsOrigin& origin) const {
    if (const auto* profile = std::get_if<HeightProfile>(&heights)) {
      refuse_noise("a profile");
      return of_profile(*profile, origin);
    }
    refuse_class();
    return of_map({std::get<ArealMap>(heights), stated_noise()}, origin);
  }

  ArealNoise stated_noise() const {
    ArealNoise out;
    out.rms_m = 1e-6 * settings_.noise.rms_um;
    out.correlation_m = 1e-6 * settings_.noise.correlation_um;
    return out;
  }

  void refuse_noise(const char* kind) const {
    if (settings_.noise.rms_um > 0.0)
      throw UsageError("--noise: " + printable(file_, 200) + " is " + kind + "; --noise applies to areal maps only");
  }

  void refuse_class() const {
    if (settings_.filters != Filters::kAsGiven)
      throw UsageError("--class: " + printable(file_, 200) +
                       " is an areal map; setting classes apply to profiles only");
  }

  // The cut-offs and sections that the settings come to for this profile.
  RoughnessConfig filters_for(const HeightProfile& profile, std::string& name) const {
    if (settings_.filters == Filters::kAsGiven) return settings_.profile;
    const SettingClass& chosen =
        settings_.filters == Filters::kAuto
            ? choose_setting_class(profile.height_m, profile.spacing_m, settings_.profile)
            : kSettingClasses.at(static_cast<std::size_t>(settings_.filters) - static_cast<std::size_t>(Filters::kSc1));
    name = chosen.name;
    return with_setting_class(chosen, profile.height_m.size(), profile.spacing_m, settings_.profile);
  }

  // The standards' sections are as long as λc. "" where these are within a half of it.
  static std::string section_note(const RoughnessConfig& config, double section_mm) {
    constexpr double kFar = 1.5;
    const double ratio = section_mm / config.lambda_c_mm;
    if (ratio < kFar && ratio > 1.0 / kFar) return {};
    const double whole = std::clamp(std::floor(config.sections * ratio + 1e-6), 1.0, 1000.0);
    if (whole == config.sections) return {};
    return fmt::format(
        "            sections as long as λc, as in ISO 21920: --set roughness.sections={:.0f}; Rz, Rp, Rv and RSm "
        "depend "
        "on it\n",
        whole);
  }

  // What was filtered, in words: a value without it means little.
  static std::string filter_line(const HeightProfile& profile, const RoughnessConfig& config, const std::string& name) {
    const double cut_mm = config.ends == ProfileEnds::kCut ? config.lambda_c_mm : 0.0;
    const double section_mm = (1e3 * profile.spacing_m * static_cast<double>(profile.height_m.size()) - cut_mm) /
                              static_cast<double>(config.sections);
    std::string out = "filters     ";
    if (!name.empty()) out += name + ": ";
    out += config.lambda_s_mm > 0.0 ? fmt::format("λs {:g} µm, ", 1e3 * config.lambda_s_mm) : std::string("no λs, ");
    out += config.lambda_c_mm > 0.0 ? fmt::format("λc {:g} mm, ", config.lambda_c_mm) +
                                          (config.filter == ProfileFilter::kRobust ? "robust " : "") + "Gaussian"
                                    : std::string("no λc");
    if (config.lambda_c_mm > 0.0 && config.lambda_f_mm > 0.0) out += fmt::format(", λf {:g} mm", config.lambda_f_mm);
    if (cut_mm > 0.0) out += fmt::format(", {:g} mm left out at each end", 0.5 * cut_mm);
    out += fmt::format("; {} sections of {:.4g} mm\n", config.sections, section_mm);
    if (config.lambda_c_mm > 0.0) return out + section_note(config, section_mm);
    return out +
           (profile.column == "texture_m"
                ? "            the column texture_m is already high-passed\n"
                : "            values of the profile as it is in the file, waviness included; for roughness as in "
                  "ISO 21920 use --class auto\n");
  }

  static std::string note_line(const std::string& note) { return note.empty() ? note : "note        " + note + "\n"; }

  static Json notes_json(const std::string& note) {
    Json out = Json::array();
    if (!note.empty()) out.push_back(note);
    return out;
  }

  static std::string noise_line(const ArealNoise& noise) {
    if (!noise.is_known()) return "intervals   not determined: the file does not state its noise; give --noise\n";
    return fmt::format("noise       {:.3g} µm RMS, {}\n", 1e6 * noise.rms_m,
                       noise.correlation_m > 0.0
                           ? fmt::format("correlated by 0.2 at {:.3g} µm", 1e6 * noise.correlation_m)
                           : std::string("independent from height to height"));
  }

  RoughnessFound of_profile(const HeightProfile& profile, const HeightsOrigin& origin) const {
    std::string class_name;
    const RoughnessConfig config = filters_for(profile, class_name);
    constexpr double kCutoff_cycles_per_mm = 0.1;  // of a profile.csv's texture, unless somebody has changed it
    const TextureNoise noise =
        noise_of_sigma(profile.height_m, profile.sigma_m, profile.spacing_m, kCutoff_cycles_per_mm);
    // The file's heights as they are: what noise could have added is in the error, not taken off.
    RoughnessResult r = measure_roughness(profile.height_m, profile.spacing_m, config);
    const std::string rounding = apply_rounding_floor(origin, r);
    const RoughnessResult cleaned = measure_roughness_under_noise(profile.height_m, profile.spacing_m, noise, config);
    std::vector<PrintedParameter> parameters;
    for (const RoughnessParameter& p : kRoughnessParameters) {
      const double error = std::hypot(cleaned.standard_error.*p.value, cleaned.*p.value - r.*p.value);
      parameters.push_back({std::string(p.key), r.*p.value, p.is_length, error});
    }
    ProfileTexture texture =
        measure_profile_texture(profile.height_m, profile.spacing_m, config, settings_.material, noise);
    apply_rounding_floor(origin, texture);
    Json out = begin("profile");
    out["units"] = units_json(origin.units);
    out["notes"] = notes_json(rounding);
    out["filters"] = {{"setting_class", class_name.empty() ? Json(nullptr) : Json(class_name)},
                      {"lambda_s_mm", config.lambda_s_mm > 0.0 ? Json(config.lambda_s_mm) : Json(nullptr)},
                      {"lambda_c_mm", config.lambda_c_mm > 0.0 ? Json(config.lambda_c_mm) : Json(nullptr)},
                      {"lambda_f_mm", config.lambda_f_mm > 0.0 ? Json(config.lambda_f_mm) : Json(nullptr)},
                      {"filter", kProfileFilterNames.at(static_cast<std::size_t>(config.filter))},
                      {"ends", kProfileEndsNames.at(static_cast<std::size_t>(config.ends))},
                      {"sections", config.sections}};
    out["length_m"] = r.length_m;
    out["spacing_m"] = profile.spacing_m;
    out["samples"] = r.samples;
    out["missing"] = r.missing;
    out["sections_used"] = r.sections_used;
    out["elements"] = r.elements;
    out["roughness"] = to_json(parameters);
    out["profiles"] = to_json(texture);
    return found(
        std::move(out),
        fmt::format("{:.6g} mm, {} heights {:.6g} µm apart, {} missing\n", r.length_m * 1e3, r.samples,
                    profile.spacing_m * 1e6, r.missing) +
            "units       " + units_text(origin.units) + "\n" + note_line(rounding) +
            filter_line(profile, config, class_name) +
            (noise.added_rms_m > 0.0 ? "" : "intervals   not determined: the file does not state its noise\n") +
            to_table(parameters) + "\n" + to_table(texture),
        with_figure_ ? profile_figure(profile, config) : Figure{});
  }

  RoughnessFound of_map(const AreaHeights& heights, const HeightsOrigin& origin) const {
    const ArealMap& map = heights.map;
    const ArealTextureConfig& config = settings_.areal;
    ArealTextureResult r = measure_areal_texture(map, config, heights.noise);
    const std::string rounding = apply_rounding_floor(origin, r);
    if (!rounding.empty()) r.standard_error = {};
    Json out = begin("areal");
    out["units"] = units_json(origin.units);
    out["notes"] = notes_json(rounding);
    out["columns"] = map.columns;
    out["rows"] = map.rows;
    out["x_spacing_m"] = map.x_spacing_m;
    out["y_spacing_m"] = map.y_spacing_m;
    out["missing"] = r.missing;
    out["filters"] = {{"form", kArealFormNames.at(static_cast<std::size_t>(config.form))},
                      {"lambda_s_mm", config.lambda_s_mm > 0.0 ? Json(config.lambda_s_mm) : Json(nullptr)},
                      {"lambda_c_mm", config.lambda_c_mm > 0.0 ? Json(config.lambda_c_mm) : Json(nullptr)},
                      {"l_filter", kArealFilterNames.at(static_cast<std::size_t>(config.filter))}};
    out["noise_rms_m"] = heights.noise.is_known() ? Json(heights.noise.rms_m) : Json(nullptr);
    out["noise_correlation_m"] = heights.noise.is_known() ? Json(heights.noise.correlation_m) : Json(nullptr);
    out["slope_x"] = r.slope_x;
    out["slope_y"] = r.slope_y;
    out["roughness"] = to_json(r);
    std::string filters = fmt::format("filters     F {}", kArealFormNames.at(static_cast<std::size_t>(config.form)));
    filters += config.lambda_s_mm > 0.0 ? fmt::format(", S {:g} µm", 1e3 * config.lambda_s_mm) : ", no S";
    filters += config.lambda_c_mm > 0.0 ? fmt::format(", L {:g} mm, {}Gaussian\n", config.lambda_c_mm,
                                                      config.filter == ArealFilter::kRobust ? "robust " : "")
                                        : std::string(", no L: waviness is included\n");
    return found(std::move(out),
                 fmt::format("{} x {} heights {:.6g} x {:.6g} µm apart, {} missing\n", map.columns, map.rows,
                             map.x_spacing_m * 1e6, map.y_spacing_m * 1e6, r.missing) +
                     "units       " + units_text(origin.units) + "\n" + note_line(rounding) + filters +
                     noise_line(heights.noise) + to_table(r),
                 with_figure_ ? map_figure(map, config) : Figure{});
  }

  // Of an acceleration there are no heights along a line: the RMS height of each octave.
  RoughnessFound of_stroke() const {
    const Stroke stroke = read_valid_stroke(file_);
    Json out = begin("stroke");
    out["not_determined"] = stroke_unknowns(stroke);
    out["spectrum"] = stroke_heights_json(stroke);
    return found(std::move(out), stroke_text(stroke) + stroke_heights_text(stroke), {});
  }

  Json begin(const char* kind) const {
    Json out;
    out["format"] = "asperity-roughness";
    out["version"] = 1;
    out["file"] = file_;
    out["kind"] = kind;
    return out;
  }

  RoughnessFound found(Json out, std::string text, Figure figure) const {
    out["config"] = config_;
    out["asperity"] = kVersion;
    figure.title = printable(file_, 100);
    return {file_, std::move(out), std::move(text), std::move(figure)};
  }

  std::string file_;
  const RoughnessSettings& settings_;
  const Json& config_;
  bool with_figure_;
};

}  // namespace

RoughnessFound measure_file(const std::string& file, const RoughnessSettings& settings, const Json& config,
                            bool with_figure) {
  return Measurement(file, settings, config, with_figure).measure();
}

}  // namespace asperity::app
