#include <pybind11/stl.h>

#include "arrays.h"
#include "asperity/base/config.h"
#include "asperity/profile/measure_roughness.h"
#include "parts.h"

namespace asperity::python {

namespace {

py::dict roughness(const Doubles& height_m, double spacing_m, const py::dict& settings) {
  const std::span<const double> heights = numbers_of(height_m, "height_m");
  RoughnessConfig config;
  set_all(config, settings);
  RoughnessResult result;
  {
    const py::gil_scoped_release unlocked;
    result = measure_roughness(heights, spacing_m, config);
  }
  py::dict out;
  for (const RoughnessParameter& parameter : kRoughnessParameters)
    out[py::str(std::string(parameter.key))] = result.*parameter.value;
  out["length_m"] = result.length_m;
  out["missing"] = result.missing;
  return out;
}

}  // namespace

void add_roughness(py::module_& module) {
  module.def(
      "roughness", &roughness, py::arg("height_m"), py::arg("spacing_m"), py::arg("settings") = py::dict(),
      "Roughness parameters (ISO 21920-2) of heights (n,), m, spacing_m apart, nan where missing. settings: those "
      "of `asperity roughness --set` without `roughness.`.");
}

}  // namespace asperity::python
