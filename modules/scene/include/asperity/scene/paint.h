#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "asperity/base/problem.h"
#include "asperity/base/progress.h"
#include "asperity/geometry/mesh_path.h"
#include "asperity/registration/haptic_coordinates.h"
#include "asperity/scene/lay_texture.h"
#include "asperity/scene/scene.h"

namespace asperity {

// A virtual scan over a mesh.
struct VirtualPath {
  MeshPath path;                        // through the picks, finely and evenly spaced, s_m from 0
  std::vector<double> pick_distance_m;  // of each pick from the mesh; the path goes through the nearest point
  bool locally_shortest = true;         // false: a piece between two picks could still be shortened
};

struct PaintResult {
  VirtualPath path;
  HapticWarp warp;
  std::size_t painted_over = 0;         // triangles that had another texture
  std::vector<CoveredTexture> covered;  // of painted_over, by rising index
  std::size_t painted_under = 0;        // triangles that still have another one: what was painted is below it
  Problems problems;
};

// The path over the surface through the points of a mesh nearest to `picks_mesh_m`, in their order, by a locally
// shortest path between each two (geodesic_path.h). Throws Error for fewer than two picks, a pick that is not
// finite, picks that fall together, and parts of the mesh that nothing connects.
VirtualPath virtual_path(const TriangleMesh& mesh, std::span<const Eigen::Vector3d> picks_mesh_m);

// Paints a texture onto a mesh along a virtual scan path (thesis §5.4: "artists may specify a virtual scanning
// trajectory over the surface of an arbitrary 3D object"): x along it, y across it, in millimetres of the surface,
// so that the texture keeps its scale. `picks_mesh_m` are in metres in the mesh's frame. The triangles near the path
// get the index of `texture`, which is added to the object's textures or replaces the one of that index; triangles
// that had another texture are painted over, or it lies under that (lay_texture.h); all others stay. The texture's
// order and origin are set here; of an origin that is given, the name and the settings are kept. The warp is that of
// the texture on these triangles. Throws Error as virtual_path does, and for a negative index; Cancelled, with the
// object as it was.
PaintResult paint(SceneObject& object, std::span<const Eigen::Vector3d> picks_mesh_m, SceneTexture texture,
                  const HapticCoordinatesConfig& config = {}, LayAt at = LayAt::kOver, const Observer& observer = {});

}  // namespace asperity
