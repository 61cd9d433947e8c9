#include <pybind11/pybind11.h>

#include "asperity/base/version.h"
#include "parts.h"

PYBIND11_MODULE(_asperity, module) {
  module.attr("__version__") = asperity::kVersion;
  asperity::python::add_errors(module);
  asperity::python::add_settings(module);
  asperity::python::add_meshes(module);
  asperity::python::add_recordings(module);
  asperity::python::add_simulating(module);
  asperity::python::add_importing(module);
  asperity::python::add_textures(module);
  asperity::python::add_texture_fits(module);
  asperity::python::add_roughness(module);
  asperity::python::add_processing(module);
  asperity::python::add_scenes(module);
  asperity::python::add_rendering(module);
  asperity::python::add_registering(module);
  asperity::python::add_aligning(module);
}
