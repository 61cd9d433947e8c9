#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "asperity/base/text.h"
#include "asperity/import/mapping_config.h"
#include "asperity/pipeline/merge_results.h"
#include "asperity/pipeline/process_config.h"
#include "asperity/pipeline/register_config.h"
#include "asperity/profile/measure_roughness.h"
#include "asperity/recording/import_imu_pose.h"
#include "asperity/recording/inspect_recording.h"
#include "asperity/render/render_model.h"
#include "asperity/simulation/simulation_config.h"
#include "asperity/texture/synthesize_stroke.h"
#include "asperity/texture/texture_fit.h"
#include "named_arguments.h"
#include "parts.h"

namespace asperity::python {

namespace {

// Name, default and meaning of each field.
template <class Config>
py::dict described(Config config) {
  py::dict out;
  for (const ConfigField& field : list_fields("", config)) {
    py::dict one;
    one["default"] = std::visit([](const auto& value) { return py::cast(value); }, field.get());
    one["meaning"] = field.description;
    out[py::str(field.path)] = one;
  }
  return out;
}

const std::map<std::string, std::function<py::dict()>>& lists() {
  static const std::map<std::string, std::function<py::dict()>> all{
      {"simulate", [] { return described(SimulationConfig{}); }},
      {"process", [] { return described(ProcessConfig{}); }},
      {"inspect", [] { return described(InspectConfig{}); }},
      {"merge", [] { return described(MergeConfig{}); }},
      {"import", [] { return described(ImportSettings{}); }},
      {"register", [] { return described(RegisterConfig{}); }},
      {"roughness", [] { return described(RoughnessConfig{}); }},
      {"fit", [] { return described(TextureFitOptions{}); }},
      {"vibration", [] { return described(StrokeConfig{}); }},
      {"render", [] { return described(RenderConfig{}); }},
  };
  return all;
}

py::dict settings_of(const Text<"of">& given) {
  const std::string& of = given.of;
  const auto found = lists().find(of);
  if (found != lists().end()) return found->second();
  std::string names;
  for (const auto& [name, list] : lists()) names += (names.empty() ? "" : ", ") + name;
  throw py::value_error("of: '" + printable(of) + "' is not one of " + names);
}

}  // namespace

std::string setting_text(const std::string& name, py::handle value) {
  const bool is_array = py::isinstance<py::array>(value);
  const auto dimensions = is_array ? py::len(value.attr("shape")) : 0;
  if (py::isinstance<py::tuple>(value) || py::isinstance<py::list>(value) || dimensions == 1) {
    std::string out = "[";
    for (const py::handle one : value) out += (out.size() > 1 ? ", " : "") + setting_text(name, one);
    return out + "]";
  }
  if (PyUnicode_Check(value.ptr())) return utf8_of(value, ("settings: " + printable(name)).c_str());
  if (py::hasattr(value, "__fspath__")) return value.cast<std::filesystem::path>().string();
  const py::module_ numbers = py::module_::import("numbers"), numpy = py::module_::import("numpy");
  const bool is_number = py::isinstance(value, numbers.attr("Real")) || py::isinstance(value, numpy.attr("bool_")) ||
                         py::isinstance(value, py::module_::import("decimal").attr("Decimal")) ||
                         (is_array && dimensions == 0);
  if (!is_number) {
    throw py::type_error("settings: " + printable(name) + ": a str, a number, True, False or a list is wanted, not " +
                         std::string(py::str(py::type::handle_of(value).attr("__name__"))));
  }
  const std::string text = py::str(value);
  return text == "True" ? "true" : text == "False" ? "false" : text;
}

void add_settings(py::module_& module) {
  module.def("settings", &settings_of, py::arg("of") = "process",
             "All settings of a function, by name a dict with its default and meaning. of: simulate, process, inspect, "
             "merge, import, register, roughness, fit, vibration or render.");
}

}  // namespace asperity::python
