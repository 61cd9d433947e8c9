#pragma once

#include <string>
#include <vector>

#include <pybind11/pybind11.h>

#include "asperity/base/config.h"
#include "asperity/import/mapping_config.h"
#include "asperity/recording/import_imu_pose.h"

// The parts of the Python module, each a file.
namespace asperity::python {

namespace py = pybind11;

void add_errors(pybind11::module_& module);
void add_settings(pybind11::module_& module);
void add_recordings(pybind11::module_& module);
void add_simulating(pybind11::module_& module);
void add_importing(pybind11::module_& module);
void add_processing(pybind11::module_& module);
void add_registering(pybind11::module_& module);
void add_aligning(pybind11::module_& module);
void add_roughness(pybind11::module_& module);
void add_textures(pybind11::module_& module);
void add_texture_fits(pybind11::module_& module);
void add_meshes(pybind11::module_& module);
void add_scenes(pybind11::module_& module);
void add_rendering(pybind11::module_& module);

// The settings of an import, by the groups that the command has them in.
struct ImportSettings {
  ImportConfig import;
  MappingConfig mapping;

  template <class V>
  void visit(V& v) {
    v.group("import", import);
    v.group("mapping", mapping);
  }
};

// A setting's value as text: True and False in lower case, tuples, lists and arrays in brackets, all else as Python
// writes it.
std::string setting_text(pybind11::handle value);

// Sets fields of `config` by their names; throws Error for one that there is not or that cannot be.
template <class Config>
void set_all(Config& config, const pybind11::dict& settings) {
  const std::vector<ConfigField> fields = list_fields("", config);
  for (const auto& [name, value] : settings) set_field(fields, std::string(pybind11::str(name)), setting_text(value));
}

}  // namespace asperity::python
