#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "asperity/geometry/mesh_file.h"
#include "asperity/studio/document.h"

namespace asperity::studio {

inline constexpr const char* kProjectSection = "project";

// What holds for all pages, as the document's section "project" holds it:
//   "mesh_unit"  the unit of mesh files that do not state one, as text: "m", "mm", "0.06m"
//   "up"         the axis of a mesh's frame that is up in 3D views: "z" or "y"
struct ProjectSetup {
  std::string mesh_unit = "m";
  std::string up = "z";
};

Json json_of_setup(const ProjectSetup& setup);
// Throws Error in words for unknown keys, a unit that is none and another axis.
ProjectSetup setup_of_json(const Json& section);
// The defaults where the document has no such section.
ProjectSetup project_setup(const Document& document);

// How a mesh file is read.
struct MeshReading {
  enum class From { kFile, kPage, kProject };

  double unit_m = 1.0;  // of a scene.json: not known before it is read
  From from = From::kFile;
  std::string text;  // of the unit, as it was stated: "mm"
};

// `own`: the unit that a page states for this file, as text; empty: none. A scene.json's and a glTF file's own unit is
// used unless the page states one for the glTF file; of other files that of the page, else the project's.
MeshReading mesh_reading(const std::filesystem::path& file, std::string_view own, const ProjectSetup& project);

// Throws Advice where the project's unit makes the mesh something that nobody scans by hand (session/mesh_unit.h): then
// the page must state the unit.
void check_assumed_unit(const MeshFile& mesh, const std::filesystem::path& file, const MeshReading& reading);

}  // namespace asperity::studio
