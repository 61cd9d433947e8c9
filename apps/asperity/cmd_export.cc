#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "asperity/base/folder_content.h"
#include "asperity/base/length_unit_names.h"
#include "asperity/base/nearest_word.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/base/version.h"
#include "asperity/geometry/mesh_unit.h"
#include "asperity/json/config_json.h"
#include "asperity/profile/read_heights.h"
#include "asperity/scene/export_scene.h"
#include "asperity/session/check_exportable.h"
#include "asperity/session/export_files.h"
#include "asperity/session/export_heights.h"
#include "asperity/session/our_folder.h"
#include "commands.h"
#include "option_units.h"

namespace asperity::app {

namespace {

namespace fs = std::filesystem;
class ExportCommand : public Command {
 public:
  explicit ExportCommand(Parser& root)
      : Command(root, "export", "Write a textured scene in the files of other programs") {
    require(
        parser().add_option("OUT", source_,
                            "What register, paint, process or area wrote, a scene.json, a mesh, a *.texture.json, or a "
                            "file of heights that `roughness` reads"));
    require(
        parser().add_option(
            "--to", format_,
            "obj, gltf (.glb), png (16-bit height and normal maps), wav (the texture stroked), x3p "
            "(heights), sdf, sdf-binary, gsf (profile and areal map), stl (relief to print), usda, ahap, haps, hjif, "
            "hmpg"))
        ->type_name("FORMAT")
        ->suggest(kExportFormatNames)
        ->suggest(kHeightFileNames);
    parser().add_option("-o,--output", output_, "Folder of the files; default: OUT-FORMAT")->type_name("DIR");
    parser()
        .add_option("--speed", speed_, "Speed of the stroke, for wav, ahap, haps and forces in time")
        ->type_name("SPEED");
    parser().add_option("--rate", rate_, "Samples per second of the stroke, for wav")->type_name("FREQUENCY");
    parser()
        .add_option("--spacing", spacing_, "Distance of the heights of a file without positions")
        ->type_name("LENGTH");
    parser()
        .add_option("--mesh-unit", mesh_unit_,
                    "Unit of a mesh that is given without a scene: m, mm or a length such as 0.06m")
        ->type_name("LENGTH")
        ->suggest(length_unit_names());
  }

  std::vector<ConfigField> fields() override {
    std::vector<ConfigField> all = list_fields("", config_);
    for (ConfigField& field : list_fields("input", input_)) all.push_back(std::move(field));
    return all;
  }

  void apply_options() override {
    if (!spacing_.empty()) input_.spacing_m = length_option_m("--spacing", spacing_);
    if (!rate_.empty()) config_.stroke.rate_Hz = number_option("--rate", rate_, "Hz", 1.0, 1e6);
    if (!speed_.empty()) config_.stroke.speed_mps = speed_option_mps("--speed", speed_);
  }

  int run(const Observer& observer) override {
    const auto name = std::find(kExportFormatNames.begin(), kExportFormatNames.end(), format_);
    const auto heights_as = height_file_of(format_);
    if (name == kExportFormatNames.end() && !heights_as) {
      const std::vector<std::string> known{"obj",  "gltf", "usda", "png", "wav",        "ahap", "haps",
                                           "hjif", "hmpg", "x3p",  "sdf", "sdf-binary", "gsf",  "stl"};
      const std::string nearest = format_ == "glb" ? "gltf" : nearest_word(format_, known);
      throw UsageError("--to: '" + printable(format_) + "' is none of " + fmt::format("{}", fmt::join(known, ", ")) +
                       (nearest.empty() ? "" : "; did you mean " + nearest + "?"));
    }
    fs::path target = output_;
    if (target.empty()) {
      target = beside(source_, format_);
    }
    OutputFolder folder(target, naming_added(is_our_folder));
    observer.update("reading", 0.0);
    reads(source_);
    ExportResult heights;
    if (heights_as) heights = export_heights(source_, *heights_as, input_, observer);
    const ExportResult result =
        name == kExportFormatNames.end() || (heights_as && holds_heights_alone(source_)) ||
                (!heights.files.empty() && holds_no_texture(source_))
            ? std::move(heights)
            : with_heights(scene_files(static_cast<ExportFormat>(name - kExportFormatNames.begin()), observer),
                           std::move(heights));
    if (result.files.empty()) {
      check_exportable(source_, read_export_source(source_, observer), format_);
      throw Error(printable(source_, 200) + ": " +
                  (result.problems.empty() ? "an areal map has too few points" : result.problems.front().message));
    }
    reads("");
    observer.update("writing", 1.0);
    Json out;
    out["format"] = "asperity-export";
    out["version"] = 1;
    out["to"] = format_;
    out["folder"] = is_utf8(target.string()) ? target.string() : printable(target.string(), 200);
    out.update(write_export(folder.path(), result));
    std::string text;
    for (const ExportedFile& file : result.files)
      text += fmt::format("{:>12} bytes  {}\n", file.content.size(), printable(file.name, 200));
    for (const Problem& problem : result.problems) {
      const char* what = problem.kind == "not_exported" ? "not exported: "
                         : problem.kind == "warning"    ? "warning: "
                                                        : "problem: ";
      text += what + printable(problem.message, 600) + "\n";
    }
    out["config"] = config_json(fields());
    out["asperity"] = kVersion;
    commit_output(folder, target.string());
    print_json(out.dump_repaired(2));
    say(text + "in " + printable(target.string(), 200) + "\n");
    return kDone;
  }

 private:
  // The scene's meshes and textures in that format.
  ExportResult scene_files(ExportFormat format, const Observer& observer) const {
    Scene scene = read_export_source(source_, observer);
    if (!mesh_unit_.empty()) {
      if (fs::path(source_).extension() == ".json" || fs::is_directory(source_))
        throw UsageError("--mesh-unit: the scene states its own unit; leave the option out");
      scene.objects.front().unit_m = unit_option_m("--mesh-unit", mesh_unit_);
    }
    check_exportable(source_, scene, format_);
    if (mesh_unit_.empty() && !fs::is_directory(source_)) {
      refuse_unlikely_metres(scene.objects.front().mesh, source_);
    }
    observer.update("exporting", 0.0);
    ExportResult out = export_scene(scene, format, config_, observer);
    add_material_images(source_, scene, format, out);
    return out;
  }

  // SOURCE-FORMAT beside the source, relative if that is given so; "." and ".." have a name from above alone.
  static fs::path beside(const fs::path& given, const std::string& format) {
    fs::path source = given.lexically_normal();
    if (!source.has_filename()) source = source.parent_path();
    const fs::path name = source.filename();
    if (name.empty() || name == "." || name == "..") {
      const fs::path whole = fs::weakly_canonical(fs::absolute(given));
      return (source / ".." / (whole.filename().string() + "-" + format)).lexically_normal();
    }
    return source.parent_path() / (name.string() + "-" + format);
  }

  static bool holds_no_texture(const fs::path& source) {
    return fs::is_directory(source) && !fs::exists(source / "scene.json") && !fs::exists(source / "texture.json");
  }

  static ExportResult with_heights(ExportResult files, ExportResult heights) {
    for (ExportedFile& file : heights.files) files.files.push_back(std::move(file));
    for (Problem& problem : heights.problems) files.problems.push_back(std::move(problem));
    return files;
  }

  std::string source_;
  std::string format_;
  std::string output_;
  std::string speed_;
  std::string rate_;
  std::string mesh_unit_;
  std::string spacing_;
  ExportConfig config_;
  ReadHeightsConfig input_;
};

}  // namespace

std::unique_ptr<Command> make_export(Parser& root) { return std::make_unique<ExportCommand>(root); }

}  // namespace asperity::app
