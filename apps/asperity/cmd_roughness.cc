#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "asperity/base/nan.h"
#include "asperity/base/version.h"
#include "asperity/json/config_json.h"
#include "asperity/profile/estimate_texture_noise.h"
#include "asperity/profile/measure_areal_roughness.h"
#include "asperity/profile/measure_roughness_under_noise.h"
#include "asperity/profile/read_heights.h"
#include "commands.h"
#include "option_units.h"

namespace asperity::app {

namespace {

struct RoughnessSettings {
  ReadHeightsConfig input;
  RoughnessConfig profile;
  ArealRoughnessConfig areal;

  template <class V>
  void visit(V& v) {
    v.group("input", input);
    v.group("roughness", profile);
    v.group("areal", areal);
  }
};

// One parameter as it is printed: name, value and the text for a person.
struct Parameter {
  const char* key;
  double value;
  bool length;
  double error = kNan;  // standard error, where it is known
};

Json to_json(const std::vector<Parameter>& parameters) {
  Json out;
  for (const auto& [key, value, length, error] : parameters) {
    out[key] = value;
    if (!std::isfinite(error)) continue;
    const std::string name(key, std::string_view(key).size() - (length ? 2 : 0));
    out[name + (length ? "_stderr_m" : "_stderr")] = error;
  }
  return out;
}

std::string to_table(const std::vector<Parameter>& parameters) {
  std::string out;
  for (const auto& [key, value, length, error] : parameters) {
    const std::string name(key, std::string_view(key).size() - (length ? 2 : 0));
    const double unit = length ? 1e6 : 1.0;
    out += fmt::format("{:<6} ", name);
    out += std::isfinite(unit * value) ? fmt::format("{:12.5g}", unit * value) : "not determined";
    if (std::isfinite(value) && std::isfinite(error)) out += fmt::format(" ± {:.2g}", unit * error);
    out += length && std::isfinite(unit * value) ? " µm\n" : "\n";
  }
  return out;
}

class RoughnessCommand : public Command {
 public:
  explicit RoughnessCommand(Parser& root)
      : Command(root, "roughness", "Roughness of a profile (ISO 21920-2) or an areal map (ISO 25178-2)") {
    require(parser().add_option("FILE", file_, "profile.csv, heights one a line, or x_mm,y_mm,z_um"));
    parser()
        .add_option("--spacing", spacing_, "Distance of the heights, for a file without positions")
        ->type_name("LENGTH");
  }

  std::vector<ConfigField> fields() override { return list_fields("", settings_); }

  void apply_options() override {
    if (!spacing_.empty()) settings_.input.spacing_m = length_option_m("--spacing", spacing_);
  }

  int run(const Observer&) override {
    reads(file_);
    const Heights heights = read_heights(file_, settings_.input);
    if (const auto* profile = std::get_if<HeightProfile>(&heights)) {
      report_profile(*profile);
    } else {
      report_map(std::get<ArealMap>(heights));
    }
    return kDone;
  }

 private:
  void report_profile(const HeightProfile& profile) {
    constexpr double kCutoff_cycles_per_mm = 0.1;  // of a profile.csv's texture, unless somebody has changed it
    const TextureNoise noise =
        noise_of_sigma(profile.height_m, profile.sigma_m, profile.spacing_m, kCutoff_cycles_per_mm);
    // The file's heights as they are: what noise could have added is in the error, not taken off.
    const RoughnessResult r = measure_roughness(profile.height_m, profile.spacing_m, settings_.profile);
    const RoughnessResult cleaned =
        measure_roughness_under_noise(profile.height_m, profile.spacing_m, noise, settings_.profile);
    std::vector<Parameter> parameters;
    for (const RoughnessParameter& p : kRoughnessParameters) {
      const double error = std::hypot(cleaned.standard_error.*p.value, cleaned.*p.value - r.*p.value);
      parameters.push_back({p.key.data(), r.*p.value, p.is_length, error});
    }
    Json out = begin("profile");
    out["length_m"] = r.length_m;
    out["spacing_m"] = profile.spacing_m;
    out["samples"] = r.samples;
    out["missing"] = r.missing;
    out["sections_used"] = r.sections_used;
    out["elements"] = r.elements;
    out["roughness"] = to_json(parameters);
    finish(out);
    say(fmt::format("{:.6g} mm, {} heights {:.6g} µm apart, {} missing\n", r.length_m * 1e3, r.samples,
                    profile.spacing_m * 1e6, r.missing) +
        to_table(parameters));
  }

  void report_map(const ArealMap& map) {
    const ArealRoughnessResult r = measure_areal_roughness(map, settings_.areal);
    const std::vector<Parameter> parameters{{"Sa_m", r.Sa_m, true}, {"Sq_m", r.Sq_m, true}, {"Sz_m", r.Sz_m, true},
                                            {"Sp_m", r.Sp_m, true}, {"Sv_m", r.Sv_m, true}, {"Ssk", r.Ssk, false},
                                            {"Sku", r.Sku, false}};
    Json out = begin("areal");
    out["columns"] = map.columns;
    out["rows"] = map.rows;
    out["x_spacing_m"] = map.x_spacing_m;
    out["y_spacing_m"] = map.y_spacing_m;
    out["missing"] = r.missing;
    out["slope_x"] = r.slope_x;
    out["slope_y"] = r.slope_y;
    out["roughness"] = to_json(parameters);
    finish(out);
    say(fmt::format("{} x {} heights, {} missing\n", map.columns, map.rows, r.missing) + to_table(parameters));
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
  RoughnessSettings settings_;
};

}  // namespace

std::unique_ptr<Command> make_roughness(Parser& root) { return std::make_unique<RoughnessCommand>(root); }

}  // namespace asperity::app
