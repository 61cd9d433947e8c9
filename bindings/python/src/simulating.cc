#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "asperity/base/text.h"
#include "asperity/simulation/make_surface.h"
#include "asperity/simulation/simulate_recording.h"
#include "asperity/simulation/simulation_config.h"
#include "inputs.h"
#include "interruptible.h"
#include "mesh.h"
#include "parts.h"

namespace asperity::python {

namespace {

using MeshOrFile = std::variant<const Mesh*, std::filesystem::path>;

// "x,y,z;x,y,z", exactly.
std::string path_text(py::handle through_m) {
  std::string out;
  const Rows points(through_m, "through_m");
  for (const Eigen::Vector3d& p_m : points.all()) {
    out += out.empty() ? "" : ";";
    out += number_text(p_m.x()) + "," + number_text(p_m.y()) + "," + number_text(p_m.z());
  }
  return out;
}

SimulationConfig config_of(const std::filesystem::path& surface, const Text<"probe">& probe,
                           std::optional<double> speed_mps, std::int64_t seed, const Settings& settings,
                           const Text<"material">& material,
                           const std::optional<Text<"object_motion">>& object_motion) {
  SimulationConfig config = make_simulation_config(surface.string(), probe.of, material.of);
  py::dict named;
  if (speed_mps) named["hand.speed_mps"] = *speed_mps;
  if (object_motion) named["object.motion"] = object_motion->of;
  named["seed"] = seed;
  set_all(config, named);
  set_all(config, settings.of);
  return config;
}

Recording simulate(const std::filesystem::path& surface, const Text<"probe">& probe, std::optional<double> speed_mps,
                   std::int64_t seed, const Settings& settings, const Text<"material">& material,
                   const std::optional<MeshOrFile>& mesh, std::optional<double> mesh_unit_m,
                   const std::optional<py::object>& through_m,
                   const std::optional<Text<"object_motion">>& object_motion) {
  SimulationConfig config = config_of(surface, probe, speed_mps, seed, settings, material, object_motion);
  if (!mesh) {
    if (mesh_unit_m) throw py::value_error("mesh_unit_m: there is no mesh");
    if (through_m) throw py::value_error("through_m: there is no mesh");
    return interruptible([&](const Observer& observer) { return simulate_recording(config, observer); });
  }
  config.shape.kind = BaseShapeKind::kMesh;
  if (through_m) config.shape.through = path_text(*through_m);
  if (const auto* file = std::get_if<std::filesystem::path>(&*mesh)) {
    config.shape.mesh_file = file->string();
    if (mesh_unit_m) config.shape.mesh_unit_m = unit_of(*mesh_unit_m, "mesh_unit_m");
    return interruptible([&](const Observer& observer) { return simulate_recording(config, observer); });
  }
  if (mesh_unit_m) throw py::value_error("mesh_unit_m: a Mesh is in metres");
  const Mesh& of = *std::get<const Mesh*>(*mesh);
  return interruptible([&](const Observer& observer) {
    const auto relief = make_surface(
        config.surface, static_cast<std::uint64_t>(config.surface.seed != 0 ? config.surface.seed : config.seed));
    return simulate_recording(config, *relief, of.mesh, observer);
  });
}

}  // namespace

void add_simulating(py::module_& module) {
  module.def(
      "simulate", &simulate, py::arg("surface") = "protoboard", py::arg("probe") = "open",
      py::arg("speed_mps") = py::none(), py::arg("seed") = 1, py::arg("settings") = py::dict(),
      py::arg("material") = "stiff", py::arg("mesh") = py::none(), py::arg("mesh_unit_m") = py::none(),
      py::arg("through_m") = py::none(), py::arg("object_motion") = py::none(),
      "A recording of the virtual bench, with its truth. surface: protoboard, sandpaper, sine, clay_pot, "
      "cable_tie or a file of heights; probe: 'open' or 'what'; material: 'stiff', 'cork' or 'soft_rubber'. "
      "mesh: a Mesh, or a file to scan over, with mesh_unit_m as unit_m of read_mesh; through_m: (n, 3) points of "
      "the path over it, in its frame, m, else one is chosen. object_motion: 'none', 'held' or 'turned'. settings: "
      "those of settings('simulate'). The same seed gives the same recording.");
}

}  // namespace asperity::python
