#pragma once

#include <filesystem>

#include "asperity/recording/recording.h"

namespace asperity {

// Writes all files of a recording into an existing folder (an OutputFolder's, so that it appears as a
// whole). Numbers are written so that they read back exactly; the same recording gives the same bytes.
// `recording.problems` is not written: it belongs to the reading. Throws Error if the recording breaks
// a rule of validate_recording, or a file cannot be written.
void write_recording(const std::filesystem::path& folder, const Recording& recording);

// One file, replaced as a whole.
void write_recording_info(const std::filesystem::path& path, const RecordingInfo& info);
void write_calibration(const std::filesystem::path& path, const Calibration& calibration);

}  // namespace asperity
