#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/folder_content.h"
#include "asperity/base/length_unit_names.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/base/version.h"
#include "asperity/json/json.h"
#include "asperity/pipeline/process_methods.h"
#include "asperity/pipeline/register_scans.h"
#include "asperity/pipeline/write_registration.h"
#include "asperity/registration/manual_alignment.h"
#include "asperity/scene/set_mesh_unit.h"
#include "asperity/session/our_folder.h"
#include "asperity/session/paint_scene.h"
#include "asperity/session/register_input.h"
#include "asperity/session/scene_folder.h"
#include "commands.h"
#include "option_units.h"
#include "register_summary.h"

namespace asperity::app {

namespace {

namespace fs = std::filesystem;

class RegisterCommand : public Command {
 public:
  explicit RegisterCommand(Parser& root)
      : Command(root, "register", "Align scans with a 3D mesh and give it their textures") {
    parser().add_option(
        "PATH... MESH", files_,
        "Recordings, trajectory.csv files or any CSV with px_m,py_m,pz_m; then the mesh (.obj .ply "
        ".stl .off .gltf .glb) or the scene.json to whose mesh they are added; with --into the mesh is that "
        "of the scene");
    Option* into = parser()
                       .add_option("--into", into_,
                                   "Scene of an earlier registration or painting to add the scans to; a scan of the "
                                   "same name is replaced. Its other content is kept")
                       ->type_name("scene.json");
    parser().add_flag("--keep-invalid", keep_invalid_,
                      "With --into: add scans of an invalid pose too; default: the scene is not changed");
    parser()
        .add_option("--remove", remove_, "Remove the scan of this name from the scene of --into; may be repeated")
        ->type_name("NAME")
        ->one_value_each();
    parser().add_flag("--under", under_, "Lay the scans under the textures that the scene has, not over them");
    parser()
        .add_option("--date", date_, "Date of the scans, such as 2026-11-24; default: no date is stored")
        ->type_name("YYYY-MM-DD");
    parser()
        .add_option("--mesh-unit", mesh_unit_, "Length of the mesh's unit: m (the default), mm, cm, or such as 0.06m")
        ->type_name("LENGTH")
        ->suggest(length_unit_names());
    Option* guess =
        parser()
            .add_option(
                "--guess", guess_,
                "First guess of T_mesh_world, x,y,z,qw,qx,qy,qz in metres; without a guess the whole mesh is searched")
            ->type_name("POSE");
    Option* align =
        parser()
            .add_option(
                "--align", align_,
                "The guess as x,y,z,rx,ry,rz: metres, and degrees about x, the rotated y and the twice rotated z")
            ->type_name("SIX")
            ->excludes(guess);
    parser()
        .add_option("--picks", picks_,
                    "The guess as three or more pairs x,y,z=x,y,z;… of the path's points (m) and the mesh's (in its "
                    "unit)")
        ->type_name("PAIRS")
        ->excludes(guess)
        ->excludes(align);
    parser()
        .add_option("--texture", textures_,
                    "Texture to lay along a path instead of its own; one for all, or one per path")
        ->type_name("FILE");
    parser()
        .add_option("--placement", placement_,
                    "Which scans lay in the same placement of the object: auto (the default; found by their "
                    "likelihood), same, each (its own), or a list with one number per path, such as 1,1,2")
        ->type_name("LIST")
        ->suggest(kPlacementModeNames);
    parser()
        .add_option("-o,--output", output_, "Folder of the results (required without --into)")
        ->type_name("OUT")
        ->excludes(into);
    parser()
        .add_option("--method", method_,
                    "Of measuring, and of thesis also of registering, which needs a guess; the first is the default: " +
                        ProcessMethods::describe())
        ->type_name("NAME")
        ->suggest(kMethodNames);
  }

  std::vector<ConfigField> fields() override { return list_fields("", config_); }

  void apply_options() override {
    try {
      if (!method_.empty()) set_field(fields(), "process.method", method_);
      if (is_placement_mode(placement_)) set_field(fields(), "placement.mode", placement_);
    } catch (const Error& error) {
      throw UsageError(std::string("--") + error.what());
    }
  }

  int run(const Observer& observer) override {
    if (!into_.empty() && fs::path(into_).extension() != ".json")
      throw UsageError("--into: the file of a scene ends in .json");
    if (!remove_.empty()) return remove_scans(observer);
    check_words();
    std::string mesh_path = into_;
    if (into_.empty() || has_mesh(files_.back())) {
      mesh_path = files_.back();
      files_.pop_back();
    }
    const std::optional<double> unit_m =
        mesh_unit_.empty() ? std::nullopt : std::optional(unit_option_m("--mesh-unit", mesh_unit_));
    check_paths();
    const std::vector<int> placements = placements_option();

    std::optional<OutputFolder> folder;
    if (into_.empty()) folder.emplace(output_, naming_added(is_registration_folder));
    observer.update("reading", 0.0);
    reads(into_.empty() ? files_.front() : into_, into_.empty() ? mesh_path : into_);
    RegisterInput input = read(mesh_path, unit_m, observer);
    const std::optional<Pose> guess = first_pose(input.unit_m());
    if (!guess && ProcessMethods::get(config_.process.method).register_paths) {
      throw UsageError(
          "--method: registration by this method begins from a pose near the right one: give --guess, --align "
          "or --picks");
    }
    std::optional<SceneFolder> scene_folder;
    if (!into_.empty()) scene_folder.emplace(input.onto);
    reads(files_.front(), into_.empty() ? mesh_path : into_);
    for (std::size_t i = 0; i < placements.size(); ++i) input.scans[i].placement = placements[i];
    const ScansOnMesh result = register_input(input, guess, config_, observer);
    reads("");
    observer.update("writing", 1.0);
    input.onto.at = under_ ? LayAt::kUnder : LayAt::kOver;
    input.onto.date = date_;
    const fs::path target = into_.empty() ? fs::path(output_) : input.onto.given;
    const fs::path place = folder ? folder->path() : scene_folder->path();
    const bool listing = input.onto.files.contains("files.json");
    const std::vector<CoveredTexture> covered =
        write_registration(place, result, input.scans, std::move(input.onto), listing);
    if (listing) write_listing(place);
    const std::string json = read_file(place / "registration.json", std::uint64_t{1} << 30);
    const bool added = into_.empty() || result.trustworthy || keep_invalid_;
    if (folder) {
      commit_output(*folder, output_);
    } else if (added) {
      name_kept(target, scene_folder->commit());
    }
    print_json(trim(json));
    say(register_summary(result) + (added ? "results in " + printable(target.string(), 200) + "\n" : std::string()));
    for (const Verdict& verdict : result.verdicts) {
      if (verdict.severity != Severity::kNote) print_error(verdict_line(verdict));
    }
    if (!added) {
      print_error(printable(into_, 200) + ": unchanged, because the pose is invalid; --keep-invalid adds the scan");
    } else {
      for (const std::string& note : covered_notes(covered, "what was added")) print_error("register: " + note);
    }
    return result.trustworthy ? kDone : kNotTrustworthy;
  }

 private:
  // Paths and their mesh, or paths and the scene that has it.
  void check_words() const {
    if (into_.empty() && output_.empty()) throw UsageError("-o (the folder of the results) or --into is missing");
    if (into_.empty() && files_.size() < 2) throw UsageError("PATH... MESH: at least one path and the mesh are needed");
    if (files_.empty() || (files_.size() == 1 && has_mesh(files_.back())))
      throw UsageError("PATH...: at least one path is needed");
    if (keep_invalid_ && into_.empty()) throw UsageError("--keep-invalid needs --into, the scene");
    if (!is_date(date_)) throw UsageError("--date: '" + printable(date_, 200) + "' is not a date such as 2026-11-24");
  }

  static bool is_date(const std::string& text) {
    if (text.empty()) return true;
    constexpr std::string_view kForm = "dddd-dd-dd";
    if (text.size() != kForm.size()) return false;
    for (std::size_t i = 0; i < text.size(); ++i) {
      const bool digit = text[i] >= '0' && text[i] <= '9';
      if (kForm[i] == 'd' ? !digit : text[i] != kForm[i]) return false;
    }
    return true;
  }

  static bool has_mesh(const std::string& file) {
    const std::string ending = fs::path(file).extension().string();
    constexpr std::array<std::string_view, 7> kMeshes{".obj", ".ply", ".stl", ".off", ".gltf", ".glb", ".json"};
    return std::find(kMeshes.begin(), kMeshes.end(), ending) != kMeshes.end() && !fs::is_directory(file);
  }

  RegisterInput read(const std::string& mesh_path, std::optional<double> unit_m, const Observer& observer) const {
    try {
      RegisterInput input = read_register_input(files_, into_.empty() ? mesh_path : into_, unit_m, textures_, observer);
      if (!into_.empty() && mesh_path != into_) {
        const MeshFile other = read_register_mesh(mesh_path, observer);
        if (!is_same_mesh(other, input.mesh()))
          throw Error(printable(mesh_path, 200) + ": is not the mesh of " + printable(into_, 200) +
                      "; nothing was changed");
      }
      return input;
    } catch (const WrongUnit& error) {
      throw UsageError(std::string("--mesh-unit: ") + error.what());
    }
  }

  int remove_scans(const Observer& observer) {
    if (into_.empty()) throw UsageError("--remove needs --into, the scene");
    if (!files_.empty()) throw UsageError("--remove only removes scans; leave PATH and MESH out");
    observer.update("reading", 0.0);
    reads(into_);
    EarlierScene earlier = read_earlier_scene(into_, observer);
    SceneFolder folder(earlier);
    std::set<std::string> dropped;
    for (const std::string& name : remove_) dropped.merge(take_out_scan(earlier, name));
    reads("");
    observer.update("writing", 1.0);
    write_scene_again(folder.path(), earlier, dropped, folder.has_listing());
    if (folder.has_listing()) write_listing(folder.path());
    name_kept(earlier.given, folder.commit());
    Json out;
    out["format"] = "asperity-register-remove";
    out["version"] = 1;
    out["removed"] = remove_;
    out["scans"] = Json::array();
    for (const SceneTexture* scan : scans_of(earlier.scene)) out["scans"].push_back(scan->origin->name);
    out["asperity"] = kVersion;
    print_json(out.dump_repaired(2));
    say(fmt::format("{}: {} {} removed, {} left\n", printable(into_, 200), remove_.size(),
                    remove_.size() == 1 ? "scan" : "scans", out["scans"].size()));
    return kDone;
  }

  void check_paths() const {
    try {
      check_register_input(files_, textures_);
    } catch (const Error& error) {
      throw UsageError(error.what());
    }
  }

  static bool is_placement_mode(const std::string& text) {
    return std::find(kPlacementModeNames.begin(), kPlacementModeNames.end(), text) != kPlacementModeNames.end();
  }

  // One number a path; none if they were not listed.
  std::vector<int> placements_option() const {
    if (placement_.empty() || is_placement_mode(placement_)) return {};
    const std::vector<int> out = counts_option("--placement", placement_);
    if (out.size() != files_.size()) {
      throw UsageError(fmt::format("--placement: {} numbers for {} paths", out.size(), files_.size()));
    }
    return out;
  }

  // Where to begin, however it was said.
  std::optional<Pose> first_pose(double unit_m) const {
    if (!guess_.empty()) return pose_option("--guess", guess_);
    if (!align_.empty()) return align_manually(alignment_option("--align", align_));
    if (picks_.empty()) return std::nullopt;
    const PickedPairs pairs = pairs_option("--picks", picks_, unit_m);
    try {
      return align_picked(pairs.p_world_m, pairs.p_mesh_m).T_b_a;
    } catch (const Error& error) {
      throw UsageError(std::string("--picks: ") + error.what());
    }
  }

  std::vector<std::string> files_, textures_;
  std::vector<std::string> remove_;
  std::string mesh_unit_, guess_, align_, picks_, output_, method_, placement_, into_, date_;
  bool under_ = false;
  bool keep_invalid_ = false;
  RegisterConfig config_;
};

}  // namespace

std::unique_ptr<Command> make_register(Parser& root) { return std::make_unique<RegisterCommand>(root); }

}  // namespace asperity::app
