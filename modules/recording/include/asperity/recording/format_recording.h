#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "asperity/recording/recording.h"

namespace asperity {

// The files of a recording as text, exact and deterministic. Throws Error for a number that JSON
// cannot hold (nan, inf) and for an `extra` that is not a JSON object.

std::string format_recording_info(const RecordingInfo& info);
std::string format_calibration(const Calibration& calibration);
// markers.json, the body's markers in our tag frame (read_markers.h).
std::string format_markers(const std::vector<MarkerPlacement>& markers);

// The camera and the markers of a calibration.json.
Json camera_json(const CameraCalibration& camera);
Json markers_json(const std::vector<MarkerPlacement>& markers);

// The header line of probe.csv for the sensors there are, and of tracker.csv; with their newline.
std::string probe_header(bool has_gyro, bool has_force3);
std::string tracker_header(bool has_markers, bool has_reprojection, bool has_sigmas = false, bool has_noise = false);

// Appends rows `first` to `last` (exclusive) as lines; a sample that is nan gives an empty cell.
void append_probe_rows(std::string& out, const ProbeStream& probe, std::size_t first, std::size_t last);
void append_tracker_rows(std::string& out, const TrackerStream& tracker, std::size_t first, std::size_t last);

std::string format_probe_csv(const ProbeStream& probe);
std::string format_tracker_csv(const TrackerStream& tracker);
std::string format_truth_csv(const Truth& truth);

}  // namespace asperity
