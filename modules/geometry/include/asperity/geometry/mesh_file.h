#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "asperity/base/problem.h"
#include "asperity/geometry/haptic_triangle.h"
#include "asperity/geometry/mesh_material.h"
#include "asperity/geometry/triangle_mesh.h"

namespace asperity {

inline constexpr std::uint32_t kNoIndex = 0xFFFFFFFFu;

// A run of triangles that belong to the same object, groups, smoothing group and material. It ends
// where the next part begins, or with the last triangle. Names are indices of MeshFile's tables, -1: none.
struct MeshPart {
  std::uint32_t first_triangle = 0;
  std::int32_t object = -1;
  std::int32_t group = -1;
  std::int32_t material = -1;
  std::uint32_t smoothing = 0;  // number of the smoothing group, 0: off

  bool operator==(const MeshPart&) const = default;
};

// What a mesh file holds, in the file's own unit, so that it can be written back exactly.
struct MeshFile {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Triangle> triangles;     // polygons are triangulated
  std::vector<HapticTriangle> haptic;  // empty, or one a triangle
  Problems problems;                   // what the file holds that a mesh of triangles does not

  std::vector<double> vertex_w;                 // empty, or one a vertex: its fourth number, nan where it has none
  std::vector<Eigen::Vector3d> vertex_colours;  // empty, or one a vertex: r g b as written, nan where it has none

  // Attributes of the corners have tables and indices of their own; kNoIndex in all three corners of a
  // triangle that has none. The indices are empty, or one triple a triangle.
  std::vector<Eigen::Vector3d> texture_coordinates;  // u v w; w is 0 in a file of two
  std::vector<Triangle> texture_corners;
  std::vector<Eigen::Vector3d> normals;  // as written, not normalised
  std::vector<Triangle> normal_corners;

  std::vector<MeshPart> parts;  // ordered by first_triangle, the first at 0; empty: nothing was named
  std::vector<std::string> objects;
  std::vector<std::string> groups;  // several names of one statement are one entry, separated by one blank
  std::vector<MeshMaterial> materials;
  std::vector<std::string> material_libraries;  // what follows each `mtllib`
};

// The geometry in metres; `unit_m` is the length of the file's unit.
TriangleMesh to_metres(const MeshFile& file, double unit_m);

}  // namespace asperity
