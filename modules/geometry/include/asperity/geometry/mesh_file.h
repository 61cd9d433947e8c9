#pragma once

#include <vector>

#include <Eigen/Core>

#include "asperity/base/problem.h"
#include "asperity/geometry/haptic_triangle.h"
#include "asperity/geometry/triangle_mesh.h"

namespace asperity {

// What a mesh file holds, in the file's own unit, so that it can be written back exactly.
struct MeshFile {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Triangle> triangles;     // polygons are triangulated
  std::vector<HapticTriangle> haptic;  // empty, or one a triangle
  Problems problems;                   // what the file holds that a mesh of triangles does not
};

// The geometry in metres; `unit_m` is the length of the file's unit.
TriangleMesh to_metres(const MeshFile& file, double unit_m);

}  // namespace asperity
