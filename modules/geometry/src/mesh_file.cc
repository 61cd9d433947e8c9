#include "asperity/geometry/mesh_file.h"

namespace asperity {

TriangleMesh to_metres(const MeshFile& file, double unit_m) {
  TriangleMesh mesh;
  mesh.vertices_m.reserve(file.vertices.size());
  for (const Eigen::Vector3d& vertex : file.vertices) mesh.vertices_m.push_back(vertex * unit_m);
  mesh.triangles = file.triangles;
  return mesh;
}

}  // namespace asperity
