#include "setup/mesh_info.h"

#include <algorithm>
#include <array>

#include "asperity/geometry/mesh_measures.h"
#include "asperity/geometry/mesh_unit.h"
#include "asperity/scene/read_scene.h"
#include "json_pose.h"

namespace asperity::studio {

namespace {

constexpr std::array<const char*, 3> kFromNames{"file", "page", "project"};

bool has_attribute(const std::vector<Triangle>& corners) {
  return std::any_of(corners.begin(), corners.end(), [](const Triangle& corner) { return corner[0] != kNoIndex; });
}

void add_shape(const MeshMeasures& found, Json& out) {
  out["triangles"] = found.triangles;
  out["positions"] = found.vertices;
  out["size_m"] = json_of_point(found.high_m - found.low_m);
  out["area_m2"] = found.area_m2;
  out["volume_m3"] = found.volume_m3 ? Json(*found.volume_m3) : Json();
  out["parts"] = found.parts;
  out["closed"] = found.closed();
  out["edges"] = found.edges;
  out["edge_m"] = json_of_point({found.shortest_edge_m, found.median_edge_m, found.longest_edge_m});
  out["open_edges"] = found.open_edges;
  out["non_manifold_edges"] = found.non_manifold_edges;
  out["non_manifold_vertices"] = found.non_manifold_vertices;
  out["flipped_edges"] = found.flipped_edges;
  out["degenerate_triangles"] = found.degenerate_triangles;
}

}  // namespace

Json mesh_info_json(const Scene& scene, const MeshReading& reading, const Observer& observer) {
  const SceneObject& object = scene.objects.front();
  const MeshFile& mesh = object.mesh;
  const double unit_m = reading.from == MeshReading::From::kFile ? object.unit_m : reading.unit_m;
  Json out;
  out["objects"] = scene.objects.size();
  out["unit_m"] = unit_m;
  out["unit_from"] = kFromNames.at(static_cast<std::size_t>(reading.from));
  out["unit_text"] = reading.text;
  out["likely"] = is_likely_size(size_of_mesh_m(mesh, unit_m));
  out["vertices"] = mesh.vertices.size();
  add_shape(measure_mesh(to_metres(mesh, unit_m), observer), out);
  out["texture_coordinates"] = has_attribute(mesh.texture_corners);
  out["normals"] = has_attribute(mesh.normal_corners);
  out["textured_triangles"] = std::count_if(mesh.haptic.begin(), mesh.haptic.end(),
                                            [](const HapticTriangle& haptic) { return haptic.texture >= 0; });
  out["problems"] = Json::array();
  for (const Problem& problem : mesh.problems) out["problems"].push_back(problem.message);
  return out;
}

Json read_mesh_info(const std::filesystem::path& file, const MeshReading& reading, const Observer& observer) {
  observer.update("reading", 0.0);
  const Scene scene = read_scene(std::filesystem::is_directory(file) ? file / "scene.json" : file, observer);
  return mesh_info_json(scene, reading, observer);
}

}  // namespace asperity::studio
