#include <filesystem>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "arrays.h"
#include "asperity/base/config.h"
#include "asperity/base/error.h"
#include "asperity/session/our_file.h"
#include "asperity/texture/material_limits.h"
#include "asperity/texture/synthesize_stroke.h"
#include "asperity/texture/texture_file.h"
#include "asperity/texture/texture_model_traits.h"
#include "inputs.h"
#include "interruptible.h"
#include "parts.h"
#include "shared_texture.h"
#include "unmade.h"

namespace asperity::python {

namespace {

// x along the scan path, y across it; a number serves for all.
py::array_t<double> heights(const SharedTexture& texture, py::handle x_m, py::handle y_m) {
  const Numbers along = places_of(x_m, "x_m"), across = places_of(y_m, "y_m");
  if (across.size() != along.size() && across.size() != 1) throw py::value_error("y_m: one number, or as many as x_m");
  py::array_t<double> out = column_of(along.size());
  double* const heights_m = out.mutable_data();
  interruptible([&, of = texture.share()](const Observer& observer) {
    std::visit(
        [&]<class Model>(const Model& model) {
          if constexpr (HeightField<Model>) {
            in_blocks(observer, along.size(), [&, x = along.all(), y = across.all()](std::size_t i) {
              heights_m[i] = TextureModelTraits<Model>::height(model, x[i], y[y.size() == 1 ? 0 : i]).height_m;
            });
          } else {
            throw Error("a texture of the model '" + std::string(TextureModelTraits<Model>::kName) +
                        "' has no heights: it is a vibration in time");
          }
        },
        of->model);
  });
  return out;
}

py::array_t<double> vibration(const SharedTexture& texture, const Settings& settings) {
  StrokeConfig config;
  set_all(config, settings.of);
  return owned(interruptible(
      [&, of = texture.share()](const Observer& observer) { return synthesize_stroke(*of, config, observer); }));
}

SharedTexture read(const std::filesystem::path& file) {
  return interruptible([&](const Observer& observer) { return SharedTexture(read_texture(file, {}, observer)); });
}

void write(const SharedTexture& texture, const std::filesystem::path& file) {
  interruptible([&, of = texture.share()](const Observer&) {
    refuse_stranger(file, begins_as_texture);
    write_texture(file, *of);
  });
}

// What JSON has no type for: mappings of other kinds, and numbers and arrays of NumPy.
py::object plain(const py::object& value) {
  if (py::hasattr(value, "tolist")) return value.attr("tolist")();
  return dict_of(value, "content");
}

// What a texture's file holds, of models whose numbers are all in it.
SharedTexture make_texture(const MappingArgument<"content">& content) {
  const py::object dumps = py::module_::import("json").attr("dumps");
  const std::string text = py::str(dumps(content.of, py::arg("default") = py::cpp_function(&plain)));
  return interruptible(
      [&](const Observer& observer) { return SharedTexture(parse_texture(text, "content", {}, observer)); });
}

py::object content_of(const SharedTexture& texture) {
  const std::string text = interruptible([of = texture.share()](const Observer&) { return format_texture(*of); });
  return py::module_::import("json").attr("loads")(text);
}

void set(SharedTexture& texture, std::optional<double> Texture::*member, std::optional<double> value,
         const Range& limits, const char* name) {
  if (value) within(*value, limits, name);
  texture.change().*member = value;
}

}  // namespace

void add_textures(py::module_& module) {
  py::class_<SharedTexture>(module, "Texture",
                            "A model of a surface's fine heights, or of the vibration of a stroke over it. That of a "
                            "result or scene cannot be changed; a copy can.")
      .def_property(
          "name", [](const SharedTexture& t) { return t.get().name; },
          [](SharedTexture& t, Text<"name"> name) { t.change().name = std::move(name.of); }, "Its name, for people.")
      .def_property_readonly(
          "model", [](const SharedTexture& t) { return std::string(t.get().model_name()); },
          "The model's name: fourier1d, fourier2d, heightmap, areal, stochastic, autoregressive or "
          "decaying_sinusoids.")
      .def_property(
          "friction", [](const SharedTexture& t) { return t.get().friction; },
          [](SharedTexture& t, std::optional<double> value) {
            set(t, &Texture::friction, value, kFrictionLimits, "friction");
          },
          "Coefficient of sliding, 0 to 10; None: the scene's.")
      .def_property(
          "stiffness_N_per_m", [](const SharedTexture& t) { return t.get().stiffness_N_per_m; },
          [](SharedTexture& t, std::optional<double> value) {
            set(t, &Texture::stiffness_N_per_m, value, kStiffnessLimits_N_per_m, "stiffness_N_per_m");
          },
          "Stiffness of the surface, 1 to 1e6 N/m; None: the scene's.")
      .def_property_readonly(
          "height_sigma_m", [](const SharedTexture& t) { return t.get().height_sigma_m; },
          "Standard deviation of the heights' error, m; None: not known.")
      .def_property_readonly(
          "roughness", [](const SharedTexture& t) { return t.get().roughness; },
          "Parameters of the heights that it was made from, by name: Ra_m, Rq_m, …")
      .def_property_readonly("content", &content_of,
                             "All of *.texture.json as a dict, for make_texture; a copy. An image or a table beside "
                             "it is named only.")
      .def("heights", &heights, py::arg("x_m"), py::arg("y_m") = 0.0,
           "Heights (n,), m, at x_m (n,) along the scan path and y_m (n,) or a number across it, m. x = 0 is where the "
           "window begins that was fitted: of fit_texture the height with the index content['extra']['fit']"
           "['first_sample'] (fourier1d, and what is outer or pattern), of `process` and `merge` the s_m that "
           "summary['texture']['start_m'] states. A texture of register_scans has x = 0 at the scan's s_m = 0, one of "
           "fit_areal_texture the x_m and y_m of its points.")
      .def("vibration", &vibration, py::arg("settings") = py::dict(),
           "Acceleration (n,), m/s2, of a tool that strokes it: speed_mps, force_N, rate_Hz, duration_s, seed and "
           "others of settings('vibration').")
      .def(
          "copy", [](const SharedTexture& t) { return SharedTexture(t.get()); }, "A copy, which can be changed.")
      .def("write", &write, py::arg("file"),
           "Write it as FILE.texture.json, with an image or a table beside it where the model has one. A file of other "
           "content is not replaced.")
      .def("__repr__", [](const SharedTexture& t) {
        return "<asperity.Texture '" + t.get().name + "', " + std::string(t.get().model_name()) + ">";
      });
  refuse_unmade<SharedTexture>();
  module.def("read_texture", &read, py::arg("file"), "Read a *.texture.json. Raises Error naming file and key.");
  module.def("make_texture", &make_texture, py::arg("content"),
             "A Texture of coefficients: a dict as *.texture.json holds it (docs/texture.md), such as that of "
             "Texture.content. Models whose image or table is another file are for read_texture.");
}

}  // namespace asperity::python
