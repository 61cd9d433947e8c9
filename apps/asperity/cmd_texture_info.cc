#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "asperity/base/text.h"
#include "asperity/base/version.h"
#include "asperity/json/json.h"
#include "asperity/session/texture_input.h"
#include "asperity/texture/evaluate_height.h"
#include "asperity/texture/sample_heights.h"
#include "asperity/texture/texture_file.h"
#include "asperity/texture/texture_operations.h"
#include "commands.h"
#include "texture_lines.h"

namespace asperity::app {

namespace {

constexpr double kLine_m = 0.04;
constexpr double kSpacing_m = 25e-6;

std::string value_text(const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

class TextureInfoCommand : public Command {
 public:
  explicit TextureInfoCommand(Parser& root) : Command(root, "info", "Describe a texture and its roughness") {
    require(parser().add_option("TEXTURE", file_, "A *.texture.json"));
  }

  int run(const Observer& observer) override {
    reads(file_);
    const Texture texture = read_texture(file_, {}, observer);
    Json out;
    out["format"] = "asperity-texture-info";
    out["version"] = 1;
    out["file"] = file_;
    out["name"] = texture.name;
    out["model"] = texture.model_name();
    out["describe"] = describe_texture_model(texture.model);
    if (is_height_field(texture.model)) {
      const auto period = period_m(texture.model);
      out["period_m"] = period ? Json(*period) : Json(nullptr);
      out["lowest_m"] = lowest_height_m(texture.model);
      out["measured"] = roughness_of(sample_lines(texture.model, kLine_m, kSpacing_m), kSpacing_m);
    }
    if (texture.height_offset_m) out["lift_m"] = *texture.height_offset_m;
    if (texture.band_cycles_per_mm) out["band_cycles_per_mm"] = *texture.band_cycles_per_mm;
    if (texture.compliance_kc) out["compliance_kc"] = *texture.compliance_kc;
    if (texture.stiffness_N_per_m) out["stiffness_N_per_m"] = *texture.stiffness_N_per_m;
    if (texture.friction) out["friction"] = *texture.friction;
    if (texture.static_friction_ratio) out["static_friction_ratio"] = *texture.static_friction_ratio;
    out["source_roughness"] = texture.roughness;
    if (texture.fit) out["fit"] = texture.fit->metrics;
    out["asperity"] = kVersion;
    print_json(out.dump_repaired(2));
    say_summary(out);
    return kDone;
  }

 private:
  void say_summary(const Json& out) const {
    std::string text = fmt::format("{}: {}\n", printable(value_text(out["name"])), value_text(out["model"]));
    for (const auto& [key, value] : out["describe"].items()) text += texture_line(key, value);
    if (out.contains("measured")) {
      for (const char* key : {"Ra_m", "Rq_m", "Rt_m", "RSm_m"})
        if (out["measured"].contains(key)) text += texture_line(key, out["measured"][key]);
    }
    for (const char* key :
         {"lift_m", "band_cycles_per_mm", "compliance_kc", "stiffness_N_per_m", "friction", "static_friction_ratio"}) {
      if (out.contains(key)) text += texture_line(key, out[key]);
    }
    if (out.contains("fit") && out["fit"].is_object() && out["fit"].contains("rms_error_m"))
      text += texture_line("rms_error_m", out["fit"]["rms_error_m"]);
    say(text);
  }

  std::string file_;
};

}  // namespace

std::unique_ptr<Command> make_texture_info(Parser& root) { return std::make_unique<TextureInfoCommand>(root); }

}  // namespace asperity::app
