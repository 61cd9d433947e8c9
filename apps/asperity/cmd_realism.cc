#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "asperity/base/folder_content.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/base/version.h"
#include "asperity/json/config_json.h"
#include "asperity/recording/fingerprint.h"
#include "asperity/recording/read_recording.h"
#include "asperity/session/our_folder.h"
#include "asperity/session/register_input.h"
#include "asperity/session/rendered_input.h"
#include "commands.h"
#include "option_units.h"

namespace asperity::app {

namespace {

namespace fs = std::filesystem;

struct RealismSettings {
  RealismConfig compare;
  RenderConfig render;
  ProcessConfig process;

  template <class V>
  void visit(V& v) {
    v.group("compare", compare);
    v.field("stiffness_N_per_m", render.stiffness_N_per_m, "where the rendered surface states none, N/m", {1.0, 1e6});
    v.field("friction", render.friction, "coefficient where the rendered surface states none", {0.0, 10.0});
    v.group("process", process);
  }
};

class RealismCommand : public Command {
 public:
  explicit RealismCommand(Parser& root)
      : Command(root, "realism", "Compare a stroke that was held back with a texture or scene made of other strokes") {
    require(parser().add_option("RENDERED", rendered_,
                                "A *.texture.json, a folder that process or merge has written (its whole profile), a "
                                "scene.json or its folder"));
    require(parser().add_option("--stroke", stroke_, "The recording that is held back"))->type_name("REC");
    parser()
        .add_option("--with", others_, "Other recordings over the same line: their agreement is the ceiling")
        ->type_name("REC");
    parser().add_flag("--allow-own", allow_own_,
                      "Allow a stroke that RENDERED was made from: a self-test, not a comparison");
    parser()
        .add_option("--stiffness", stiffness_, "Stiffness where RENDERED states none, N/m; default: 1000")
        ->type_name("K");
    parser().add_option("--friction", friction_, "Coefficient where RENDERED states none; default: 0")->type_name("MU");
    parser().add_option("-o,--output", output_, "Folder of result.json")->type_name("OUT");
  }

  std::vector<ConfigField> fields() override { return list_fields("", settings_); }

  void apply_options() override {
    if (!stiffness_.empty())
      settings_.render.stiffness_N_per_m = number_option("--stiffness", stiffness_, "N/m", 1.0, 1e6);
    if (!friction_.empty()) settings_.render.friction = number_option("--friction", friction_, "", 0.0, 10.0);
  }

  int run(const Observer& observer) override {
    std::optional<OutputFolder> folder;
    if (!output_.empty()) folder.emplace(output_, naming_added(is_our_folder));
    reads(rendered_);
    const RenderedInput input = read_rendered(rendered_, observer);
    reads(stroke_);
    const Recording held = read_recording(stroke_, {}, observer);
    const StrokeSource own = source_of(stroke_, held, last_part(stroke_));
    const bool is_own = is_among(input.sources, own);
    if (is_own && !allow_own_) {
      throw Error("--stroke " + printable(stroke_, 200) + ": " + printable(rendered_, 200) +
                  " was made from this recording or a part of it; give a stroke that was held back, or use --allow-own "
                  "for a self-test");
    }
    const RealStroke stroke = measure_real_stroke(stroke_, held, input, settings_.process, observer);
    std::vector<RealStroke> others;
    std::vector<NamedFingerprint> measured{{stroke_, own.fingerprint}};
    for (const std::string& other : others_) {
      reads(other);
      const Recording recording = read_recording(other, {}, observer);
      measured.push_back({other, fingerprint_of(recording)});
      check_independent(measured);
      others.push_back(measure_real_stroke(other, recording, input, settings_.process, observer));
    }
    reads(rendered_);
    RenderedRelief relief = relief_under(input, stroke, settings_.render);
    reads("");
    relief.is_own = is_own;
    const RealismScore score = score_realism(relief, stroke, others, settings_.compare, observer);

    Json out;
    out["format"] = "asperity-realism";
    out["version"] = 1;
    out["rendered"] = rendered_;
    out["stroke"] = {{"name", own.name}, {"checksum", own.checksum}};
    out["made_from"] = Json::array();
    for (const StrokeSource& source : input.sources)
      out["made_from"].push_back({{"name", source.name}, {"checksum", source.checksum}});
    out["self_test"] = is_own;
    out.update(realism_json(score));
    out["config"] = config_json(fields());
    out["asperity"] = kVersion;
    const std::string json = out.dump_repaired(2);
    if (folder) {
      write_file(folder->path() / "result.json", json + "\n");
      write_listing(folder->path());
      folder->commit();
    }
    print_json(json);
    say(realism_text(score));
    if (folder) say("result in " + printable(output_, 200) + "\n");
    for (const Verdict& verdict : score.verdicts) {
      if (verdict.severity == Severity::kInvalid || !quiet()) print_error(verdict_line(verdict));
    }
    return score.trustworthy ? kDone : kNotTrustworthy;
  }

 private:
  // The last part of a path, that of "rec/" included.
  static std::string last_part(const std::string& path) {
    fs::path whole = fs::absolute(path).lexically_normal();
    if (!whole.has_filename()) whole = whole.parent_path();
    return whole.filename().string();
  }

  std::string rendered_, stroke_, stiffness_, friction_, output_;
  std::vector<std::string> others_;
  bool allow_own_ = false;
  RealismSettings settings_;
};

}  // namespace

std::unique_ptr<Command> make_realism(Parser& root) { return std::make_unique<RealismCommand>(root); }

}  // namespace asperity::app
