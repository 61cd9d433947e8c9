#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "area_heights.h"
#include "asperity/base/nan.h"
#include "asperity/base/text.h"
#include "asperity/base/version.h"
#include "asperity/import/stroke_file.h"
#include "asperity/json/config_json.h"
#include "asperity/profile/estimate_texture_noise.h"
#include "asperity/profile/measure_areal_texture.h"
#include "asperity/profile/measure_profile_texture.h"
#include "asperity/profile/measure_roughness_under_noise.h"
#include "asperity/profile/read_heights.h"
#include "asperity/profile/setting_class.h"
#include "commands.h"
#include "option_units.h"
#include "roughness_tables.h"
#include "stroke_input.h"
#include "texture_input.h"

namespace asperity::app {

namespace {

enum class Filters { kAsGiven, kAuto, kSc1, kSc2, kSc3, kSc4, kSc5 };
constexpr std::array<std::string_view, 7> kFiltersNames{"as_given", "auto", "Sc1", "Sc2", "Sc3", "Sc4", "Sc5"};

// Of a map whose file states no errors.
struct NoiseSettings {
  double rms_um = 0.0;
  double correlation_um = 0.0;

  template <class V>
  void visit(V& v) {
    v.field("rms_um", rms_um, "of the heights of an areal map, one standard deviation; 0: not known", {0.0, 1e6});
    v.field("correlation_um", correlation_um,
            "distance at which that noise is correlated by 0.2; 0: each height has its own", {0.0, 1e6});
  }
};

struct RoughnessSettings {
  ReadHeightsConfig input;
  Filters filters = Filters::kAsGiven;
  RoughnessConfig profile;
  MaterialRatioConfig material;
  ArealTextureConfig areal;
  NoiseSettings noise;

  template <class V>
  void visit(V& v) {
    v.group("input", input);
    v.choice("setting_class", filters, kFiltersNames,
             "cut-offs and sections: as given by roughness.*, of a setting class, or of that which the Ra calls for");
    v.group("roughness", profile);
    v.group("material", material);
    v.group("areal", areal);
    v.group("noise", noise);
  }
};

class RoughnessCommand : public Command {
 public:
  explicit RoughnessCommand(Parser& root)
      : Command(root, "roughness", "Roughness of a profile (ISO 21920-2) or an areal map (ISO 25178-2)") {
    require(parser().add_option(
        "FILE", file_,
        "profile.csv, heights one a line, x_mm,y_mm,z_um, a GSF, SDF, SUR or X3P file, or a stroke's "
        "folder (import --stroke: its spectrum), or an areal *.texture.json"));
    parser()
        .add_option("--spacing", spacing_, "Distance of the heights, for a file without positions")
        ->type_name("LENGTH");
    parser().add_option("--lambda-s", lambda_s_, "Shorter waves are left out (S-filter of a map)")->type_name("LENGTH");
    parser()
        .add_option("--lambda-c", lambda_c_, "Longer waves are left out of R, and make W (L-filter of a map)")
        ->type_name("LENGTH");
    parser().add_option("--lambda-f", lambda_f_, "Longer waves are left out of W")->type_name("LENGTH");
    parser()
        .add_option("--filter", filter_,
                    "gaussian (ISO 16610-21, of maps 16610-61), or robust (16610-31, 16610-71) for deep pits")
        ->type_name("NAME");
    parser()
        .add_option("--noise", noise_, "Standard deviation of a map's heights, by the instrument: gives intervals")
        ->type_name("LENGTH");
    parser()
        .add_option("--class", class_, "Setting class: Sc1 to Sc5 (λc 0.08, 0.25, 0.8, 2.5, 8 mm), or auto")
        ->type_name("CLASS");
  }

  std::vector<ConfigField> fields() override { return list_fields("", settings_); }

  void apply_options() override {
    if (!spacing_.empty()) settings_.input.spacing_m = length_option_m("--spacing", spacing_);
    if (!lambda_s_.empty())
      settings_.profile.lambda_s_mm = settings_.areal.lambda_s_mm = 1e3 * length_option_m("--lambda-s", lambda_s_);
    if (!lambda_c_.empty())
      settings_.profile.lambda_c_mm = settings_.areal.lambda_c_mm = 1e3 * length_option_m("--lambda-c", lambda_c_);
    if (!lambda_f_.empty()) settings_.profile.lambda_f_mm = 1e3 * length_option_m("--lambda-f", lambda_f_);
    if (!noise_.empty()) settings_.noise.rms_um = 1e6 * length_option_m("--noise", noise_);
    set_choice("--filter", "roughness.filter", filter_);
    set_choice("--filter", "areal.filter", filter_);
    set_choice("--class", "setting_class", class_);
  }

  int run(const Observer&) override {
    reads(file_);
    if (is_stroke_folder(file_)) {
      refuse_noise("a stroke");
      report_stroke();
      return kDone;
    }
    if (is_texture_file(file_)) {
      refuse_class();
      AreaHeights area = read_area_heights(file_, settings_.areal);
      if (settings_.noise.rms_um > 0.0) area.noise = stated_noise();
      report_map(std::move(area));
      return kDone;
    }
    const Heights heights = read_heights(file_, settings_.input);
    if (const auto* profile = std::get_if<HeightProfile>(&heights)) {
      refuse_noise("a profile");
      report_profile(*profile);
    } else {
      refuse_class();
      report_map({std::get<ArealMap>(heights), stated_noise()});
    }
    return kDone;
  }

 private:
  ArealNoise stated_noise() const {
    ArealNoise out;
    out.rms_m = 1e-6 * settings_.noise.rms_um;
    out.correlation_m = 1e-6 * settings_.noise.correlation_um;
    return out;
  }

  void refuse_noise(const char* kind) const {
    if (settings_.noise.rms_um > 0.0)
      throw UsageError("--noise: " + printable(file_, 200) + " is " + kind + "; the noise is stated for areal maps");
  }

  void refuse_class() const {
    if (settings_.filters != Filters::kAsGiven)
      throw UsageError("--class: " + printable(file_, 200) + " is an areal map; setting classes are of profiles");
  }

  void set_choice(const char* option, const char* field, const std::string& value) {
    if (value.empty()) return;
    try {
      set_field(fields(), field, value);
    } catch (const Error& error) {
      throw UsageError(std::string(option) + ": " + error.what());
    }
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
    if (cut_mm > 0.0) out += fmt::format(", {:g} mm left out at either end", 0.5 * cut_mm);
    out += fmt::format("; {} sections of {:.4g} mm\n", config.sections, section_mm);
    if (config.lambda_c_mm > 0.0) return out;
    return out +
           (profile.column == "texture_m"
                ? "            the column texture_m is already high-passed\n"
                : "            values of the profile as it is in the file, waviness included; for roughness as in "
                  "ISO 21920 use --class auto\n");
  }

  void report_profile(const HeightProfile& profile) {
    std::string class_name;
    const RoughnessConfig config = filters_for(profile, class_name);
    constexpr double kCutoff_cycles_per_mm = 0.1;  // of a profile.csv's texture, unless somebody has changed it
    const TextureNoise noise =
        noise_of_sigma(profile.height_m, profile.sigma_m, profile.spacing_m, kCutoff_cycles_per_mm);
    // The file's heights as they are: what noise could have added is in the error, not taken off.
    const RoughnessResult r = measure_roughness(profile.height_m, profile.spacing_m, config);
    const RoughnessResult cleaned = measure_roughness_under_noise(profile.height_m, profile.spacing_m, noise, config);
    std::vector<PrintedParameter> parameters;
    for (const RoughnessParameter& p : kRoughnessParameters) {
      const double error = std::hypot(cleaned.standard_error.*p.value, cleaned.*p.value - r.*p.value);
      parameters.push_back({std::string(p.key), r.*p.value, p.is_length, error});
    }
    const ProfileTexture texture =
        measure_profile_texture(profile.height_m, profile.spacing_m, config, settings_.material, noise);
    Json out = begin("profile");
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
    finish(out);
    say(fmt::format("{:.6g} mm, {} heights {:.6g} µm apart, {} missing\n", r.length_m * 1e3, r.samples,
                    profile.spacing_m * 1e6, r.missing) +
        filter_line(profile, config, class_name) +
        (noise.added_rms_m > 0.0 ? "" : "intervals   not determined: the file does not state its noise\n") +
        to_table(parameters) + "\n" + to_table(texture));
  }

  void report_map(const AreaHeights& heights) {
    const ArealMap& map = heights.map;
    const ArealTextureConfig& config = settings_.areal;
    const ArealTextureResult r = measure_areal_texture(map, config, heights.noise);
    Json out = begin("areal");
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
    finish(out);
    std::string filters = fmt::format("filters     F {}", kArealFormNames.at(static_cast<std::size_t>(config.form)));
    filters += config.lambda_s_mm > 0.0 ? fmt::format(", S {:g} µm", 1e3 * config.lambda_s_mm) : ", no S";
    filters += config.lambda_c_mm > 0.0 ? fmt::format(", L {:g} mm, {}Gaussian\n", config.lambda_c_mm,
                                                      config.filter == ArealFilter::kRobust ? "robust " : "")
                                        : std::string(", no L: waviness is included\n");
    say(fmt::format("{} x {} heights {:.6g} x {:.6g} µm apart, {} missing\n", map.columns, map.rows,
                    map.x_spacing_m * 1e6, map.y_spacing_m * 1e6, r.missing) +
        filters + noise_line(heights.noise) + to_table(r));
  }

  static std::string noise_line(const ArealNoise& noise) {
    if (!noise.is_known()) return "intervals   not determined: the file does not state its noise; state it: --noise\n";
    return fmt::format("noise       {:.3g} µm RMS, {}\n", 1e6 * noise.rms_m,
                       noise.correlation_m > 0.0
                           ? fmt::format("correlated by 0.2 at {:.3g} µm", 1e6 * noise.correlation_m)
                           : std::string("independent from height to height"));
  }

  // Of an acceleration there are no heights along a line: the RMS height of each octave.
  void report_stroke() {
    const Stroke stroke = read_valid_stroke(file_);
    Json out = begin("stroke");
    out["not_determined"] = stroke_unknowns(stroke);
    out["spectrum"] = stroke_heights_json(stroke);
    finish(out);
    say(stroke_text(stroke) + stroke_heights_text(stroke));
  }

  Json begin(const char* kind) const {
    Json out;
    out["format"] = "asperity-roughness";
    out["version"] = 1;
    out["file"] = file_;
    out["kind"] = kind;
    return out;
  }

  void finish(Json& out) {
    out["config"] = config_json(fields());
    out["asperity"] = kVersion;
    print_json(out.dump_repaired(2));
  }

  std::string file_;
  std::string spacing_;
  std::string class_;
  std::string noise_;
  std::string lambda_s_;
  std::string lambda_c_;
  std::string lambda_f_;
  std::string filter_;
  RoughnessSettings settings_;
};

}  // namespace

std::unique_ptr<Command> make_roughness(Parser& root) { return std::make_unique<RoughnessCommand>(root); }

}  // namespace asperity::app
