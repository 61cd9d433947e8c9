#include <pybind11/stl.h>

#include "arrays.h"
#include "parts.h"
#include "renderer.h"
#include "unmade.h"

namespace asperity::python {

namespace {

// Three numbers as an array, a copy.
template <class Member>
auto copied(Member member) {
  return [member](const Touch& touch) { return py::array_t<double>(3, (touch.out.*member).data()); };
}

template <class Member>
auto copied_of_contact(Member member) {
  return [member](const Touch& touch) { return py::array_t<double>(3, (touch.out.contact.*member).data()); };
}

template <class Member>
auto index_of_contact(Member member) {
  return [member](const Touch& touch) -> std::optional<std::uint32_t> {
    if (!touch.out.contact.found()) return std::nullopt;
    return touch.out.contact.*member;
  };
}

void add_touch(py::module_& module) {
  py::class_<Touch>(module, "Touch", "What a step gives, in the scene's world frame.")
      .def_property_readonly("force_N", copied(&ServoOutput::force_N), "(3,) on the hand, N: the sum of the next three")
      .def_property_readonly("contact_N", copied(&ServoOutput::contact_N), "(3,) of the geometric contact, N")
      .def_property_readonly("texture_N", copied(&ServoOutput::texture_N), "(3,) of the texture, N")
      .def_property_readonly("friction_N", copied(&ServoOutput::friction_N), "(3,) of friction, N")
      .def_property_readonly("proxy_m", copied(&ServoOutput::proxy_m),
                             "(3,) where the tip's centre would be on a rigid surface, m")
      .def_property_readonly("point_m", copied_of_contact(&SurfaceContact::p_world_m),
                             "(3,) the point of the surface in contact, m; 0 without contact")
      .def_property_readonly("normal", copied_of_contact(&SurfaceContact::normal_world),
                             "(3,) unit normal there, towards the tip; 0 without contact")
      .def_property_readonly("barycentric", copied_of_contact(&SurfaceContact::barycentric),
                             "(3,) the point's weights of the triangle's corners; 0 without contact")
      .def_property_readonly("triangle", index_of_contact(&SurfaceContact::triangle),
                             "The triangle in contact, in its object; None without contact.")
      .def_property_readonly("object", index_of_contact(&SurfaceContact::object),
                             "The object in contact; None without contact.")
      .def_property_readonly(
          "texture_height_m", [](const Touch& touch) { return touch.out.texture_height_m; },
          "Height of the texture at the contact, m; 0 where there is none.")
      .def_readonly("vibration_N", &Touch::vibration_N,
                    "The part of the force that vibrates, as one signed number, N: for an actuator of one axis.")
      .def_property_readonly(
          "sticking", [](const Touch& touch) { return touch.out.sticking; }, "Friction holds the tip.")
      .def_property_readonly(
          "starts_inside", [](const Touch& touch) { return touch.out.starts_inside; },
          "The tip has begun inside an object: no force until it has left it.")
      .def_property_readonly(
          "touching", [](const Touch& touch) { return touch.out.contact.found(); }, "Something is in contact.")
      .def("__repr__", [](const Touch& touch) {
        const Eigen::Vector3d& f = touch.out.force_N;
        return std::string("<asperity.Touch: ") + (touch.out.contact.found() ? "touching" : "free") + ", force " +
               std::string(py::str("[{:.4g}, {:.4g}, {:.4g}] N").format(f.x(), f.y(), f.z())) + ">";
      });
  refuse_unmade<Touch>();
}

}  // namespace

void add_rendering(py::module_& module) {
  add_touch(module);
  py::class_<Renderer>(module, "Renderer",
                       "One tip over a scene: forces of its steps, at 1 kHz and faster. One thread steps at a time; "
                       "another raises RuntimeError. update() is for any thread.")
      .def(py::init<const SharedScene&, double, const Settings&>(), py::arg("scene"), py::arg("rate_Hz") = 1000.0,
           py::arg("settings") = py::dict(),
           "rate_Hz: of the steps, 100 to 20000. settings: those of settings('render'), such as tip_radius_m. Of the "
           "scene as it is now; update() takes a changed one.")
      .def("step", &Renderer::step, py::arg("position_m"), py::arg("velocity_mps") = py::none(),
           py::arg("dt_s") = py::none(),
           "One step to a position of the tip's centre (3,), m. velocity_mps: (3,), m/s; without it that from the "
           "last position, 0 for the first. dt_s: time since the last step, s; without it 1 / rate_Hz. The first "
           "step is outside of all objects, or there is no force.")
      .def("steps", &Renderer::steps, py::arg("positions_m"), py::arg("velocities_mps") = py::none(),
           py::arg("dt_s") = py::none(),
           "Steps to positions (n, 3), m, one after the other and after those of the last call, without Python's "
           "lock. velocities_mps: (n, 3), m/s; without them those between the positions. dt_s: as of step. Gives a "
           "dict of arrays named as the properties of Touch: force_N, contact_N, texture_N, friction_N, proxy_m, "
           "point_m and normal (n, 3); texture_height_m, vibration_N, triangle, object, touching, sticking and "
           "starts_inside (n,). triangle and object are 4294967295 without contact. After KeyboardInterrupt the tip "
           "is where it was before the call.")
      .def("update", &Renderer::update, py::arg("scene") = py::none(), py::arg("settings") = py::dict(),
           "Another scene, or other settings (those not named stay), from the next step on, also while another thread "
           "steps. Materials and textures change over texture.cross_fade_s. Meshes, poses and the tip's radius act at "
           "once: the force may jump where the tip is in contact. Two threads that update at once: the second gets "
           "RuntimeError. What is refused changes nothing.")
      .def_property_readonly("rate_Hz", &Renderer::rate_Hz, "Steps a second that it was made for, Hz.")
      .def("reset", &Renderer::reset, "The tip was lifted and set elsewhere: nothing is remembered.")
      .def("__repr__", [](const Renderer& renderer) {
        return "<asperity.Renderer: " + std::string(py::str("{:g}").format(renderer.rate_Hz())) + " Hz>";
      });
  refuse_unmade<Renderer>();
}

}  // namespace asperity::python
