#include "render_rig.h"

#include <algorithm>
#include <cmath>

#include "asperity/testkit/shape_meshes.h"

namespace asperity::render_test {

using Eigen::Vector3d;

SceneObject object_of(const TriangleMesh& mesh) {
  SceneObject object;
  object.mesh_file = "mesh.ply";
  object.mesh.vertices = mesh.vertices_m;
  object.mesh.triangles = mesh.triangles;
  return object;
}

Scene scene_of(const std::vector<TriangleMesh>& meshes) {
  Scene scene;
  for (const TriangleMesh& mesh : meshes) scene.objects.push_back(object_of(mesh));
  return scene;
}

TriangleMesh sheet(double size_m, int cells, double jitter) {
  return moved(testkit::plane_mesh({size_m, size_m}, cells, cells, jitter), {-0.5 * size_m, -0.5 * size_m, 0.0});
}

TriangleMesh fold(double slope, double size_m, int cells) {
  TriangleMesh mesh = sheet(size_m, 2 * cells, 0.0);
  // The middle column of an even grid is exactly on the fold.
  for (Vector3d& p : mesh.vertices_m) {
    if (std::abs(p.x()) < 1e-9 * size_m) p.x() = 0.0;
    p.z() = slope * std::abs(p.x());
  }
  return mesh;
}

TriangleMesh moved(TriangleMesh mesh, const Vector3d& by_m) {
  for (Vector3d& p : mesh.vertices_m) p += by_m;
  return mesh;
}

TriangleMesh scaled(TriangleMesh mesh, double by) {
  for (Vector3d& p : mesh.vertices_m) p *= by;
  return mesh;
}

ServoOutput Rig::step(const Vector3d& p_m) {
  device.v_world_mps = begun ? Vector3d((p_m - device.p_world_m) / device.dt_s) : Vector3d::Zero();
  device.p_world_m = p_m;
  begun = true;
  return render_step(model, state, device);
}

ServoOutput Rig::go(const Vector3d& p_m, double step_m) {
  if (!begun) return step(p_m);
  const Vector3d from = device.p_world_m;
  const int count = std::max(1, static_cast<int>(std::ceil((p_m - from).norm() / step_m)));
  ServoOutput out;
  for (int i = 1; i <= count; ++i) out = step(i == count ? p_m : Vector3d(from + double(i) / count * (p_m - from)));
  return out;
}

}  // namespace asperity::render_test
