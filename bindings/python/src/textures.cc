#include <filesystem>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "arrays.h"
#include "asperity/base/config.h"
#include "asperity/texture/fit_fourier1d.h"
#include "asperity/texture/synthesize_stroke.h"
#include "asperity/texture/texture.h"
#include "asperity/texture/texture_file.h"
#include "asperity/texture/texture_model_traits.h"
#include "parts.h"

namespace asperity::python {

namespace {

// x along the scan path, y across it; a number serves for all.
py::array_t<double> heights(const Texture& texture, const Doubles& x_m, const Doubles& y_m) {
  const std::span<const double> x = numbers_of(x_m, "x_m"), y = numbers_of(y_m, "y_m");
  if (y.size() != x.size() && y.size() != 1) throw py::value_error("y_m: one number, or as many as x_m");
  py::array_t<double> out(static_cast<py::ssize_t>(x.size()));
  double* const heights_m = out.mutable_data();
  const py::gil_scoped_release unlocked;
  std::visit(
      [&]<class Model>(const Model& model) {
        if constexpr (HeightField<Model>) {
          for (std::size_t i = 0; i < x.size(); ++i)
            heights_m[i] = TextureModelTraits<Model>::height(model, x[i], y[y.size() == 1 ? 0 : i]).height_m;
        } else {
          throw Error("a texture of the model '" + std::string(TextureModelTraits<Model>::kName) +
                      "' has no heights: it is a vibration in time");
        }
      },
      texture.model);
  return out;
}

Texture fit(const Doubles& height_m, double spacing_m, const py::dict& settings) {
  FitFourier1dConfig config;
  set_all(config, settings);
  const FourierFit fitted = fit_fourier1d(numbers_of(height_m, "height_m"), spacing_m, config);
  Texture out;
  out.model = fitted.texture;
  out.height_offset_m = fitted.height_offset_m;
  return out;
}

py::array_t<double> vibration(const Texture& texture, const py::dict& settings) {
  StrokeConfig config;
  set_all(config, settings);
  const std::vector<double> samples = synthesize_stroke(texture, config);
  return py::array_t<double>(static_cast<py::ssize_t>(samples.size()), samples.data());
}

}  // namespace

void add_textures(py::module_& module) {
  py::class_<Texture>(module, "Texture",
                      "A model of a surface's fine heights, or of the vibration of a stroke over it.")
      .def_readwrite("name", &Texture::name)
      .def_property_readonly("model", [](const Texture& t) { return std::string(t.model_name()); })
      .def_readwrite("friction", &Texture::friction)
      .def_readwrite("stiffness_N_per_m", &Texture::stiffness_N_per_m)
      .def_property_readonly("height_sigma_m", [](const Texture& t) { return t.height_sigma_m; })
      .def("heights", &heights, py::arg("x_m"), py::arg("y_m") = 0.0,
           "Heights (n,), m, at x_m (n,) along the scan path and y_m (n,) or a number across it.")
      .def("vibration", &vibration, py::arg("settings") = py::dict(),
           "Acceleration (n,), m/s2, of a tool that strokes it: speed_mps, force_N, rate_Hz, duration_s, seed.")
      .def(
          "write", [](const Texture& t, const std::filesystem::path& file) { write_texture(file, t); }, py::arg("file"),
          "Write it as FILE.texture.json, with an image or a table beside it where the model has one.")
      .def("__repr__",
           [](const Texture& t) { return "<asperity.Texture '" + t.name + "', " + std::string(t.model_name()) + ">"; });
  module.def(
      "read_texture", [](const std::filesystem::path& file) { return read_texture(file); }, py::arg("file"),
      "Read a *.texture.json. Raises Error naming file and key.");
  module.def("fit_texture", &fit, py::arg("height_m"), py::arg("spacing_m"), py::arg("settings") = py::dict(),
             "A Fourier series of heights (n,), m, spacing_m apart, nan in gaps. settings: length_mm, coefficients and "
             "others of `asperity texture fit --set` without `fourier1d.`.");
}

}  // namespace asperity::python
