#pragma once

#include <string>
#include <vector>

#include <pybind11/pybind11.h>

#include "asperity/base/config.h"

// The parts of the Python module, each a file.
namespace asperity::python {

namespace py = pybind11;

void add_recordings(pybind11::module_& module);
void add_importing(pybind11::module_& module);
void add_processing(pybind11::module_& module);
void add_registering(pybind11::module_& module);
void add_roughness(pybind11::module_& module);
void add_textures(pybind11::module_& module);
void add_meshes(pybind11::module_& module);
void add_rendering(pybind11::module_& module);

// A setting's value as `--set` has it: True and False in lower case, all else as Python writes it.
std::string setting_text(pybind11::handle value);

// Sets fields of `config` by their names; throws Error for one that there is not or that cannot be.
template <class Config>
void set_all(Config& config, const pybind11::dict& settings) {
  const std::vector<ConfigField> fields = list_fields("", config);
  for (const auto& [name, value] : settings) set_field(fields, std::string(pybind11::str(name)), setting_text(value));
}

}  // namespace asperity::python
