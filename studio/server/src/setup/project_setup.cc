#include "setup/project_setup.h"

#include <fmt/format.h>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/base/units.h"
#include "asperity/geometry/mesh_unit.h"
#include "asperity/studio/calls.h"
#include "json_keys.h"

namespace asperity::studio {

namespace {

constexpr std::size_t kLongestUnit = 40;

std::string text_of(const Json& section, const char* key) {
  if (!section.contains(key) || !section.at(key).is_string() || section.at(key).text().size() > kLongestUnit) {
    throw Error(std::string("project: ") + key + " is not short text");
  }
  return section.at(key).get<std::string>();
}

}  // namespace

Json json_of_setup(const ProjectSetup& setup) { return {{"mesh_unit", setup.mesh_unit}, {"up", setup.up}}; }

ProjectSetup setup_of_json(const Json& section) {
  refuse_unknown(section, {"mesh_unit", "up"}, "project");
  ProjectSetup out{text_of(section, "mesh_unit"), text_of(section, "up")};
  parse_length_unit_m(out.mesh_unit, "the unit of meshes");
  if (out.up != "y" && out.up != "z") throw Error("project: the axis that is up is y or z");
  return out;
}

ProjectSetup project_setup(const Document& document) {
  const Json* section = document.value().find(kProjectSection);
  return section == nullptr ? ProjectSetup() : setup_of_json(*section);
}

MeshReading mesh_reading(const std::filesystem::path& file, std::string_view own, const ProjectSetup& project) {
  using From = MeshReading::From;
  const bool is_scene = file.extension() == ".json" || std::filesystem::is_directory(file);
  if (is_scene || (own.empty() && states_its_unit(file))) return {1.0, From::kFile, "m"};
  const std::string text(own.empty() ? std::string_view(project.mesh_unit) : own);
  return {parse_length_unit_m(text, "the mesh's unit"), own.empty() ? From::kProject : From::kPage, text};
}

void check_assumed_unit(const MeshFile& mesh, const std::filesystem::path& file, const MeshReading& reading) {
  if (reading.from != MeshReading::From::kProject) return;
  const double size_m = size_of_mesh_m(mesh, reading.unit_m);
  if (is_likely_size(size_m)) return;
  const std::string size = size_m < 1.0 ? fmt::format("{:.3g} mm", 1e3 * size_m) : fmt::format("{:.3g} m", size_m);
  throw Advice(printable(file.filename().string(), 200) + " states no unit and is " + size +
                   " large in the project's unit (" + reading.text + ")",
               "Choose the mesh's unit on this page, or the project's unit on the Home page.");
}

}  // namespace asperity::studio
