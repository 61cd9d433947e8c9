#include "align/align_area.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "align/shell_words.h"
#include "asperity/base/folder_content.h"
#include "asperity/base/output.h"
#include "asperity/geometry/triangle_mesh.h"
#include "asperity/json/parse_json.h"
#include "asperity/session/our_folder.h"
#include "asperity/session/write_area.h"
#include "asperity/studio/calls.h"
#include "asperity/texture/evaluate_spline_grid.h"
#include "mesh_block.h"
#include "write_target.h"

namespace asperity::studio {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostMapPoints = 500;  // points along a side: a screen shows no more
constexpr std::size_t kMargin = 2;           // of the grid, whose splines are not whole

// Points of the grid that are drawn, along one side of `count` coefficients.
std::vector<std::size_t> drawn(std::size_t count, std::size_t every) {
  std::vector<std::size_t> out;
  for (std::size_t i = kMargin; i + kMargin < count; i += every) out.push_back(i);
  return out;
}

void add_map(const ArealTexture& texture, BlockWriter& block) {
  const SplineGrid& grid = texture.surface;
  const std::size_t longest = std::max(grid.columns, grid.rows);
  const std::size_t every = std::max<std::size_t>(1, (longest + kMostMapPoints - 1) / kMostMapPoints);
  const std::vector<std::size_t> columns = drawn(grid.columns, every), rows = drawn(grid.rows, every);
  std::vector<float> height_m, sigma_m;
  std::vector<std::uint8_t> supported;
  for (const std::size_t row : rows) {
    for (const std::size_t column : columns) {
      const std::size_t at = row * grid.columns + column;
      const double x_m = grid.origin_x_m + static_cast<double>(column) * grid.spacing_x_m;
      const double y_m = grid.origin_y_m + static_cast<double>(row) * grid.spacing_y_m;
      height_m.push_back(static_cast<float>(evaluate_height(grid, x_m, y_m).height_m));
      sigma_m.push_back(at < texture.sigma_m.size() ? static_cast<float>(texture.sigma_m[at])
                                                    : std::numeric_limits<float>::quiet_NaN());
      supported.push_back(texture.supported[at]);
    }
  }
  block.head()["map"] = {{"columns", columns.size()},
                         {"rows", rows.size()},
                         {"every", every},
                         {"spacing_m", grid.spacing_x_m * static_cast<double>(every)}};
  block.add("height_m", height_m, {rows.size(), columns.size()});
  block.add("sigma_m", sigma_m, {rows.size(), columns.size()});
  block.add("supported", supported, {rows.size(), columns.size()});
}

std::string command_of(const AlignArea& area, const std::string& name) {
  std::string out = "asperity area " + shell_quoted(area.folder);
  AreaConfig config = area.result.config, first;
  const std::vector<ConfigField> fields = list_fields("", config), defaults = list_fields("", first);
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const std::string value = toml_text(fields[i].get());
    if (value != toml_text(defaults[i].get())) out += " --set " + shell_quoted(fields[i].path + "=" + value);
  }
  return out + " -o " + shell_quoted(name);
}

}  // namespace

Json list_registered(const Project& project) {
  Json out = Json::array();
  for (const Entry& entry : project.entries()) {
    const fs::path file(entry.name);
    if (entry.kind != EntryKind::kScene || file.filename() != "scene.json" || !file.has_parent_path()) continue;
    const std::string name = file.parent_path().generic_string();
    std::error_code error;
    if (!fs::is_regular_file(project.folder() / name / "registration.json", error)) continue;
    out.push_back(name);
  }
  return out;
}

std::shared_ptr<const AlignArea> make_align_area(const std::string& name, const fs::path& folder,
                                                 const AreaConfig& config, const Observer& observer) {
  observer.update("reading", 0.0);
  auto out = std::make_shared<AlignArea>();
  out->folder = name;
  out->input = read_area_input(folder, observer);
  const SceneObject& object = out->input.scene.objects.front();
  out->result =
      make_area(to_metres(object.mesh, object.unit_m), out->input.scans, out->input.registered, config, observer);
  return out;
}

BlockWriter area_block(const AlignArea& area) {
  const SceneObject& object = area.input.scene.objects.front();
  BlockWriter block = mesh_block("align.area", to_metres(object.mesh, object.unit_m));
  block.head()["folder"] = area.folder;
  block.head()["area"] = parse_json(format_area(area.result, area.input.scans, ""));
  block.head()["map"] = nullptr;
  if (!area.result.map.texture.surface.coefficient_m.empty()) add_map(area.result.map.texture, block);
  std::vector<float> xy_mm;
  for (const HapticTriangle& triangle : area.result.coordinates) {
    for (const Eigen::Vector2d& corner_mm : triangle.xy_mm) {
      xy_mm.push_back(static_cast<float>(corner_mm.x()));
      xy_mm.push_back(static_cast<float>(corner_mm.y()));
    }
  }
  block.add("triangle", std::span<const std::uint32_t>(area.result.triangle));
  block.add("xy_mm", std::span<const float>(xy_mm), {area.result.coordinates.size(), 3, 2});
  return block;
}

Json write_align_area(const AlignArea& area, const Project& project, const std::string& name, Hub& hub) {
  if (!area.result.texture)
    throw Advice("no area can be written: " + area.result.verdict, "Its verdicts state what to do.");
  const fs::path target = project.writable(name);
  if (target == project.writable(area.folder))
    throw Advice(name + ": this folder contains the scans of the area", "Write it into another folder.");
  OutputFolder folder(target, naming_added(is_our_folder));
  write_area(folder.path(), area.input, area.result);
  Json files = Json::array();
  std::vector<std::string> pictures;
  for (const auto& entry : fs::directory_iterator(folder.path())) {
    if (entry.path().extension() == ".png") pictures.push_back(entry.path().filename().string());
  }
  std::sort(pictures.begin(), pictures.end());
  for (std::string& picture : pictures) files.push_back(std::move(picture));
  put_in_place(folder, name, hub);
  return {{"name", name},
          {"scene", name + "/scene.json"},
          {"files", std::move(files)},
          {"command", command_of(area, name)}};
}

}  // namespace asperity::studio
