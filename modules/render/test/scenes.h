#pragma once

#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/triangle_mesh.h"
#include "asperity/render/render_model.h"
#include "asperity/render/render_step.h"
#include "asperity/scene/scene.h"

namespace asperity::testing_render {

// An object of a mesh in metres.
inline SceneObject object_of(const TriangleMesh& mesh, const Pose& T_world_mesh = {}) {
  SceneObject object;
  object.mesh_file = "test";
  object.mesh.vertices = mesh.vertices_m;
  object.mesh.triangles = mesh.triangles;
  object.T_world_mesh = T_world_mesh;
  return object;
}

inline Scene scene_of(const TriangleMesh& mesh) {
  Scene scene;
  scene.objects.push_back(object_of(mesh));
  return scene;
}

inline DeviceState at(const Eigen::Vector3d& p_m) {
  DeviceState device;
  device.p_world_m = p_m;
  return device;
}

// Goes from a to b in steps of at most `step_m` and returns what the last step rendered.
inline ServoOutput stroke(const RenderModel& model, ServoState& state, const Eigen::Vector3d& a_m,
                          const Eigen::Vector3d& b_m, double step_m) {
  const int steps = 1 + static_cast<int>((b_m - a_m).norm() / step_m);
  ServoOutput out;
  for (int k = 0; k <= steps; ++k) out = render_step(model, state, at(a_m + (b_m - a_m) * k / steps));
  return out;
}

// A sphere with waves on it, r = R (1 + sum of sines), as an icosahedron cut in n² parts a face.
TriangleMesh bumpy_sphere(double radius_m, int cuts, double height);

}  // namespace asperity::testing_render
