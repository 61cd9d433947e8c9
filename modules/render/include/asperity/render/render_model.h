#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "asperity/base/progress.h"
#include "asperity/geometry/haptic_triangle.h"
#include "asperity/geometry/mesh_bvh.h"
#include "asperity/geometry/pose.h"
#include "asperity/geometry/triangle_mesh.h"
#include "asperity/render/render_material.h"
#include "asperity/render/render_texture.h"
#include "asperity/scene/scene.h"
#include "asperity/texture/material_limits.h"

namespace asperity {

// How a scene is rendered.
struct RenderConfig {
  double tip_radius_m = 0.0;           // 0: a point
  double stiffness_N_per_m = 1000;     // where the scene knows none
  double friction = 0.0;               // coefficient of sliding, where the scene knows none
  double static_friction_ratio = 1.2;  // coefficient of sticking over that of sliding, where the scene knows none
  bool force_shading = false;          // forces along interpolated normals
  double border_fade_m = 1e-3;         // width over which a texture fades at the border of its area (erratum 20)
  RenderTextureConfig texture;

  template <class V>
  void visit(V& v) {
    v.field("tip_radius_m", tip_radius_m, "radius of the tip, m; 0: a point", {0.0, 0.1});
    v.field("stiffness_N_per_m", stiffness_N_per_m, "where the scene knows none, N/m", kStiffnessLimits_N_per_m);
    v.field("friction", friction, "coefficient of sliding where the scene knows none", kFrictionLimits);
    v.field("static_friction_ratio", static_friction_ratio,
            "coefficient of sticking over that of sliding where the scene knows none", kStaticFrictionRatioLimits);
    v.field("force_shading", force_shading, "forces along interpolated normals");
    v.field("border_fade_m", border_fade_m, "over which a texture fades at its border, m", {0.0, 1.0});
    v.group("texture", texture);
  }
};

// The edges at which a textured area ends, another begins or the texture's coordinates tear, as triangles without
// area. Empty: none.
struct TextureBorder {
  std::optional<MeshBvh> edges;
};

// A mesh made ready for the servo thread, in metres, in the frame of the mesh.
struct RenderObject {
  TriangleMesh mesh;
  MeshBvh bvh;
  std::vector<Eigen::Vector3d> normals;  // unit, one a triangle; zero for one without area
  bool closed = false;                   // every edge has two triangles: it has an inside
  Pose T_world_mesh;
  std::uint64_t id = 0;  // of the geometry: a hash of vertices and triangles

  std::vector<std::int32_t> texture;  // one a triangle: index in RenderModel::textures, -1: none; empty: none at all
  std::vector<std::array<Eigen::Vector2d, 3>> texture_xy_m;    // of the corners; empty without textures
  TextureBorder border;                                        // where textures fade
  std::vector<std::array<Eigen::Vector3d, 3>> corner_normals;  // for force shading; empty without
  std::vector<RenderMaterial> materials;                       // those that differ; at least one
  std::vector<std::array<std::uint32_t, 3>> corner_material;   // indices; empty: materials[0] everywhere
  std::vector<std::array<std::uint32_t, 3>> bare_material;  // without textures, felt at their borders; empty: the same
};

// The rendered scene, immutable while it is rendered.
struct RenderModel {
  std::vector<RenderObject> objects;
  std::vector<RenderTexture> textures;
  RenderConfig config;
  double extent_m = 0.0;          // of the largest object, for the proxy's skin (docs/render.md)
  double highest_m = 0.0;         // of all textures, with their offsets
  std::uint64_t material_id = 0;  // of the objects' materials: a hash of what is where
};

// Throws Error for a scene that cannot be rendered, naming object and place; Cancelled.
RenderModel make_render_model(const Scene& scene, const RenderConfig& config, const Observer& observer = {});

}  // namespace asperity
