#include <pybind11/stl.h>

#include "arrays.h"
#include "asperity/base/config.h"
#include "asperity/profile/extract_texture.h"
#include "asperity/profile/make_profile.h"
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

// New heights (n,).
py::array_t<double> extract(const Doubles& height_m, double spacing_m, double cutoff_cycles_per_mm) {
  const std::span<const double> heights = numbers_of(height_m, "height_m");
  std::vector<double> out;
  {
    const py::gil_scoped_release unlocked;
    out = extract_texture(heights, spacing_m, cutoff_cycles_per_mm, ProfileConfig().bridge_m);
  }
  return py::array_t<double>(static_cast<py::ssize_t>(out.size()), out.data());
}

}  // namespace

void add_roughness(py::module_& module) {
  module.def(
      "roughness", &roughness, py::arg("height_m"), py::arg("spacing_m"), py::arg("settings") = py::dict(),
      "Roughness parameters (ISO 21920-2) of heights (n,), m, spacing_m apart, nan where missing. settings: those "
      "of `asperity roughness --set` without `roughness.`.");
  module.def("extract_texture", &extract, py::arg("height_m"), py::arg("spacing_m"),
             py::arg("cutoff_cycles_per_mm") = ProfileConfig().cutoff_cycles_per_mm,
             "Heights (n,) less their long waves, as `process` makes texture_m of height_m: a zero-phase Butterworth "
             "high-pass of second order, -3 dB at cutoff_cycles_per_mm. nan are gaps. Of a measured profile and of "
             "the one that it is compared with, so that both have the same band.");
}

}  // namespace asperity::python
