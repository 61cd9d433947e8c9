#include "asperity/recording/write_recording.h"

#include <string>

#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/recording/format_recording.h"
#include "asperity/recording/validate_recording.h"
#include "block_checksums.h"

namespace asperity {

void write_recording_info(const std::filesystem::path& path, const RecordingInfo& info) {
  write_file(path, format_recording_info(info));
}

void write_calibration(const std::filesystem::path& path, const Calibration& calibration) {
  write_file(path, format_calibration(calibration));
}

void write_recording(const std::filesystem::path& folder, const Recording& recording) {
  validate_recording(recording);
  const std::string probe = format_probe_csv(recording.probe), tracker = format_tracker_csv(recording.tracker);
  write_file(folder / "probe.csv", probe);
  write_file(folder / "tracker.csv", tracker);
  std::string checksums =
      checksum_header() + checksum_lines("probe.csv", probe) + checksum_lines("tracker.csv", tracker);
  for (std::size_t i = 0; i < recording.info.bodies.size(); ++i) {
    const std::string file = body_file(recording.info.bodies[i].name);
    const std::string poses = format_tracker_csv(recording.body_poses[i]);
    write_file(folder / file, poses);
    checksums += checksum_lines(file, poses);
  }
  write_file(folder / kChecksumFile, checksums);
  if (recording.truth) write_file(folder / "truth.csv", format_truth_csv(*recording.truth));
  write_calibration(folder / "calibration.json", recording.calibration);
  write_recording_info(folder / "recording.json", recording.info);
}

}  // namespace asperity
