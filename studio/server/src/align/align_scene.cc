#include "align/align_scene.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <span>
#include <utility>

#include <Eigen/Geometry>

#include "align/scan_overlaps.h"
#include "asperity/session/register_input.h"
#include "asperity/studio/calls.h"
#include "json_pose.h"
#include "mesh_block.h"

namespace asperity::studio {

namespace {

constexpr std::size_t kMostShown = 6000;

std::vector<std::string> files_of(const std::vector<std::string>& names, const Project& project) {
  std::vector<std::string> out;
  for (const std::string& name : names) out.push_back(project.existing(name).string());
  return out;
}

// The settings that the points depend on.
std::map<std::string, std::string> point_settings(const AlignChoice& choice) {
  std::map<std::string, std::string> out;
  for (const auto& [path, value] : choice.config) {
    if (path.starts_with("process.") || path.starts_with("points.")) out[path] = value;
  }
  return out;
}

// What the scene has already: its scans, and which triangles have which texture.
void show_stored(const EarlierScene& earlier, AlignScene& scene) {
  for (const auto& [index, scan] : stored_scans(earlier)) {
    Json one;
    for (const char* key : {"name", "texture", "order", "T_mesh_world", "placement", "verdict", "rms_m"}) {
      if (const Json* value = scan.find(key)) one[key] = *value;
    }
    scene.stored.push_back(std::move(one));
  }
  const std::vector<HapticTriangle>& haptic = earlier.object().mesh.haptic;
  for (std::uint32_t t = 0; t < haptic.size(); ++t) {
    if (haptic[t].texture < 0) continue;
    scene.laid_triangle.push_back(t);
    scene.laid_texture.push_back(haptic[t].texture);
  }
  for (const CoveredTriangle& one : earlier.object().covered) {
    if (scene.covered_triangle.empty() || scene.covered_triangle.back() != one.triangle)
      scene.covered_triangle.push_back(one.triangle);
  }
}

// Where a scan would overlap the texture of another one that it does not replace.
void mark_occupied(const std::vector<Scan>& scans, AlignScene& scene) {
  std::set<std::int32_t> replaced;
  for (const Json& stored : scene.stored) {
    const std::string name = stored.value("name", "");
    const bool again = std::any_of(scans.begin(), scans.end(), [&](const Scan& scan) { return scan.name == name; });
    if (again && stored.contains("texture")) replaced.insert(stored.at("texture").get<std::int32_t>());
  }
  scene.occupied.assign(scene.surface.mesh.triangles.size(), 0);
  for (std::size_t i = 0; i < scene.laid_triangle.size(); ++i) {
    if (!replaced.contains(scene.laid_texture[i])) scene.occupied[scene.laid_triangle[i]] = 1;
  }
}

void show_points(AlignScene& scene) {
  std::size_t total = 0;
  for (const PathPoints& points : scene.scans.points) total += points.path.p_world_m.size();
  const std::size_t stride = std::max<std::size_t>(1, (total + kMostShown - 1) / kMostShown);
  for (std::size_t k = 0; k < scene.scans.points.size(); ++k) {
    const std::vector<Eigen::Vector3d>& p_m = scene.scans.points[k].path.p_world_m;
    for (std::size_t i = 0; i < p_m.size(); i += stride) {
      if (!p_m[i].allFinite()) continue;
      scene.p_world_m.push_back(p_m[i]);
      scene.point.push_back(static_cast<std::uint32_t>(i));
      scene.path.push_back(static_cast<std::uint32_t>(k));
      scene.middle_world_m += p_m[i];
    }
  }
  scene.registered_points = total;
  if (scene.p_world_m.empty()) {
    throw Advice("the paths have no finite point", "Choose another scan, or check it on the Process page.");
  }
  scene.middle_world_m /= static_cast<double>(scene.p_world_m.size());
}

}  // namespace

bool is_same_scene(const AlignChoice& made, const AlignChoice& wanted) {
  return made.paths == wanted.paths && made.mesh == wanted.mesh && unit_to_read_m(made) == unit_to_read_m(wanted) &&
         point_settings(made) == point_settings(wanted);
}

std::shared_ptr<const AlignScene> load_align_scene(const AlignChoice& choice, const Project& project,
                                                   const Observer& observer) {
  if (choice.mesh.empty()) throw Advice("no mesh is chosen", "Choose a mesh file of the project's folder.");
  if (choice.paths.empty()) throw Advice("no scan is chosen", "Choose a recording, or a CSV file of a path.");
  observer.update("reading", 0.0);
  const RegisterInput input = read_register_input(
      files_of(choice.paths, project), project.existing(choice.mesh).string(), unit_to_read_m(choice), {}, observer);
  check_assumed_unit(input.mesh(), choice.mesh, reading_of(choice));
  observer.update("mesh", 0.2);
  auto out = std::make_shared<AlignScene>(AlignScene{choice,
                                                     MeshSurface(to_metres(input.mesh(), input.unit_m())),
                                                     {},
                                                     {},
                                                     {},
                                                     {},
                                                     0,
                                                     input.onto.checksum,
                                                     Json::array(),
                                                     {},
                                                     {},
                                                     {},
                                                     input.mesh().problems});
  show_stored(input.onto, *out);
  out->scans = find_scan_points(input.scans, config_of(choice), observer);
  for (const ProcessResult& motion : out->scans.motions) {
    out->problems.insert(out->problems.end(), motion.problems.begin(), motion.problems.end());
  }
  show_points(*out);
  mark_occupied(input.scans, *out);
  out->overlap = scan_overlaps(*out, {});
  return out;
}

Pose start_pose(const AlignScene& scene) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p_m : scene.surface.mesh.vertices_m) box.extend(p_m);
  return {Eigen::Quaterniond::Identity(), box.center() - scene.middle_world_m};
}

BlockWriter align_block(const AlignScene& scene) {
  BlockWriter out = mesh_block("align", scene.surface.mesh);
  std::vector<float> points;
  for (const Eigen::Vector3d& p_m : scene.p_world_m) {
    for (Eigen::Index k = 0; k < 3; ++k) points.push_back(static_cast<float>(p_m[k] - scene.middle_world_m[k]));
  }
  out.add("path_points", std::span<const float>(points), {scene.p_world_m.size(), 3});
  out.add("path_of", std::span<const std::uint32_t>(scene.path));
  out.add("laid_triangle", std::span<const std::uint32_t>(scene.laid_triangle));
  out.add("laid_texture", std::span<const std::int32_t>(scene.laid_texture));
  out.add("covered_triangle", std::span<const std::uint32_t>(scene.covered_triangle));
  Json& head = out.head();
  head["stored"] = scene.stored;
  head["middle_world_m"] = json_of_point(scene.middle_world_m);
  head["paths"] = scene.of.paths;
  head["registered_points"] = scene.registered_points;
  head["start"] = json_of_pose(start_pose(scene));
  head["problems"] = Json::array();
  for (const Problem& problem : scene.problems) head["problems"].push_back(problem.message);
  return out;
}

}  // namespace asperity::studio
