#include <pybind11/stl.h>

#include "arrays.h"
#include "asperity/base/config.h"
#include "asperity/profile/extract_texture.h"
#include "asperity/profile/make_profile.h"
#include "asperity/profile/measure_roughness.h"
#include "inputs.h"
#include "interruptible.h"
#include "parts.h"

namespace asperity::python {

namespace {

py::dict roughness(py::handle height_m, double spacing_m, const Settings& settings) {
  const Numbers heights(height_m, "height_m", Masked::kMissing);
  RoughnessConfig config;
  set_all(config, settings.of);
  const RoughnessResult result = interruptible(
      [&](const Observer& observer) { return measure_roughness(heights.all(), spacing_m, config, observer); });
  py::dict out;
  for (const RoughnessParameter& parameter : kRoughnessParameters)
    out[py::str(std::string(parameter.key))] = result.*parameter.value;
  out["length_m"] = result.length_m;
  out["missing"] = result.missing;
  return out;
}

// New heights (n,).
py::array_t<double> extract(py::handle height_m, double spacing_m, double cutoff_cycles_per_mm) {
  const Numbers heights(height_m, "height_m", Masked::kMissing);
  return owned(interruptible([&](const Observer& observer) {
    return extract_texture(heights.all(), spacing_m, cutoff_cycles_per_mm, ProfileConfig().bridge_m, {}, observer);
  }));
}

}  // namespace

void add_roughness(py::module_& module) {
  module.def("roughness", &roughness, py::arg("height_m"), py::arg("spacing_m"), py::arg("settings") = py::dict(),
             "Roughness parameters (ISO 21920-2) of heights (n,), m, spacing_m apart, nan or masked where missing. "
             "settings: those of settings('roughness').");
  module.def("extract_texture", &extract, py::arg("height_m"), py::arg("spacing_m"),
             py::arg("cutoff_cycles_per_mm") = ProfileConfig().cutoff_cycles_per_mm,
             "Heights (n,), m, less their long waves, as `process` makes texture_m of height_m: a zero-phase "
             "Butterworth high-pass of second order, -3 dB at cutoff_cycles_per_mm. nan and masked values are gaps. "
             "Of a measured profile and of the one that it is compared with, so that both have the same band.");
}

}  // namespace asperity::python
