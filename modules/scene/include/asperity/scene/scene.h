#pragma once

#include <optional>
#include <string>
#include <vector>

#include "asperity/base/problem.h"
#include "asperity/geometry/covered_triangle.h"
#include "asperity/geometry/mesh_file.h"
#include "asperity/geometry/pose.h"
#include "asperity/json/json.h"
#include "asperity/scene/material_map.h"
#include "asperity/scene/texture_origin.h"
#include "asperity/texture/texture.h"

namespace asperity {

// A texture by the number that the mesh's `h` lines have for it (thesis §6.3, erratum 22).
struct SceneTexture {
  int index = 1;
  std::string file;  // *.texture.json, a name in the scene's folder or below
  Texture texture;
  int order = 0;  // where two textures are laid on one triangle, the one of the greater order is rendered
  std::optional<TextureOrigin> origin{};  // nullopt: not known
  std::string warning{};                  // why its source is not valid; empty: nothing known. Not in scene.json
};

// A mesh with its haptic coordinates, textures and material.
struct SceneObject {
  std::string mesh_file;  // a name in the scene's folder or below
  double unit_m = 1.0;    // length of the mesh's unit
  MeshFile mesh;
  std::vector<SceneTexture> textures;  // by rising index
  std::string covered_file;            // empty: no texture covers another
  // What the textures in mesh.haptic cover: by triangle, then from the lowest to the highest.
  std::vector<CoveredTriangle> covered;
  std::string material_file;  // empty: no map
  MaterialMap material;
  Pose T_world_mesh;  // its pose among the other objects

  const SceneTexture* find_texture(int index) const {
    for (const SceneTexture& texture : textures) {
      if (texture.index == index) return &texture;
    }
    return nullptr;
  }
};

// The rendered scene: the content of a *.scene.json and of all files that it names. There is at least one object.
struct Scene {
  std::vector<SceneObject> objects;
  std::optional<double> stiffness_N_per_m;  // where neither map nor texture knows better
  std::optional<double> friction;
  std::optional<double> static_friction_ratio;  // coefficient of sticking over that of sliding, from 1
  std::optional<Pose> T_mesh_world;             // the registration of the first object's scans: tracker's world to mesh
  Json extra = Json::object();                  // what others have put into extra
  Problems problems;
};

}  // namespace asperity
