#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/recording/calibration.h"
#include "asperity/recording/read_limits.h"
#include "asperity/recording/tag_frame.h"

namespace asperity {

// A body's markers. T_marker_tag is always in terms of our tag frame, that of AprilTag: x right, y down, z into the
// tag, for a tag upright as libapriltag draws it; a file that declares another one is converted when it is read.
struct MarkerFile {
  std::vector<MarkerPlacement> markers;
  TagFrame declared = TagFrame::kAprilTag;
};

// markers.json, {"markers":[…]} with "tag_frame":"apriltag"|"opencv"|"opencv_upright" where it is not ours, or a
// calibration.json with "markers" (its "tag_frame" in "extra"). Throws Error naming the file and the key: no marker, a
// marker given twice, more than 1000, or a value out of range. A family "aruco:FILE.yml" is a dictionary's file in the
// folder of the body's; read_markers gives it with that folder before it.
MarkerFile parse_markers(std::string_view text, const std::string& name, const ReadLimits& limits = {});
MarkerFile read_markers(const std::filesystem::path& path, const ReadLimits& limits = {});

// The camera of a calibration.json, of which nothing else needs to be there. Throws Error naming the file and the key.
CameraCalibration parse_camera(std::string_view text, const std::string& name, const ReadLimits& limits = {});
CameraCalibration read_camera(const std::filesystem::path& path, const ReadLimits& limits = {});

}  // namespace asperity
