#include <filesystem>
#include <string>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/import/import_mapped.h"
#include "interruptible.h"
#include "parts.h"

namespace asperity::python {

namespace {

Recording import_recording(const std::filesystem::path& pose, const std::filesystem::path& imu,
                           const std::filesystem::path& gyro, const std::filesystem::path& force,
                           const std::filesystem::path& object_pose, const Settings& settings, bool unchecked) {
  ImportSettings config;
  set_all(config, settings.of);
  return interruptible([&](const Observer& observer) {
    ImportTables tables = read_import_tables({pose, imu, gyro, force, object_pose}, config.mapping, {}, observer);
    const ImportedMotion motion = read_imported_motion(tables, config.mapping, observer);
    std::string doubts;
    for (const ImportDoubt& doubt : motion.checks.doubts)
      doubts += (doubts.empty() ? "" : "\n") + doubt_text(doubt, tables, as_argument);
    if (!doubts.empty() && !unchecked) throw Error(doubts);
    observer.update("import", 0.95);
    Recording out = make_imported_recording(motion, tables, config.mapping, config.import);
    for (const ImportDoubt& doubt : motion.checks.doubts) {
      out.problems.push_back({"implausible", doubt_text(doubt, tables, as_argument), 1});
      ++out.info.problems["implausible"];
    }
    return out;
  });
}

}  // namespace

std::string as_argument(const StatedSetting& setting) {
  const std::string& value = setting.value;
  const bool is_text = value != "true" && value != "false" && !parse_double(value);
  return "settings={'" + setting.path + "': " +
         (is_text            ? "'" + value + "'"
          : value == "true"  ? "True"
          : value == "false" ? "False"
                             : value) +
         "}";
}

void add_importing(py::module_& module) {
  module.def(
      "import_recording", &import_recording, py::arg("pose"), py::arg("imu") = "", py::arg("gyro") = "",
      py::arg("force") = "", py::arg("object_pose") = "", py::arg("settings") = py::dict(),
      py::arg("unchecked") = false,
      "A recording from tables of other programs: poses, an inertial sensor, a force, the object's poses. One "
      "file with all is `pose`. Columns and units are guessed from headers and values; settings state them, those "
      "of settings('import') (mapping.pose.columns, mapping.tip_m, import.tracker_sigma_m, …). "
      "Raises Error where units or axes look implausible, unless unchecked: they are then in `problems`.");
}

}  // namespace asperity::python
