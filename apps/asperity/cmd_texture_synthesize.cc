#include <fmt/format.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/base/version.h"
#include "asperity/json/config_json.h"
#include "asperity/session/our_file.h"
#include "asperity/texture/evaluate_height.h"
#include "asperity/texture/format_height_image.h"
#include "asperity/texture/make_height_map.h"
#include "asperity/texture/sample_heights.h"
#include "asperity/texture/synthesize_stroke.h"
#include "asperity/texture/texture_file.h"
#include "asperity/texture/texture_operations.h"
#include "commands.h"
#include "option_units.h"

namespace asperity::app {

namespace {

constexpr const char* kLineColumns = "s_m,height_m\n";
constexpr const char* kStrokeColumns = "t_s,acceleration_mps2\n";

struct SynthesizeSettings {
  SampleHeightsConfig line;
  MakeHeightMapConfig tile;
  StrokeConfig stroke;

  template <class V>
  void visit(V& v) {
    v.group("line", line);
    v.group("tile", tile);
    v.group("stroke", stroke);
  }
};

class TextureSynthesizeCommand : public Command {
 public:
  explicit TextureSynthesizeCommand(Parser& root)
      : Command(
            root, "synthesize",
            "Write heights of a texture along a line, or accelerations of a force model (*.csv), or a tile (*.png)") {
    require(parser().add_option("TEXTURE", file_, "A *.texture.json"));
    require(parser().add_option("-o,--output", output_, "Output file; its ending states the format"))
        ->type_name("OUT.csv|OUT.png");
    parser().add_option("--length", length_, "Length of the line, or of the tile along x")->type_name("LENGTH");
    parser().add_option("--spacing", spacing_, "Distance of the line's heights")->type_name("LENGTH");
    seed_option_ =
        parser().add_option("--seed", seed_, "Random seed of the phases, where they are random")->type_name("N");
  }

  std::vector<ConfigField> fields() override { return list_fields("", settings_); }

  void apply_options() override {
    if (!length_.empty())
      settings_.line.length_mm = settings_.tile.length_mm = 1e3 * length_option_m("--length", length_);
    if (!spacing_.empty()) settings_.line.spacing_mm = 1e3 * length_option_m("--spacing", spacing_);
  }

  int run(const Observer& observer) override {
    reads(file_);
    Texture texture = read_texture(file_, {}, observer);
    if (seed_option_->count() > 0) reseed(texture);
    reads("");
    refuse_stranger(output_,
                    [](std::string_view begin) {
                      return begin.starts_with(kLineColumns) || begin.starts_with(kStrokeColumns) ||
                             begins_as_signed_png(begin);
                    },
                    {file_});
    Json out;
    out["format"] = "asperity-texture-synthesis";
    out["version"] = 1;
    out["texture"] = file_;
    out["file"] = output_;
    if (output_.ends_with(".csv") && !is_height_field(texture.model)) {
      write_stroke(texture, out);
    } else if (output_.ends_with(".csv")) {
      write_line(texture, out);
    } else if (output_.ends_with(".png")) {
      write_tile(texture, out);
    } else {
      throw UsageError("-o: the file of heights ends in .csv, that of a tile in .png");
    }
    out["config"] = config_json(fields());
    out["asperity"] = kVersion;
    print_json(out.dump_repaired(2));
    return kDone;
  }

 private:
  void reseed(Texture& texture) {
    if (seed_ < 0) throw UsageError("--seed: the value must not be negative");
    settings_.stroke.seed = seed_;
    if (!reseed_texture_model(texture.model, seed_)) throw UsageError("--seed: the texture is not random");
  }

  void write_line(const Texture& texture, Json& out) {
    const std::vector<double> height_m = sample_heights(texture.model, settings_.line);
    std::string text = kLineColumns;
    for (std::size_t i = 0; i < height_m.size(); ++i) {
      append_number(text, static_cast<double>(i) * settings_.line.spacing_mm * 1e-3);
      text += ',';
      append_number(text, height_m[i]);
      text += '\n';
    }
    write_file(output_, text);
    out["heights"] = height_m.size();
    say(fmt::format("{}: {} heights {:.6g} µm apart\n", output_, height_m.size(), 1e3 * settings_.line.spacing_mm));
  }

  void write_stroke(const Texture& texture, Json& out) {
    const std::vector<double> acceleration_mps2 = synthesize_stroke(texture, settings_.stroke);
    std::string text = kStrokeColumns;
    for (std::size_t i = 0; i < acceleration_mps2.size(); ++i) {
      append_number(text, static_cast<double>(i) / settings_.stroke.rate_Hz);
      text += ',';
      append_number(text, acceleration_mps2[i]);
      text += '\n';
    }
    write_file(output_, text);
    out["samples"] = acceleration_mps2.size();
    say(fmt::format("{}: {} accelerations at {:.6g} Hz\n", output_, acceleration_mps2.size(),
                    settings_.stroke.rate_Hz));
  }

  void write_tile(const Texture& texture, Json& out) {
    const HeightMapFit fit = make_height_map(texture.model, settings_.tile);
    const HeightMap& map = fit.texture;
    write_file(output_, signed_png(format_height_image(map)));
    out["columns"] = map.columns;
    out["rows"] = map.rows;
    out["bits"] = map.bits;
    out["mm_per_px"] = {map.mm_per_px_x, map.mm_per_px_y};
    out["low_m"] = map.low_m;
    out["high_m"] = map.high_m;
    out["quantisation_m"] = fit.quantisation_m;
    out["rms_error_m"] = fit.rms_error_m;
    say(fmt::format("{}: {} x {} pixels of {:.4g} mm, black {:.6g} µm, white {:.6g} µm\n", output_, map.columns,
                    map.rows, map.mm_per_px_x, map.low_m * 1e6, map.high_m * 1e6));
  }

  std::string file_;
  std::string output_;
  std::string length_;
  std::string spacing_;
  std::int64_t seed_ = 0;
  Option* seed_option_ = nullptr;
  SynthesizeSettings settings_;
};

}  // namespace

std::unique_ptr<Command> make_texture_synthesize(Parser& root) {
  return std::make_unique<TextureSynthesizeCommand>(root);
}

}  // namespace asperity::app
