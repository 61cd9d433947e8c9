#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "arrays.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/geometry/mesh_unit.h"
#include "asperity/scene/lay_texture.h"
#include "asperity/scene/paint.h"
#include "asperity/scene/read_scene.h"
#include "asperity/scene/set_mesh_unit.h"
#include "asperity/scene/swap_texture.h"
#include "asperity/scene/write_scene.h"
#include "asperity/session/our_file.h"
#include "asperity/texture/material_limits.h"
#include "inputs.h"
#include "interruptible.h"
#include "mesh.h"
#include "parts.h"
#include "shared_scene.h"
#include "shared_texture.h"
#include "unmade.h"

namespace asperity::python {

namespace {

namespace fs = std::filesystem;

SharedScene scene_of_mesh(py::handle vertices_m, py::handle triangles) {
  Scene out;
  SceneObject& object = out.objects.emplace_back();
  const Rows vertices = place_rows(vertices_m, "vertices_m");
  object.mesh_file = "mesh.obj";
  object.mesh.vertices.assign(vertices.all().begin(), vertices.all().end());
  object.mesh.triangles = triangles_of(triangles, vertices.size());
  require_mesh_size(vertices);
  return SharedScene(std::move(out));
}

SharedScene read(const fs::path& file, std::optional<double> unit_m) {
  if (unit_m) unit_of(*unit_m, "unit_m");
  return interruptible([&](const Observer& observer) {
    Scene out = read_scene(file, observer);
    if (unit_m) {
      set_mesh_unit(out, file, *unit_m);
    } else {
      refuse_unlikely_metres(out.objects.front().mesh, file);
    }
    return SharedScene(std::move(out));
  });
}

const SceneObject& object_of(const Scene& scene, std::size_t index) {
  if (index < scene.objects.size()) return scene.objects[index];
  throw py::index_error("object: the scene has " + std::to_string(scene.objects.size()));
}

// `work` changes a copy, which becomes the scene; a scene that another thread has changed meanwhile stays that.
template <class Work>
void change(SharedScene& scene, const Work& work) {
  const std::shared_ptr<const Scene> before = scene.of;
  auto changed = interruptible([&](const Observer& observer) {
    auto copy = std::make_shared<Scene>(*before);
    work(*copy, observer);
    return copy;
  });
  if (scene.of != before) throw std::runtime_error("the scene was changed by another thread meanwhile");
  scene.of = std::move(changed);
}

void paint_on(SharedScene& scene, const SharedTexture& texture, py::handle points_m, double half_width_m, int index,
              std::size_t object) {
  object_of(*scene.of, object);
  const Rows points = place_rows(points_m, "points_m");
  HapticCoordinatesConfig config;
  config.half_width_mm = 1e3 * within(half_width_m, {0.0, 1e3}, "half_width_m");
  const std::shared_ptr<const Texture> given = texture.share();
  change(scene, [&](Scene& changed, const Observer& observer) {
    SceneTexture painted;
    painted.index = index;
    painted.texture = *given;
    const SceneTexture* before = changed.objects[object].find_texture(index);
    painted.file = before != nullptr ? before->file : free_file_name(changed, "painted.texture.json");
    paint(changed.objects[object], points.all(), std::move(painted), config, LayAt::kOver, observer);
  });
}

void set_texture(SharedScene& scene, int index, const SharedTexture& texture) {
  const std::shared_ptr<const Texture> given = texture.share();
  change(scene, [&](Scene& changed, const Observer&) {
    swap_texture(changed, index, *given, free_file_name(changed, "painted.texture.json", 2, index));
  });
}

SharedTexture texture_of(const SharedScene& scene, int index, std::size_t object) {
  const SceneTexture* found = object_of(*scene.of, object).find_texture(index);
  if (found == nullptr) throw py::index_error("index: the object has no texture " + std::to_string(index));
  return {std::shared_ptr<const Texture>(scene.of, &found->texture), "scene"};
}

std::vector<int> texture_indices(const SharedScene& scene, std::size_t object) {
  std::vector<int> out;
  for (const SceneTexture& texture : object_of(*scene.of, object).textures) out.push_back(texture.index);
  return out;
}

void set_material(SharedScene& scene, std::optional<double> stiffness_N_per_m, std::optional<double> friction,
                  std::optional<double> static_friction_ratio) {
  if (stiffness_N_per_m) within(*stiffness_N_per_m, kStiffnessLimits_N_per_m, "stiffness_N_per_m");
  if (friction) within(*friction, kFrictionLimits, "friction");
  if (static_friction_ratio) within(*static_friction_ratio, kStaticFrictionRatioLimits, "static_friction_ratio");
  change(scene, [&](Scene& changed, const Observer&) {
    changed.stiffness_N_per_m = stiffness_N_per_m;
    changed.friction = friction;
    changed.static_friction_ratio = static_friction_ratio;
  });
}

void set_pose(SharedScene& scene, py::handle T_world_mesh, std::size_t object) {
  object_of(*scene.of, object);
  const Pose pose = pose_of_matrix(T_world_mesh, "T_world_mesh");
  change(scene, [&](Scene& changed, const Observer&) { changed.objects[object].T_world_mesh = pose; });
}

Mesh mesh_of(const SharedScene& scene, std::size_t object) {
  object_of(*scene.of, object);
  return interruptible([&, of = scene.of](const Observer& observer) {
    const SceneObject& from = of->objects[object];
    return Mesh(to_metres(from.mesh, from.unit_m), observer);
  });
}

// Files of other content stay; the scene's own file is replaced.
void write(const SharedScene& scene, const fs::path& file) {
  if (file.extension() != ".json") throw py::value_error("file: a scene's file ends in .scene.json or .json");
  interruptible([&, of = scene.of](const Observer&) {
    refuse_stranger(file, begins_as_scene);
    Scene out = *of;
    name_meshes_obj(out);
    std::vector<SceneFile> files = format_scene_files(file.filename().string(), out);
    files.pop_back();
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    if (const auto taken = find_other_content(folder, files))
      throw Error(printable((folder / *taken).string(), 200) + ": exists with other content; nothing was written");
    write_scene(file, out);
  });
}

}  // namespace

void add_scenes(py::module_& module) {
  py::class_<SharedScene>(module, "Scene", "Objects with textures and materials.")
      .def(py::init(&scene_of_mesh), py::arg("vertices_m"), py::arg("triangles"),
           "One object without textures; vertices_m: (n, 3), m; triangles: (m, 3) indices from 0. Copied.")
      .def("paint", &paint_on, py::arg("texture"), py::arg("points_m"), py::arg("half_width_m") = 0.0,
           py::arg("index") = 1, py::arg("object") = 0,
           "Paint a texture along the shortest path over the surface through points (n, 3), m, in the mesh's frame, "
           "onto the triangles within half_width_m of it; 0: those that it touches and their neighbours. What is "
           "broken off leaves the scene as it was.")
      .def("set_texture", &set_texture, py::arg("index"), py::arg("texture"),
           "Another texture in place of that of the index, in the first object; its coordinates stay.")
      .def("texture", &texture_of, py::arg("index") = 1, py::arg("object") = 0, "The texture of that index.")
      .def("texture_indices", &texture_indices, py::arg("object") = 0, "The indices of an object's textures.")
      .def("set_material", &set_material, py::arg("stiffness_N_per_m") = py::none(), py::arg("friction") = py::none(),
           py::arg("static_friction_ratio") = py::none(),
           "Material where neither textures nor maps state one: 1 to 1e6 N/m, coefficient of sliding 0 to 10, "
           "coefficient of sticking over it 1 to 10. None: the renderer's setting.")
      .def("mesh", &mesh_of, py::arg("object") = 0, "An object's Mesh, m, in its own frame; a copy.")
      .def(
          "pose",
          [](const SharedScene& scene, std::size_t object) {
            return matrix_of(object_of(*scene.of, object).T_world_mesh);
          },
          py::arg("object") = 0, "(4, 4) T_world_mesh of an object, m. A copy.")
      .def("set_pose", &set_pose, py::arg("T_world_mesh"), py::arg("object") = 0,
           "Move an object: (4, 4) from its mesh's frame to the world, m.")
      .def("write", &write, py::arg("file"),
           "Write it as FILE.scene.json with its meshes and textures beside it. A file of other content is not "
           "replaced, but for FILE.scene.json itself, where it is a scene.")
      .def(
          "__len__", [](const SharedScene& scene) { return scene.of->objects.size(); }, "The number of objects.")
      .def("__repr__", [](const SharedScene& scene) {
        std::size_t triangles = 0, textures = 0;
        for (const SceneObject& object : scene.of->objects)
          triangles += object.mesh.triangles.size(), textures += object.textures.size();
        return "<asperity.Scene: objects " + std::to_string(scene.of->objects.size()) + ", triangles " +
               std::to_string(triangles) + ", textures " + std::to_string(textures) + ">";
      });
  refuse_unmade<SharedScene>();
  module.def("read_scene", &read, py::arg("file"), py::arg("unit_m") = py::none(),
             "Read a *.scene.json, or a mesh file as a scene of one object. unit_m: as of read_mesh; a scene.json and "
             "glTF state their unit.");
}

}  // namespace asperity::python
