#include <filesystem>
#include <memory>
#include <optional>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "arrays.h"
#include "asperity/base/config.h"
#include "asperity/base/output.h"
#include "asperity/recording/inspect_recording.h"
#include "asperity/recording/read_recording.h"
#include "asperity/recording/recording_source.h"
#include "asperity/recording/validate_recording.h"
#include "asperity/recording/write_recording.h"
#include "interruptible.h"
#include "parts.h"
#include "unmade.h"

namespace asperity::python {

namespace {

py::object inspect(const Recording& recording, const Settings& settings) {
  InspectConfig config;
  set_all(config, settings.of);
  const std::string json = interruptible(
      [&](const Observer&) { return inspection_json(inspect_recording(recording, config)).dump_repaired(); });
  return py::module_::import("json").attr("loads")(json);
}

void write(const Recording& recording, const std::filesystem::path& folder) {
  interruptible([&](const Observer&) {
    OutputFolder out(folder, replaceable_by(source_of(recording)));
    write_recording(out.path(), recording);
    out.commit();
  });
}

}  // namespace

void add_recordings(py::module_& module) {
  py::class_<Truth>(module, "Truth", "What a simulation knows, at the time of each sample that the probe took.")
      .def_property_readonly(
          "t_ns", [](py::object self) { return view(self.cast<const Truth&>().t_ns, self); },
          "(n,) int64, true times of the samples, ns")
      .def_property_readonly(
          "s_m", [](py::object self) { return view(self.cast<const Truth&>().s_m, self); },
          "(n,) arc length along the base surface, m")
      .def_property_readonly(
          "height_m", [](py::object self) { return view(self.cast<const Truth&>().height_m, self); },
          "(n,) height of the tip along the base surface's normal, m")
      .def_property_readonly(
          "position_m", [](py::object self) { return view(self.cast<const Truth&>().p_world_tip_m, self); },
          "(n, 3) the tip in the world frame, m")
      .def_property_readonly(
          "force_N", [](py::object self) { return view(self.cast<const Truth&>().force_N, self); },
          "(n,) contact force, N")
      .def("__repr__",
           [](const Truth& truth) { return "<asperity.Truth: " + std::to_string(truth.t_ns.size()) + " samples>"; });
  refuse_unmade<Truth>();

  py::class_<Recording, std::shared_ptr<Recording>>(
      module, "Recording", "A probe's and a tracker's streams with their calibration, as recorded.")
      .def_property_readonly(
          "object", [](const Recording& r) { return r.info.object; }, "What was scanned, as stated.")
      .def_property_readonly(
          "probe_model", [](const Recording& r) { return r.info.probe_model; }, "The probe's model, as stated.")
      .def_property_readonly(
          "problems",
          [](const Recording& r) {
            std::vector<std::string> out;
            for (const Problem& problem : r.problems) out.push_back(problem.message);
            return out;
          },
          "What reading found damaged and repaired or left out.")
      .def_property_readonly(
          "t_ns", [](py::object self) { return view(self.cast<const Recording&>().probe.t_ns, self); },
          "(n,) int64, times of the probe's samples, ns")
      .def_property_readonly(
          "accel_counts", [](py::object self) { return view(self.cast<const Recording&>().probe.accel_counts, self); },
          "(n, 3) readings of the accelerometer")
      .def_property_readonly(
          "force_counts", [](py::object self) { return view(self.cast<const Recording&>().probe.force_counts, self); },
          "(n,) readings of the force sensor; nan where it has none")
      .def_property_readonly(
          "gyro_counts", [](py::object self) { return view(self.cast<const Recording&>().probe.gyro_counts, self); },
          "(n, 3) readings of the gyroscope; (0, 3) without one")
      .def_property_readonly(
          "tracker_t_ns", [](py::object self) { return view(self.cast<const Recording&>().tracker.t_ns, self); },
          "(m,) int64, times of the poses as received, ns")
      .def_property_readonly(
          "tracker_position_m",
          [](const Recording& r) {
            py::array_t<double> out = rows_of_three(r.tracker.size());
            for (std::size_t i = 0; i < r.tracker.size(); ++i)
              Eigen::Vector3d::Map(out.mutable_data(static_cast<py::ssize_t>(i), 0)) =
                  r.tracker.T_world_marker[i].translation_m;
            return out;
          },
          "(m, 3) the marker in the world frame, m; a copy")
      .def_property_readonly(
          "tracker_orientation_xyzw",
          [](const Recording& r) {
            py::array_t<double> out({static_cast<py::ssize_t>(r.tracker.size()), py::ssize_t{4}});
            for (std::size_t i = 0; i < r.tracker.size(); ++i)
              Eigen::Vector4d::Map(out.mutable_data(static_cast<py::ssize_t>(i), 0)) =
                  r.tracker.T_world_marker[i].rotation.coeffs();
            return out;
          },
          "(m, 4) quaternions that turn the marker's frame into the world's, x y z w; a copy")
      .def_property_readonly(
          "truth",
          [](py::object self) -> py::object {
            const auto& truth = self.cast<const Recording&>().truth;
            if (!truth) return py::none();
            return py::cast(*truth, py::return_value_policy::reference_internal, self);
          },
          "Truth of a simulated recording, else None.")
      .def("write", &write, py::arg("folder"),
           "Write it as a folder. A folder that holds anything but a simulated or imported recording is not replaced.")
      .def("inspect", &inspect, py::arg("settings") = py::dict(),
           "Rates, gaps, losses, saturation, static noise and faults (findings) as a dict, as `asperity inspect` "
           "finds them. settings: those of settings('inspect').")
      .def(
          "validate", [](const Recording& r) { interruptible([&](const Observer&) { validate_recording(r); }); },
          "Raises Error, naming stream and row, unless times rise, vectors have one length, and readings, poses and "
          "calibration are finite.")
      .def(
          "__len__", [](const Recording& r) { return r.probe.size(); }, "The number of the probe's samples.")
      .def("__repr__", [](const Recording& r) {
        return "<asperity.Recording of '" + r.info.object + "': " + std::to_string(r.probe.size()) + " samples, " +
               std::to_string(r.tracker.size()) + " poses>";
      });
  refuse_unmade<Recording>();

  module.def(
      "read_recording",
      [](const std::filesystem::path& folder) {
        return interruptible([&](const Observer& observer) { return read_recording(folder, {}, observer); });
      },
      py::arg("folder"), "Read a recording's folder. Raises Error naming file, line and value.");
}

}  // namespace asperity::python
