#include <fmt/format.h>

#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "asperity/base/version.h"
#include "asperity/json/config_json.h"
#include "asperity/profile/measure_areal_roughness.h"
#include "asperity/profile/measure_roughness.h"
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
};

Json to_json(const std::vector<Parameter>& parameters) {
  Json out;
  for (const auto& [key, value, length] : parameters) out[key] = value;
  return out;
}

std::string to_table(const std::vector<Parameter>& parameters) {
  std::string out;
  for (const auto& [key, value, length] : parameters) {
    const std::string name = length ? std::string(key, std::string_view(key).size() - 2) : key;
    out +=
        length ? fmt::format("{:<6} {:12.5g} µm\n", name, value * 1e6) : fmt::format("{:<6} {:12.5g}\n", name, value);
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
    const RoughnessResult r = measure_roughness(profile.height_m, profile.spacing_m, settings_.profile);
    const std::vector<Parameter> parameters{
        {"Ra_m", r.Ra_m, true},       {"Rq_m", r.Rq_m, true},       {"Rz_m", r.Rz_m, true},
        {"Rt_m", r.Rt_m, true},       {"Rsk", r.Rsk, false},        {"Rku", r.Rku, false},
        {"RSm_m", r.RSm_m, true},     {"R5p_m", r.R5p_m, true},     {"R5v_m", r.R5v_m, true},
        {"R10z_m", r.R10z_m, true},   {"Rcm10_m", r.Rcm10_m, true}, {"Rcm50_m", r.Rcm50_m, true},
        {"Rcm90_m", r.Rcm90_m, true},
    };
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
