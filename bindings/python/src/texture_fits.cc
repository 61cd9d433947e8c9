#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/stl.h>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/profile/find_periodicity.h"
#include "asperity/session/texture_input.h"
#include "asperity/texture/evaluate_height.h"
#include "asperity/texture/texture_fit.h"
#include "inputs.h"
#include "interruptible.h"
#include "parts.h"
#include "shared_texture.h"

namespace asperity::python {

namespace {

// The names that fits of memory have in place of files.
const std::string kAlong = "height_m", kAcross = "height_across_m", kSamples = "height_m",
                  kSeries = "acceleration_mps2";

FittedModelChoice choice_of(const std::string& model, const std::vector<std::string>& possible) {
  std::string all;
  for (const std::string& name : possible) all += (all.empty() ? "" : ", ") + name;
  for (std::size_t k = 0; k < kFittedModelNames.size(); ++k) {
    const bool is_possible = std::find(possible.begin(), possible.end(), model) != possible.end();
    if (kFittedModelNames[k] == model && is_possible) return static_cast<FittedModelChoice>(k);
  }
  throw py::value_error("model: '" + printable(model) + "' is not one of " + all);
}

// Settings with or without the model's group before them.
TextureFitOptions options_of(const Settings& settings, const std::string& group) {
  TextureFitOptions out;
  const std::vector<ConfigField> fields = list_fields("", out);
  for (const auto& [key, value] : settings.of) {
    const std::string name = utf8_of(key, "settings: a name");
    set_field(fields, name.find('.') == std::string::npos ? group + "." + name : name, setting_text(name, value));
  }
  return out;
}

SharedTexture finish(FittedTexture fitted, const std::string& name) {
  Texture& texture = fitted.texture;
  if (is_height_field(texture.model)) texture.height_offset_m = height_offset_m(texture.model);
  texture.name = name;
  Json problems = Json::array();
  for (const Problem& problem : fitted.problems)
    problems.push_back({{"kind", problem.kind}, {"message", problem.message}, {"count", problem.count}});
  fitted.report["problems"] = problems;
  texture.fit = {fitted.report, texture.fit ? texture.fit->place : texture.extra.size()};
  return SharedTexture(std::move(texture));
}

SharedTexture fit(TextureFitInput& input, FittedModelChoice choice, const TextureFitOptions& options,
                  const std::string& name) {
  input.roughness = [](const std::vector<std::vector<double>>& lines_m, double spacing_m) {
    return roughness_of(lines_m, spacing_m);
  };
  input.is_texture_file = [](const std::string&) { return false; };
  return interruptible([&](const Observer& observer) {
    input.observer = observer;
    return finish(fit_texture(choice, input, options), name);
  });
}

std::vector<double> copy_of(const Numbers& numbers) { return {numbers.all().begin(), numbers.all().end()}; }

SharedTexture fit_heights(py::handle height_m, double spacing_m, const Settings& settings, const Text<"model">& model,
                          const std::optional<py::object>& height_across_m, const Text<"name">& name) {
  const FittedModelChoice choice = choice_of(model.of, {"fourier1d", "fourier2d", "heightmap", "stochastic"});
  const TextureFitOptions options = options_of(settings, model.of);
  HeightLine along{copy_of(Numbers(height_m, "height_m", Masked::kMissing)), spacing_m}, across{{}, spacing_m};
  TextureFitInput input;
  input.files = {kAlong};
  if (height_across_m) {
    if (model.of != "fourier2d" && model.of != "heightmap")
      throw py::value_error("height_across_m: for the models fourier2d and heightmap alone");
    across.height_m = copy_of(Numbers(*height_across_m, "height_across_m", Masked::kMissing));
    input.files.push_back(kAcross);
  }
  input.read_heights = [&](const std::vector<std::string>& files) { return files.front() == kAcross ? across : along; };
  input.pitch_m = [&](const std::vector<std::string>& files) {
    const HeightLine& line = files.front() == kAcross ? across : along;
    const Periodicity found = find_periodicity(line.height_m, line.spacing_m, {});
    return found.periodic ? found.pitch_m : 0.0;
  };
  return fit(input, choice, options, name.of);
}

SharedTexture fit_area(py::handle x_m, py::handle y_m, py::handle height_m, const Settings& settings,
                       const Text<"name">& name) {
  const TextureFitOptions options = options_of(settings, "areal");
  const Numbers x(x_m, "x_m"), y(y_m, "y_m"), z(height_m, "height_m", Masked::kMissing);
  if (x.size() != z.size() || y.size() != z.size()) throw py::value_error("x_m, y_m: as many as height_m are wanted");
  TextureFitInput input;
  input.files = {kSamples};
  input.read_areal_samples = [&](const std::vector<std::string>&) {
    std::vector<ArealSample> out(z.size());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = {x.all()[i], y.all()[i], z.all()[i]};
    return out;
  };
  return fit(input, choice_of("areal", {"areal"}), options, name.of);
}

SharedTexture fit_vibration(py::handle acceleration_mps2, py::handle speed_mps, py::handle force_N, double rate_Hz,
                            const Settings& settings, const Text<"name">& name) {
  const TextureFitOptions options = options_of(settings, "autoregressive");
  SeriesTable table{copy_of(Numbers(acceleration_mps2, "acceleration_mps2")), copy_of(Numbers(speed_mps, "speed_mps")),
                    copy_of(Numbers(force_N, "force_N")), within(rate_Hz, {1.0, 1e7}, "rate_Hz")};
  for (std::vector<double>* one : {&table.speed_mps, &table.force_N})
    if (one->size() == 1) one->assign(table.acceleration_mps2.size(), one->front());
  TextureFitInput input;
  input.files = {kSeries};
  input.read_recording_or_series = [&](const std::string&) { return table; };
  return fit(input, choice_of("autoregressive", {"autoregressive"}), options, name.of);
}

}  // namespace

void add_texture_fits(py::module_& module) {
  module.def("fit_texture", &fit_heights, py::arg("height_m"), py::arg("spacing_m"), py::arg("settings") = py::dict(),
             py::arg("model") = "fourier1d", py::arg("height_across_m") = py::none(), py::arg("name") = "",
             "A texture of heights (n,), m, spacing_m apart, nan or masked in gaps. model: fourier1d, stochastic, or "
             "the surfaces fourier2d and heightmap, of one profile or of it and one across it. settings: those of "
             "settings('fit'), without the model's name before them or with any group's.");
  module.def("fit_areal_texture", &fit_area, py::arg("x_m"), py::arg("y_m"), py::arg("height_m"),
             py::arg("settings") = py::dict(), py::arg("name") = "",
             "A smooth surface through heights (n,), m, at places x_m and y_m (n,), m, as of a map or many strokes. "
             "settings: those of settings('fit') under areal, such as spacing_mm.");
  module.def("fit_vibration_texture", &fit_vibration, py::arg("acceleration_mps2"), py::arg("speed_mps"),
             py::arg("force_N"), py::arg("rate_Hz"), py::arg("settings") = py::dict(), py::arg("name") = "",
             "Autoregressive models of a tool's acceleration (n,), m/s2, with its speed, m/s, and force, N, each (n,) "
             "or a number. settings: those of settings('fit') under autoregressive.");
}

}  // namespace asperity::python
