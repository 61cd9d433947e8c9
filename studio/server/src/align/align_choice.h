#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/pose.h"
#include "asperity/pipeline/make_area.h"
#include "asperity/pipeline/register_config.h"
#include "asperity/studio/block.h"
#include "setup/project_setup.h"

namespace asperity::studio {

// What the user has decided on the page Align, as the document's section "align" holds it:
//   "paths"         recordings and CSV files that share one world frame, by their names in the project
//   "mesh"          a mesh file, a scene.json to whose mesh scans are added, or ""
//   "mesh_unit"     the length of its unit as text: "mm", "0.06m"; "": the project's, unless the file states one
//   "textures"      texture files to lay along the paths instead of their own: none, one for all, or one a path
//   "config"        settings of the registration that are not the default: dotted path -> text
//   "picks"         [{"path":[x,y,z],"mesh":[x,y,z]}]: pairs of points, world and mesh frame, metres
//   "T_mesh_world"  [x,y,z,qw,qx,qy,qz], where there is one
//   "registered"    the registration that "T_mesh_world" was taken from, where it was
//   "ran"           the registration whose result is shown, so that it can be worked out again
//   "area"          {"folder","config"}: the registered scans that an area is made of, and its settings; may be missing
struct AlignChoice {
  struct Pick {
    Eigen::Vector3d p_world_m, p_mesh_m;
  };
  // How to come to the same pose again.
  struct Registered {
    std::optional<Pose> guess;  // nullopt: from anywhere
    bool near = false;          // other places were not tried
    Pose T_mesh_world;          // where it ended
  };

  // What was registered last, from where, and by which settings.
  struct LastRun {
    std::optional<Pose> guess;  // nullopt: from anywhere
    std::vector<std::string> paths;
    std::string mesh, mesh_unit;
    std::map<std::string, std::string> config;
  };

  // The scans of a folder that a registration wrote, as one areal texture.
  struct Area {
    std::string folder;
    std::map<std::string, std::string> settings;

    AreaConfig config() const;
  };

  std::vector<std::string> paths;
  std::string mesh;
  std::string mesh_unit;
  std::vector<std::string> textures;
  std::map<std::string, std::string> config;
  std::vector<Pick> picks;
  std::optional<Pose> T_mesh_world;
  std::optional<Registered> registered;
  std::optional<LastRun> ran;
  Area area;
  ProjectSetup project;  // not of the section
};

Json json_of_choice(const AlignChoice& choice);
Json json_of_last_run(const AlignChoice::LastRun& ran);

// Throws Error in words for anything that is not a choice: unknown keys, more than 16 paths or 1000 picks, numbers that
// are not finite, a unit that is none, a setting that the registration does not know or take.
AlignChoice choice_of_json(const Json& section);

// Whether the mesh is that of a scene.json, to which the scans are added.
bool is_of_scene(const AlignChoice& choice);
// How the mesh is read.
MeshReading reading_of(const AlignChoice& choice);
// The unit that the mesh is read in: nullopt for a scene, which has its own.
std::optional<double> unit_to_read_m(const AlignChoice& choice);
RegisterConfig config_of(const AlignChoice& choice);

}  // namespace asperity::studio
