#include "paint_page.h"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "asperity/base/folder_content.h"
#include "asperity/base/output.h"
#include "asperity/base/version.h"
#include "asperity/scene/export_scene.h"
#include "asperity/scene/write_scene.h"
#include "asperity/session/export_files.h"
#include "asperity/session/our_folder.h"
#include "asperity/session/paint_scene.h"
#include "asperity/texture/evaluate_height.h"
#include "asperity/texture/texture_file.h"
#include "painting.h"
#include "setup/project_setup.h"
#include "write_target.h"

namespace asperity::studio {

namespace {

namespace fs = std::filesystem;

// A scene as it was read, kept for the next stroke. Used by the jobs' thread alone.
struct SceneCache {
  fs::path file;
  MeshReading reading;
  fs::file_time_type written;
  std::optional<Scene> scene;

  const Scene& read(const fs::path& wanted, const MeshReading& how, const Observer& observer) {
    const fs::file_time_type now = fs::last_write_time(wanted);
    if (!scene || file != wanted || reading.unit_m != how.unit_m || reading.from != how.from || written != now) {
      scene.reset();
      const bool is_stated = how.from == MeshReading::From::kFile;
      Scene read = read_painted_scene(wanted, is_stated ? std::nullopt : std::optional(how.unit_m), observer);
      check_assumed_unit(read.objects.front().mesh, wanted, how);
      scene = std::move(read);
      file = wanted;
      reading = how;
      written = now;
    }
    return *scene;
  }
};

Json painting_json(const PaintedScene& painted, const Painting& painting) {
  Json out;
  out["format"] = "asperity-paint";
  out["version"] = 1;
  out["strokes"] = Json::array();
  for (std::size_t i = 0; i < painted.strokes.size(); ++i) {
    const PaintedStroke& stroke = painted.strokes[i];
    Json one = stroke_json(stroke.result, painted.scene.objects.front(), stroke.texture);
    Json picks = Json::array();
    for (const Eigen::Vector3d& pick : painting.strokes[i].picks_m) picks.push_back({pick.x(), pick.y(), pick.z()});
    one["through_m"] = std::move(picks);
    out["strokes"].push_back(std::move(one));
  }
  out["rings"] = painting.coordinates.rings;
  out["half_width_mm"] = painting.coordinates.half_width_mm;
  out["asperity"] = kVersion;
  return out;
}

// A texture to be looked at: its heights over a square of its own length, or a line of them.
BlockWriter texture_block(const Texture& texture) {
  constexpr std::size_t kSide = 64;
  constexpr double kLength_m = 0.01;
  BlockWriter out("texture");
  out.head()["name"] = texture.name;
  out.head()["height_field"] = is_height_field(texture.model);
  Json roughness = Json::object();
  for (const auto& [key, value] : texture.roughness) roughness[key] = value;
  out.head()["roughness"] = std::move(roughness);
  if (!is_height_field(texture.model)) return out;
  const double side_m = std::min(period_m(texture.model).value_or(kLength_m), kLength_m);
  std::vector<float> height_m;
  height_m.reserve(kSide * kSide);
  for (std::size_t row = 0; row < kSide; ++row) {
    for (std::size_t column = 0; column < kSide; ++column) {
      const double x_m = side_m * static_cast<double>(column) / static_cast<double>(kSide);
      const double y_m = side_m * static_cast<double>(row) / static_cast<double>(kSide);
      height_m.push_back(static_cast<float>(evaluate_height(texture.model, x_m, y_m).height_m));
    }
  }
  out.head()["side_m"] = side_m;
  out.add("height_m", std::span<const float>(height_m), {kSide, kSide});
  return out;
}

class PaintPage : public Page {
 public:
  explicit PaintPage(Shared& shared) : shared_(shared), cache_(std::make_shared<SceneCache>()) {}

  void bind(Document& document, Calls& calls) override {
    document.add_section("paint", first_painting(), [](const Json& section) { parse_painting(section); });
    calls.add("paint.show", [this](const Request& request) { show(request); });
    calls.add("paint.path", [this](const Request& request) { preview(request); });
    calls.add("paint.texture", [this](const Request& request) { show_texture(request); });
    calls.add("paint.write", [this](const Request& request) { write(request); });
    calls.add("paint.export", [this](const Request& request) { export_to(request); });
  }

 private:
  Painting painting() const {
    Painting out = parse_painting(shared_.document.section("paint"));
    if (out.object.empty()) throw Advice("nothing is open", "Choose a mesh or a scene to paint on.");
    return out;
  }

  MeshReading reading(const Painting& painting, const fs::path& file) const {
    return mesh_reading(file, painting.unit, project_setup(shared_.document));
  }

  void show(const Request& request) {
    const Painting painting = this->painting();
    const fs::path file = shared_.project.existing(painting.object);
    answer_by_job(shared_.jobs, request, "Painting", "paint",
                  [cache = cache_, project = &shared_.project, painting, file,
                   reading = reading(painting, file)](const Observer& observer) {
                    observer.update("reading", 0.0);
                    const Scene& scene = cache->read(file, reading, observer);
                    return painted_block(paint_all(scene, painting, *project, observer));
                  });
  }

  // The path that a stroke through these points would take.
  void preview(const Request& request) {
    const Painting painting = this->painting();
    const fs::path file = shared_.project.existing(painting.object);
    const Json* picks = request.args().find("picks_m");
    Json stroke{{"texture", ""}, {"index", 1}, {"picks_m", picks == nullptr ? Json() : *picks}};
    Json section = first_painting();
    section["strokes"].push_back(std::move(stroke));
    const Stroke drawn = parse_painting(section).strokes.front();
    answer_by_job(shared_.jobs, request, "Path", "paint.path",
                  [cache = cache_, file, drawn, reading = reading(painting, file)](const Observer& observer) {
                    observer.update("path", 0.0);
                    const SceneObject& object = cache->read(file, reading, observer).objects.front();
                    const VirtualPath path = virtual_path(to_metres(object.mesh, object.unit_m), drawn.picks_m);
                    std::vector<double> p_m;
                    for (const Eigen::Vector3d& p : path.path.p_mesh_m) p_m.insert(p_m.end(), p.begin(), p.end());
                    BlockWriter out("path");
                    out.head()["length_m"] = path.path.s_m.back();
                    out.head()["pick_distance_m"] = path.pick_distance_m;
                    out.head()["locally_shortest"] = path.locally_shortest;
                    out.add("path", std::span<const double>(p_m), {p_m.size() / 3, 3});
                    return out;
                  });
  }

  void show_texture(const Request& request) {
    const fs::path file = shared_.project.existing(request.text("file"));
    answer_by_job(shared_.jobs, request, "Texture", "",
                  [file](const Observer& observer) { return texture_block(read_texture(file, {}, observer)); });
  }

  void write(const Request& request) {
    const Painting painting = this->painting();
    if (painting.strokes.empty() && painting.swaps.empty()) {
      throw Advice("nothing has been painted", "Draw a path on the mesh first.");
    }
    const fs::path file = shared_.project.existing(painting.object);
    const std::string name = request.text("name");
    const fs::path target = write_target(shared_.project, request);
    answer_by_job(shared_.jobs, request, "Writing " + name, "paint.write",
                  [cache = cache_, project = &shared_.project, hub = &shared_.hub, painting, file, target,
                   reading = reading(painting, file), name](const Observer& observer) {
                    OutputFolder folder(target, naming_added(is_our_folder));
                    const PaintedScene painted =
                        paint_all(cache->read(file, reading, observer), painting, *project, observer);
                    for (const PaintedStroke& stroke : painted.strokes) {
                      if (!stroke.fault.empty()) throw Advice(stroke.fault, "Remove the stroke, or draw it again.");
                    }
                    observer.update("writing", 0.9);
                    write_scene(folder.path() / "scene.json", painted.scene);
                    write_file(folder.path() / "paint.json", painting_json(painted, painting).dump_repaired(2) + "\n");
                    write_listing(folder.path());
                    put_in_place(folder, name, *hub);
                    return Json{{"scene", name + "/scene.json"}};
                  });
  }

  void export_to(const Request& request) {
    const fs::path source = shared_.project.existing(request.text("source"));
    const std::string format_name = request.text("format");
    const auto found = std::find(kExportFormatNames.begin(), kExportFormatNames.end(), format_name);
    if (found == kExportFormatNames.end()) throw Error("unknown export format '" + format_name + "'");
    const auto format = static_cast<ExportFormat>(found - kExportFormatNames.begin());
    const std::string name = request.text("name");
    const fs::path target = write_target(shared_.project, request);
    answer_by_job(shared_.jobs, request, "Exporting " + name, "paint.export",
                  [source, format, target, name, hub = &shared_.hub](const Observer& observer) {
                    OutputFolder folder(target, naming_added(is_our_folder));
                    observer.update("reading", 0.0);
                    const Scene scene = read_export_source(source, observer);
                    observer.update("exporting", 0.3);
                    ExportResult files = export_scene(scene, format, {});
                    add_material_images(source, scene, format, files);
                    Json out = write_export(folder.path(), files);
                    put_in_place(folder, name, *hub);
                    out["folder"] = name;
                    return out;
                  });
  }

  Shared& shared_;
  std::shared_ptr<SceneCache> cache_;
};

}  // namespace

std::unique_ptr<Page> make_paint_page(Shared& shared) { return std::make_unique<PaintPage>(shared); }

}  // namespace asperity::studio
