#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "arrays.h"
#include "asperity/base/config.h"
#include "asperity/base/folder_content.h"
#include "asperity/base/output.h"
#include "asperity/pipeline/merge_results.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/pipeline/result_json.h"
#include "asperity/pipeline/write_result.h"
#include "asperity/session/merge_input.h"
#include "interruptible.h"
#include "parts.h"
#include "shared_texture.h"
#include "unmade.h"
#include "verdicts.h"

namespace asperity::python {

namespace {

// A result with the recording that it is of: what it writes names it.
struct Result {
  ProcessResult result;
  std::shared_ptr<const Recording> recording;
  std::string name;
  std::optional<MergeConfig> merged;  // of strokes: without a recording and a motion of its own
};

std::shared_ptr<Result> process(std::shared_ptr<const Recording> recording, const Text<"name">& name,
                                const Settings& settings) {
  ProcessConfig config;
  set_all(config, settings.of);
  auto out = std::make_shared<Result>();
  out->result =
      interruptible([&](const Observer& observer) { return process_recording(*recording, config, observer); });
  out->recording = std::move(recording);
  out->name = name.of;
  return out;
}

void write(const Result& of, const std::filesystem::path& folder) {
  const LockFreed unlocked;
  OutputFolder out(folder, naming_added(is_result_folder));
  if (of.merged) {
    write_merge(out.path(), of.result, *of.merged, of.name);
  } else {
    write_result(out.path(), of.result, *of.recording, of.name);
  }
  out.commit();
}

// Strokes over one line as one profile. Folders are recordings, or what `write` and `asperity process` have written
// with profile.remove_noise off.
std::shared_ptr<Result> merge(const std::vector<std::filesystem::path>& strokes, const Settings& settings) {
  MergeConfig config;
  set_all(config, settings.of);
  if (strokes.size() < 2) throw py::value_error("strokes: at least two are wanted");
  return interruptible([&](const Observer& observer) {
    std::vector<std::string> paths;
    for (const std::filesystem::path& stroke : strokes) paths.push_back(stroke.string());
    const std::vector<std::string> names = stroke_names(paths);
    MergeInput input;
    for (std::size_t i = 0; i < paths.size(); ++i) add_stroke(input, paths[i], names[i], config, observer);
    auto out = std::make_shared<Result>();
    out->name = input.title();
    out->result = merge_results(input.strokes, out->name, config);
    if (out->result.texture) note_sources(*out->result.texture, input.sources);
    out->merged = config;
    return out;
  });
}

// A property that is a view of a vector in the result.
template <class Get>
auto viewed(Get get) {
  return [get](py::object self) { return view(get(self.cast<const Result&>().result), self); };
}

}  // namespace

void add_processing(py::module_& module) {
  using R = ProcessResult;
  py::class_<Result, std::shared_ptr<Result>>(module, "Result",
                                              "What `process` measures, each figure with its error; see `summary`.")
      .def_property_readonly(
          "trustworthy", [](const Result& of) { return of.result.trustworthy; }, "No verdict is invalid.")
      .def_property_readonly(
          "verdict", [](const Result& of) { return of.result.verdict; },
          "The verdicts in a sentence; empty if none is invalid or limited.")
      .def_property_readonly(
          "verdicts", [](const Result& of) { return verdicts_of(of.result.verdicts); },
          "The worst first: code, severity, message, remedy.")
      .def_property_readonly("s_m", viewed([](const R& r) -> auto& { return r.profile.s_m; }),
                             "(n,) arc length along the base path, m, evenly spaced")
      .def_property_readonly("height_m", viewed([](const R& r) -> auto& { return r.profile.height_m; }),
                             "(n,) height along the outward normal, m; nan in gaps")
      .def_property_readonly("height_sigma_m", viewed([](const R& r) -> auto& { return r.profile.sigma_m; }),
                             "(n,) its standard deviation, m")
      .def_property_readonly("texture_m", viewed([](const R& r) -> auto& { return r.profile.texture_m; }),
                             "(n,) height after the high-pass, m; nan in gaps")
      .def_property_readonly("texture_sigma_m", viewed([](const R& r) -> auto& { return r.profile.texture_sigma_m; }),
                             "(n,) its standard deviation, m")
      .def_property_readonly("force_N", viewed([](const R& r) -> auto& { return r.profile.force_N; }),
                             "(n,) contact force along the normal, N")
      .def_property_readonly("speed_mps", viewed([](const R& r) -> auto& { return r.profile.speed_mps; }),
                             "(n,) speed along the base path, m/s")
      .def_property_readonly(
          "spacing_m", [](const Result& of) { return of.result.profile.spacing_m; }, "Distance of s_m's points, m.")
      .def_property_readonly("spectrum_cycles_per_mm",
                             viewed([](const R& r) -> auto& { return r.spectrum.frequency_cycles_per_mm; }),
                             "(k,) wave numbers of the texture's power spectrum, cycles/mm")
      .def_property_readonly("spectrum_m2_mm", viewed([](const R& r) -> auto& { return r.spectrum.density_m2_mm; }),
                             "(k,) density of the surface, its noise taken off, m² mm")
      .def_property_readonly("spectrum_low_m2_mm", viewed([](const R& r) -> auto& { return r.spectrum.low_m2_mm; }),
                             "(k,) lower end of its interval of 95 %")
      .def_property_readonly("spectrum_high_m2_mm", viewed([](const R& r) -> auto& { return r.spectrum.high_m2_mm; }),
                             "(k,) upper end of it")
      .def_property_readonly("spectrum_noise_m2_mm", viewed([](const R& r) -> auto& { return r.spectrum.noise_m2_mm; }),
                             "(k,) what was taken off")
      .def_property_readonly("t_ns", viewed([](const R& r) -> auto& { return r.trajectory.motion.t_ns; }),
                             "(m,) int64, times of the tip's motion, ns")
      .def_property_readonly("position_m",
                             viewed([](const R& r) -> auto& { return r.trajectory.motion.p_world_tip_m; }),
                             "(m, 3) the tip in the world frame, m")
      .def_property_readonly("velocity_mps",
                             viewed([](const R& r) -> auto& { return r.trajectory.motion.v_world_tip_mps; }),
                             "(m, 3) its velocity, m/s")
      .def_property_readonly("orientation_xyzw",
                             viewed([](const R& r) -> auto& { return r.trajectory.motion.q_world_marker; }),
                             "(m, 4) the marker's orientation, quaternions x y z w")
      .def_property_readonly(
          "texture",
          [](const std::shared_ptr<Result>& of) -> std::optional<SharedTexture> {
            if (!of->result.texture) return std::nullopt;
            return SharedTexture(std::shared_ptr<const Texture>(of, &*of->result.texture), "result");
          },
          "The Texture, or None where there is none. It cannot be changed; its copy() can.")
      .def_property_readonly(
          "summary",
          [](const Result& of) {
            return py::module_::import("json").attr("loads")((of.merged
                                                                  ? merge_json(of.result, *of.merged, of.name)
                                                                  : result_json(of.result, *of.recording, of.name))
                                                                 .dump_repaired());
          },
          "All of result.json as a dict: figures with their standard errors, verdicts, settings.")
      .def(
          "write", &write, py::arg("folder"),
          "Write trajectory.csv, profile.csv, spectrum.csv, texture.json and result.json into a folder; one that holds "
          "anything but a result is not replaced.")
      .def("__repr__", [](const Result& of) {
        return "<asperity.Result '" + of.name + "': " + std::to_string(of.result.profile.s_m.size()) + " heights, " +
               (of.result.trustworthy ? "valid" : "invalid") + ">";
      });
  refuse_unmade<Result>();
  module.def("merge", &merge, py::arg("strokes"), py::arg("settings") = py::dict(),
             "One profile of two or more strokes over one line, aligned and averaged by their noise: folders of "
             "recordings, or of results that were made with profile.remove_noise off. settings: those of "
             "settings('merge'). `summary` is that of the merge; there is no motion.");
  module.def("process", &process, py::arg("recording").none(false), py::arg("name") = "recording",
             py::arg("settings") = py::dict(),
             "From a recording to profile, roughness and texture. settings: those of settings('process').");
}

}  // namespace asperity::python
