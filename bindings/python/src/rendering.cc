#include <filesystem>
#include <optional>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "arrays.h"
#include "asperity/base/config.h"
#include "asperity/render/render_step.h"
#include "asperity/scene/paint.h"
#include "asperity/scene/read_scene.h"
#include "parts.h"

namespace asperity::python {

namespace {

Scene scene_of_mesh(const Doubles& vertices_m, const py::object& triangles) {
  Scene out;
  SceneObject& object = out.objects.emplace_back();
  const std::span<const Eigen::Vector3d> vertices = points_of(vertices_m, "vertices_m");
  object.mesh.vertices.assign(vertices.begin(), vertices.end());
  object.mesh.triangles = triangles_of(triangles, vertices.size());
  return out;
}

void paint_scene(Scene& scene, const Texture& texture, const Doubles& points_m, double half_width_m, int index,
                 std::size_t object) {
  if (object >= scene.objects.size())
    throw py::index_error("object: the scene has " + std::to_string(scene.objects.size()));
  SceneTexture painted;
  painted.index = index;
  painted.texture = texture;
  painted.file = "painted.texture.json";
  HapticCoordinatesConfig config;
  config.half_width_mm = 1e3 * within(half_width_m, 0.0, 1e3, "half_width_m");
  SceneObject changed = scene.objects[object];
  paint(changed, points_of(points_m, "points_m"), std::move(painted), config);
  scene.objects[object] = std::move(changed);
}

// One tip; one thread at a time.
class Renderer {
 public:
  Renderer(const Scene& scene, double rate_Hz, const py::dict& settings) {
    RenderConfig config;
    config.texture.rate_Hz = within(rate_Hz, 100.0, 20000.0, "rate_Hz");
    set_all(config, settings);
    model_ = make_render_model(scene, config);
  }

  ServoOutput step(const Doubles& position_m, const Doubles& velocity_mps, double dt_s) {
    return render_step(model_, state_,
                       {vector_of(position_m, "position_m"), vector_of(velocity_mps, "velocity_mps"), dt_s});
  }

  py::dict steps(const Doubles& positions_m, const std::optional<Doubles>& velocities_mps, double dt_s) {
    const std::span<const Eigen::Vector3d> p = points_of(positions_m, "positions_m");
    std::span<const Eigen::Vector3d> v;
    if (velocities_mps) {
      v = points_of(*velocities_mps, "velocities_mps");
      if (v.size() != p.size()) throw py::value_error("velocities_mps: as many as positions_m are wanted");
    }
    py::array_t<double> force = rows_of_three(p.size()), contact = rows_of_three(p.size()),
                        texture = rows_of_three(p.size()), friction = rows_of_three(p.size()),
                        proxy = rows_of_three(p.size());
    py::array_t<double> height(static_cast<py::ssize_t>(p.size()));
    py::array_t<bool> touching(static_cast<py::ssize_t>(p.size()));
    const auto rows = [](py::array_t<double>& of) { return reinterpret_cast<Eigen::Vector3d*>(of.mutable_data()); };
    Eigen::Vector3d *const f = rows(force), *const c = rows(contact), *const t = rows(texture),
                           *const r = rows(friction), *const x = rows(proxy);
    double* const h = height.mutable_data();
    bool* const touches = touching.mutable_data();
    {
      const py::gil_scoped_release unlocked;
      for (std::size_t i = 0; i < p.size(); ++i) {
        const Eigen::Vector3d moved =
            i > 0 && dt_s > 0.0 ? Eigen::Vector3d((p[i] - p[i - 1]) / dt_s) : Eigen::Vector3d::Zero();
        const ServoOutput out = render_step(model_, state_, {p[i], v.empty() ? moved : v[i], dt_s});
        f[i] = out.force_N;
        c[i] = out.contact_N;
        t[i] = out.texture_N;
        r[i] = out.friction_N;
        x[i] = out.proxy_m;
        h[i] = out.texture_height_m;
        touches[i] = out.contact.found();
      }
    }
    py::dict out;
    out["force_N"] = force;
    out["contact_N"] = contact;
    out["texture_N"] = texture;
    out["friction_N"] = friction;
    out["proxy_m"] = proxy;
    out["texture_height_m"] = height;
    out["touching"] = touching;
    return out;
  }

  void reset() { state_ = ServoState{}; }

 private:
  RenderModel model_;
  ServoState state_;
};

// Three numbers as an array, a copy.
template <class Member>
auto copied(Member member) {
  return [member](const ServoOutput& touch) { return py::array_t<double>(3, (touch.*member).data()); };
}

}  // namespace

void add_rendering(py::module_& module) {
  py::class_<Scene>(module, "Scene", "Objects with textures and materials.")
      .def(py::init(&scene_of_mesh), py::arg("vertices_m"), py::arg("triangles"),
           "One object without textures; vertices_m: (n, 3), m; triangles: (m, 3).")
      .def("paint", &paint_scene, py::arg("texture"), py::arg("points_m"), py::arg("half_width_m") = 0.0,
           py::arg("index") = 1, py::arg("object") = 0,
           "Paint a texture along the shortest path over the surface through points (n, 3), onto the triangles within "
           "half_width_m of it; 0: those that it touches and their neighbours.")
      .def("__len__", [](const Scene& scene) { return scene.objects.size(); });
  module.def(
      "read_scene", [](const std::filesystem::path& file) { return read_scene(file); }, py::arg("file"),
      "Read a *.scene.json, or a mesh in metres.");

  py::class_<ServoOutput>(module, "Touch", "What a step gives, in the scene's world frame.")
      .def_property_readonly("force_N", copied(&ServoOutput::force_N), "(3,) on the hand, N: the sum of the next three")
      .def_property_readonly("contact_N", copied(&ServoOutput::contact_N), "(3,) of the geometric contact, N")
      .def_property_readonly("texture_N", copied(&ServoOutput::texture_N), "(3,) of the texture, N")
      .def_property_readonly("friction_N", copied(&ServoOutput::friction_N), "(3,) of friction, N")
      .def_property_readonly("proxy_m", copied(&ServoOutput::proxy_m),
                             "(3,) where the tip's centre would be on a rigid surface, m")
      .def_readonly("texture_height_m", &ServoOutput::texture_height_m)
      .def_readonly("sticking", &ServoOutput::sticking)
      .def_readonly("starts_inside", &ServoOutput::starts_inside,
                    "The tip has begun inside an object: no force until it has left it.")
      .def_property_readonly("touching", [](const ServoOutput& touch) { return touch.contact.found(); });

  const Doubles still(3, std::array<double, 3>{}.data());
  py::class_<Renderer>(module, "Renderer",
                       "One tip over a scene: forces of its steps, at 1 kHz and faster. One thread at a time.")
      .def(py::init<const Scene&, double, const py::dict&>(), py::arg("scene"), py::arg("rate_Hz") = 1000.0,
           py::arg("settings") = py::dict(),
           "settings: those of `asperity feel --set render.NAME=VALUE` without `render.`, such as tip_radius_m.")
      .def("step", &Renderer::step, py::arg("position_m"), py::arg("velocity_mps") = still, py::arg("dt_s") = 1e-3,
           "One step to a position of the tip's centre (3,), m. The first is outside of all objects, or there is no "
           "force.")
      .def("steps", &Renderer::steps, py::arg("positions_m"), py::arg("velocities_mps") = py::none(),
           py::arg("dt_s") = 1e-3,
           "Steps to positions (n, 3) one after the other, without Python's lock. Velocities (n, 3), m/s; without them "
           "those between the positions. Gives a dict of arrays: force_N, contact_N, texture_N, friction_N and proxy_m "
           "(n, 3), texture_height_m and touching (n,).")
      .def("reset", &Renderer::reset, "The tip was lifted and set elsewhere: nothing is remembered.");
}

}  // namespace asperity::python
