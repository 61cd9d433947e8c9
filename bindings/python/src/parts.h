#pragma once

#include <string>
#include <vector>

#include <pybind11/pybind11.h>

#include "asperity/base/config.h"
#include "asperity/import/mapping_config.h"
#include "asperity/import/stated_setting.h"
#include "asperity/recording/import_imu_pose.h"
#include "named_arguments.h"

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

// As Python states it: settings={'mapping.euler': 'zyx'}.
std::string as_argument(const StatedSetting& setting);

// The value of the setting `name` as text: True and False in lower case, tuples, lists and arrays in brackets, paths as
// the file system has them, numbers as Python writes them. Throws TypeError for what is none of these.
std::string setting_text(const std::string& name, pybind11::handle value);

// Sets fields of `config` by their names; throws Error for one that there is not or that cannot be.
template <class Config>
void set_all(Config& config, const pybind11::dict& settings) {
  const std::vector<ConfigField> fields = list_fields("", config);
  for (const auto& [key, value] : settings) {
    const std::string name = utf8_of(key, "settings: a name");
    set_field(fields, name, setting_text(name, value));
  }
}

}  // namespace asperity::python
