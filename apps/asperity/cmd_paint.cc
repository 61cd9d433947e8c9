#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "asperity/base/folder_content.h"
#include "asperity/base/length_unit_names.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/base/version.h"
#include "asperity/json/config_json.h"
#include "asperity/pipeline/earlier_scene.h"
#include "asperity/scene/paint.h"
#include "asperity/scene/set_mesh_unit.h"
#include "asperity/session/our_folder.h"
#include "asperity/session/paint_scene.h"
#include "asperity/session/scene_folder.h"
#include "commands.h"
#include "option_units.h"

namespace asperity::app {

namespace {

namespace fs = std::filesystem;
struct PaintSettings {
  HapticCoordinatesConfig coordinates;

  template <class V>
  void visit(V& v) {
    v.group("coordinates", coordinates);
  }
};

class PaintCommand : public Command {
 public:
  explicit PaintCommand(Parser& root)
      : Command(root, "paint", "Lay a texture on a mesh along a path through picked points") {
    Option* mesh =
        parser().add_option("MESH", mesh_, "A mesh (.obj .ply .stl .off .gltf .glb) or a scene.json to paint on");
    Option* into =
        parser()
            .add_option("--into", into_,
                        "Scene of an earlier registration or painting to paint into; its other content is kept")
            ->type_name("scene.json")
            ->excludes(mesh);
    require(parser().add_option(
                "--through", through_,
                "Points x,y,z;x,y,z;… near the surface, in the mesh's frame: in the mesh's unit if --mesh-unit is "
                "given, else in metres"))
        ->type_name("POINTS");
    require(parser().add_option("--texture", texture_, "Texture to paint with, a *.texture.json"))->type_name("FILE");
    parser()
        .add_option("-o,--output", output_, "Folder of the scene (required without --into)")
        ->type_name("OUT")
        ->excludes(into);
    parser().add_flag("--under", under_, "Lay the texture under those that the scene has, not over them");
    parser()
        .add_option("--mesh-unit", mesh_unit_, "Length of the mesh's unit: m (the default), mm, cm, or such as 0.06m")
        ->type_name("LENGTH")
        ->suggest(length_unit_names());
    parser().add_option("--rings", rings_, "Number of rings of triangles around those under the path")->type_name("N");
    parser()
        .add_option("--width", width_, "Width of the stroke around its middle line, instead of rings")
        ->type_name("LENGTH");
    parser().add_option("--index", index_, "Index of the texture; default: the next free one")->type_name("N");
  }

  std::vector<ConfigField> fields() override { return list_fields("", settings_); }

  void apply_options() override {
    if (rings_ >= 0) settings_.coordinates.rings = std::min(rings_, 1000);
    if (!width_.empty()) settings_.coordinates.half_width_mm = 500.0 * length_option_m("--width", width_);
  }

  int run(const Observer& observer) override {
    const double unit_m = mesh_unit_.empty() ? 1.0 : unit_option_m("--mesh-unit", mesh_unit_);
    const std::vector<Eigen::Vector3d> picks = points_option_m("--through", through_, unit_m);
    if (picks.size() < 2) throw UsageError("--through needs at least two points x,y,z, separated by ;");
    if (mesh_.empty() && into_.empty()) throw UsageError("MESH or --into is missing");
    if (output_.empty() && into_.empty()) throw UsageError("-o (the folder of the scene) or --into is missing");
    std::optional<OutputFolder> folder;
    if (into_.empty()) folder.emplace(output_, naming_added(is_our_folder));
    observer.update("reading", 0.0);
    reads(into_.empty() ? mesh_ : into_);
    EarlierScene earlier = read(unit_m, observer);
    std::optional<SceneFolder> scene_folder;
    if (!into_.empty()) scene_folder.emplace(earlier);
    SceneObject& object = earlier.object();
    SceneTexture texture = choose_texture(earlier.scene, texture_, index_, observer);
    PaintSettings usual;
    texture.origin->settings = changed_settings(fields(), list_fields("", usual));

    observer.update("painting", 0.0);
    const PaintResult result =
        paint(object, picks, texture, settings_.coordinates, under_ ? LayAt::kUnder : LayAt::kOver);
    reads("");
    observer.update("writing", 1.0);
    const fs::path shown = into_.empty() ? fs::path(output_) : earlier.given;
    const fs::path place = folder ? folder->path() : scene_folder->path();
    const std::string json = to_json(result, object, texture).dump_repaired(2);
    write_file(place / "paint.json", json + "\n");
    write_scene_again(place, earlier, {}, true);
    write_listing(place);
    if (folder) {
      commit_output(*folder, output_);
    } else {
      name_kept(shown, scene_folder->commit());
    }
    for (const std::string& note : covered_notes(result.covered, "texture " + std::to_string(texture.index)))
      print_error("paint: " + note);
    print_json(json);
    say(summary(result, texture) + "scene in " + printable(shown.string(), 200) + "\n");
    return kDone;
  }

 private:
  // With --into all that is beside the scene, else the scene alone.
  EarlierScene read(double unit_m, const Observer& observer) const {
    const std::optional<double> unit = mesh_unit_.empty() ? std::nullopt : std::optional(unit_m);
    try {
      EarlierScene out;
      if (into_.empty()) {
        out.scene = read_painted_scene(mesh_, unit, observer);
      } else {
        if (fs::path(into_).extension() != ".json") throw UsageError("--into: the file of a scene ends in .json");
        out = read_earlier_scene(into_, observer);
        if (unit) set_mesh_unit(out.scene, into_, *unit);
      }
      return out;
    } catch (const WrongUnit& error) {
      throw UsageError(std::string("--mesh-unit: ") + error.what());
    }
  }

  Json to_json(const PaintResult& result, const SceneObject& object, const SceneTexture& texture) {
    Json out = stroke_json(result, object, texture);
    out["config"] = config_json(fields());
    out["asperity"] = kVersion;
    return out;
  }

  static std::string summary(const PaintResult& result, const SceneTexture& texture) {
    const HapticWarp& warp = result.warp;
    const double furthest_m = *std::max_element(result.path.pick_distance_m.begin(), result.path.pick_distance_m.end());
    std::string out = fmt::format(
        "path       {:.2f} mm over the surface, picks up to {:.3f} mm from it\n"
        "texture    {} on {} triangles\n"
        "warp       lengths from {:.3f} to {:.3f}, {:.3f} RMS from 1; {} triangles fold, {} overlap\n",
        result.path.path.s_m.back() * 1e3, furthest_m * 1e3, texture.index, warp.triangles, warp.stretch_min,
        warp.stretch_max, warp.stretch_rms, warp.folded.size(), warp.overlapping.size());
    for (const Problem& problem : result.problems) out += "problem    " + printable(problem.message, 300) + "\n";
    return out;
  }

  std::string mesh_;
  std::string into_;
  std::string through_;
  std::string texture_;
  std::string output_;
  std::string mesh_unit_;
  std::string width_;
  int rings_ = -1;
  int index_ = -1;
  bool under_ = false;
  PaintSettings settings_;
};

}  // namespace

std::unique_ptr<Command> make_paint(Parser& root) { return std::make_unique<PaintCommand>(root); }

}  // namespace asperity::app
