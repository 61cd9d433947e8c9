#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "align/align_choice.h"
#include "asperity/base/progress.h"
#include "asperity/geometry/mesh_surface.h"
#include "asperity/pipeline/scan_points.h"
#include "asperity/studio/block.h"
#include "asperity/studio/project.h"

namespace asperity::studio {

// The mesh and the scans of a choice, read and made ready for registration. Immutable once made: shared by threads.
struct AlignScene {
  AlignChoice of;  // the choice that it was made from; poses and picks in it do not count
  MeshSurface surface;
  ScanPoints scans;
  // The paths as they are drawn and as residuals are taken: all points, or evenly thinned ones.
  std::vector<Eigen::Vector3d> p_world_m;
  std::vector<std::uint32_t> path;  // of each point
  Eigen::Vector3d middle_world_m = Eigen::Vector3d::Zero();
  std::size_t registered_points = 0;  // before they were thinned
  // Of a scene to which the scans are added: what is stored of its scans ({"name","texture","order","T_mesh_world",
  // "placement","verdict","rms_m"}, what is known of it), its textured triangles and those with several textures.
  std::string version{};  // its checksum
  Json stored = Json::array();
  std::vector<std::uint32_t> laid_triangle{};
  std::vector<std::int32_t> laid_texture{};
  std::vector<std::uint32_t> covered_triangle{};
  Problems problems{};
  std::vector<std::uint32_t> point{};    // of each point that is drawn: its index in its scan's path
  std::vector<std::uint8_t> overlap{};   // of each: 1 where scan_overlaps() has it, all scans by one pose
  std::vector<std::uint8_t> occupied{};  // of each triangle: 1 where a stored scan, which stays, has its texture
};

// Whether a scene made from `made` serves `needed` too.
bool is_same_scene(const AlignChoice& made, const AlignChoice& wanted);

// Reads what the choice names. Throws Advice without a mesh or path, Error for what cannot be used,
// Cancelled.
std::shared_ptr<const AlignScene> load_align_scene(const AlignChoice& choice, const Project& project,
                                                   const Observer& observer);

// Where to begin without a guess: the path's middle on that of the mesh's box, unturned.
Pose start_pose(const AlignScene& scene);

// The mesh block (mesh_block.h) of kind "align" with the paths: "path_points" [points, 3] in metres about the head's
// "middle_world_m", "path_of" [points]; "paths" their names, "start" the start pose, "problems" in words; of a scene
// "stored", and its textured triangles "laid_triangle" with their "laid_texture", and "covered_triangle".
BlockWriter align_block(const AlignScene& scene);

}  // namespace asperity::studio
