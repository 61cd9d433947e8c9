#pragma once

#include <map>
#include <string>
#include <vector>

#include "asperity/scene/export_scene.h"
#include "asperity/scene/paint.h"
#include "asperity/testkit/shape_meshes.h"

namespace asperity {

// h = 0.1 mm cos(2π x / 2.5 mm) over a sample of 10 mm, painted along a plate of 30 mm x 20 mm.
inline Scene painted_scene() {
  Scene scene;
  scene.friction = 0.3;
  SceneObject object;
  object.mesh_file = "plate.obj";
  const TriangleMesh plate = testkit::plane_mesh({0.03, 0.02}, 15, 10);
  object.mesh.vertices = plate.vertices_m;
  object.mesh.triangles = plate.triangles;
  SceneTexture texture{1, "cosine.texture.json", {}};
  texture.texture.name = "cosine";
  texture.texture.model = Fourier1d{10.0, {0.0, 0.0, 0.0, 1e-4}, {0.0, 0.0, 0.0, 0.0}, 0.0};
  texture.texture.stiffness_N_per_m = 400.0;
  const std::vector<Eigen::Vector3d> picks{{0.006, 0.011, 0.0}, {0.024, 0.011, 0.0}};
  paint(object, picks, texture);
  scene.objects.push_back(object);
  return scene;
}

inline std::map<std::string, std::string> exported(const Scene& scene, ExportFormat format,
                                                   const ExportConfig& config = {}) {
  std::map<std::string, std::string> out;
  for (const ExportedFile& file : export_scene(scene, format, config).files) out[file.name] = file.content;
  return out;
}

}  // namespace asperity
