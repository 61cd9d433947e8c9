#include <pybind11/pybind11.h>

#include "asperity/base/error.h"
#include "asperity/base/version.h"
#include "parts.h"

namespace asperity::python {

namespace py = pybind11;

std::string setting_text(py::handle value) {
  const std::string text = py::str(value);  // of a bool of NumPy, too
  return text == "True" ? "true" : text == "False" ? "false" : text;
}

}  // namespace asperity::python

PYBIND11_MODULE(_asperity, module) {
  namespace py = pybind11;
  module.attr("__version__") = asperity::kVersion;
  py::register_exception<asperity::Error>(module, "Error", PyExc_ValueError).attr("__doc__") =
      "What was given cannot be used; the text says what, where and why.";
  asperity::python::add_recordings(module);
  asperity::python::add_importing(module);
  asperity::python::add_textures(module);
  asperity::python::add_roughness(module);
  asperity::python::add_processing(module);
  asperity::python::add_meshes(module);
  asperity::python::add_rendering(module);
  asperity::python::add_registering(module);
}
