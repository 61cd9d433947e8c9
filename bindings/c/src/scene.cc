// asperity_scene of asperity_feel.h.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "asperity/base/text.h"
#include "asperity/geometry/mesh_unit.h"
#include "asperity/scene/paint.h"
#include "asperity/scene/read_scene.h"
#include "asperity/scene/set_mesh_unit.h"
#include "asperity/scene/swap_texture.h"
#include "asperity/texture/material_limits.h"
#include "asperity/texture/texture_file.h"
#include "handles.h"
#include "status.h"

namespace {

using asperity::c_library::BadArgument;
using asperity::c_library::guarded;
using asperity::c_library::there;
using asperity::c_library::within;

template <class SceneHandle>  // of a constant scene: a constant object
auto& object_of(SceneHandle* scene, std::size_t object) {
  auto& of = there(scene, "scene").scene;
  if (object >= of.objects.size()) {
    throw BadArgument("object " + std::to_string(object) + ": the scene has " + std::to_string(of.objects.size()));
  }
  return of.objects[object];
}

// What `work` refuses is the caller's argument, for the files have been read.
template <class Work>
void as_argument(const Work& work) {
  try {
    work();
  } catch (const asperity::Error& fault) {
    throw BadArgument(fault.what());
  }
}

std::vector<Eigen::Vector3d> points_of(const double* numbers, std::size_t count, const char* name) {
  if (count > 0) there(numbers, name);
  std::vector<Eigen::Vector3d> out(count);
  for (std::size_t i = 0; i < count; ++i) {
    out[i] = Eigen::Vector3d::Map(numbers + 3 * i);
    if (!out[i].allFinite()) throw BadArgument(std::string(name) + ": point " + std::to_string(i) + " is not finite");
    if (out[i].cwiseAbs().maxCoeff() > asperity::kFurthestPlace_m) {
      throw BadArgument(std::string(name) + ": point " + std::to_string(i) + " is beyond " +
                        asperity::number_text(asperity::kFurthestPlace_m) + " m");
    }
  }
  return out;
}

}  // namespace

extern "C" {

asperity_status asperity_scene_read(const char* path, asperity_scene** scene) {
  if (scene != nullptr) *scene = nullptr;
  return guarded([&] {
    asperity_scene*& out = there(scene, "scene");
    const char* file = &there(path, "path");
    asperity::Scene read = asperity::read_scene(file);
    try {
      asperity::refuse_unlikely_metres(read.objects.front().mesh, file);
    } catch (const asperity::UnlikelyMetres& fault) {
      throw asperity::Error(std::string(fault.what()) + ": asperity_scene_read_with_unit()");
    }
    out = new asperity_scene{std::move(read)};
  });
}

asperity_status asperity_scene_read_with_unit(const char* path, double unit_m, asperity_scene** scene) {
  if (scene != nullptr) *scene = nullptr;
  return guarded([&] {
    asperity_scene*& out = there(scene, "scene");
    const char* file = &there(path, "path");
    within(unit_m, {1e-9, 1e3}, "unit_m");
    asperity::Scene read = asperity::read_scene(file);
    as_argument([&] { asperity::set_mesh_unit(read, file, unit_m); });
    out = new asperity_scene{std::move(read)};
  });
}

asperity_status asperity_scene_from_mesh(const double* vertices_m, size_t vertex_count, const unsigned* triangles,
                                         size_t triangle_count, asperity_scene** scene) {
  if (scene != nullptr) *scene = nullptr;
  return guarded([&] {
    asperity_scene*& out = there(scene, "scene");
    if (triangle_count > 0) there(triangles, "triangles");
    auto made = std::make_unique<asperity_scene>();
    asperity::SceneObject& object = made->scene.objects.emplace_back();
    object.mesh.vertices = points_of(vertices_m, vertex_count, "vertices_m");
    object.mesh.triangles.resize(triangle_count);
    for (std::size_t i = 0; i < triangle_count; ++i) {
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const unsigned index = triangles[3 * i + corner];
        if (index >= vertex_count) {
          throw BadArgument("triangles: triangle " + std::to_string(i) + " has the index " + std::to_string(index) +
                            ", and there are " + std::to_string(vertex_count) + " vertices");
        }
        object.mesh.triangles[i][corner] = index;
      }
    }
    if (triangle_count == 0) throw BadArgument("triangle_count is 0: nothing to feel");
    if (const double size_m = asperity::size_of_mesh_m(object.mesh, 1.0); size_m < asperity::kSmallestMesh_m) {
      throw BadArgument("vertices_m: a mesh of " + asperity::number_text(size_m) + " m is not plausible: at least " +
                        asperity::number_text(asperity::kSmallestMesh_m) + " m");
    }
    out = made.release();
  });
}

void asperity_scene_free(asperity_scene* scene) { delete scene; }

size_t asperity_scene_object_count(const asperity_scene* scene) {
  return scene == nullptr ? 0 : scene->scene.objects.size();
}

const char* asperity_scene_object_name(const asperity_scene* scene, size_t object) {
  if (object >= asperity_scene_object_count(scene)) return nullptr;
  return scene->scene.objects[object].mesh_file.c_str();
}

asperity_status asperity_scene_mesh(const asperity_scene* scene, size_t object, double* vertices_m,
                                    size_t vertex_capacity, size_t* vertex_count, unsigned* triangles,
                                    size_t triangle_capacity, size_t* triangle_count) {
  if (vertex_count != nullptr) *vertex_count = 0;
  if (triangle_count != nullptr) *triangle_count = 0;
  return guarded([&] {
    const asperity::SceneObject& of = object_of(scene, object);
    const asperity::MeshFile& mesh = of.mesh;
    size_t& vertices = there(vertex_count, "vertex_count");
    there(triangle_count, "triangle_count") = mesh.triangles.size();
    vertices = mesh.vertices.size();
    for (std::size_t i = 0; vertices_m != nullptr && i < std::min(vertex_capacity, mesh.vertices.size()); ++i)
      Eigen::Vector3d::Map(vertices_m + 3 * i) = of.unit_m * mesh.vertices[i];
    for (std::size_t i = 0; triangles != nullptr && i < std::min(triangle_capacity, mesh.triangles.size()); ++i) {
      for (std::size_t corner = 0; corner < 3; ++corner)
        triangles[3 * i + corner] = static_cast<unsigned>(mesh.triangles[i][corner]);
    }
  });
}

asperity_status asperity_scene_pose(const asperity_scene* scene, size_t object, double position_m[3],
                                    double rotation_wxyz[4]) {
  return guarded([&] {
    const asperity::Pose& pose = object_of(scene, object).T_world_mesh;
    double* position = &there(position_m, "position_m");
    double* q = &there(rotation_wxyz, "rotation_wxyz");
    Eigen::Vector3d::Map(position) = pose.translation_m;
    q[0] = pose.rotation.w();
    q[1] = pose.rotation.x();
    q[2] = pose.rotation.y();
    q[3] = pose.rotation.z();
  });
}

asperity_status asperity_scene_set_pose(asperity_scene* scene, size_t object, const double position_m[3],
                                        const double rotation_wxyz[4]) {
  return guarded([&] {
    asperity::SceneObject& of = object_of(scene, object);
    const double* q = &there(rotation_wxyz, "rotation_wxyz");
    const Eigen::Quaterniond rotation(q[0], q[1], q[2], q[3]);
    const double length = rotation.norm();
    if (!std::isfinite(length) || !(length > 1e-6))
      throw BadArgument("rotation_wxyz has the length 0 or is not finite");
    of.T_world_mesh = {rotation.normalized(), points_of(position_m, 1, "position_m").front()};
  });
}

asperity_status asperity_scene_paint(asperity_scene* scene, size_t object, const char* texture_path,
                                     const double* points_m, size_t point_count, double half_width_m, int index) {
  return guarded([&] {
    // A copy: what cannot be painted leaves the object as it was.
    asperity::SceneObject painted = object_of(scene, object);
    const std::vector<Eigen::Vector3d> points = points_of(points_m, point_count, "points_m");
    if (points.size() < 2) throw BadArgument("point_count is " + std::to_string(point_count) + ", not at least 2");
    if (index < 0) throw BadArgument("index is " + std::to_string(index) + ", not from 0");
    asperity::SceneTexture texture;
    texture.index = index;
    texture.file = &there(texture_path, "texture_path");
    texture.texture = asperity::read_texture(texture.file);
    asperity::HapticCoordinatesConfig config;
    config.half_width_mm = 1e3 * within(half_width_m, {0.0, 1e3}, "half_width_m");
    as_argument([&] { asperity::paint(painted, points, std::move(texture), config); });
    object_of(scene, object) = std::move(painted);
  });
}

asperity_status asperity_scene_set_texture(asperity_scene* scene, int index, const char* texture_path) {
  return guarded([&] {
    asperity::Scene& of = there(scene, "scene").scene;
    const std::string file = &there(texture_path, "texture_path");
    asperity::Texture texture = asperity::read_texture(file);
    as_argument([&] { asperity::swap_texture(of, index, std::move(texture), file); });
  });
}

asperity_status asperity_scene_set_stiffness(asperity_scene* scene, double stiffness_N_per_m) {
  return guarded([&] {
    there(scene, "scene").scene.stiffness_N_per_m =
        within(stiffness_N_per_m, asperity::kStiffnessLimits_N_per_m, "stiffness_N_per_m");
  });
}

asperity_status asperity_scene_set_friction(asperity_scene* scene, double sliding, double static_ratio) {
  return guarded([&] {
    asperity::Scene& of = there(scene, "scene").scene;
    const double friction = within(sliding, asperity::kFrictionLimits, "sliding");
    of.static_friction_ratio = within(static_ratio, asperity::kStaticFrictionRatioLimits, "static_ratio");
    of.friction = friction;
  });
}
}
