#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "asperity/vision/vision.h"

namespace asperity {

// One of OpenCV's, by its name there: DICT_4X4_50 … DICT_7X7_1000, DICT_ARUCO_ORIGINAL, DICT_APRILTAG_16h5 …
// DICT_APRILTAG_36h11 (those in OpenCV's turn). Throws Error naming what there is.
ArucoDictionary predefined_aruco_dictionary(std::string_view name);

// A dictionary in OpenCV's YAML: nmarkers, markersize (2 to 16) and marker_0 … marker_(nmarkers−1), each the cells as a
// text of 0 and 1 in quotes or without; maxCorrectionBits where it is given, else half of what the least distance
// between two markers in any turn, or of one from itself turned, is more than. Keys may come in any order; nothing else
// of YAML is read. Throws Error naming file and line: an unknown or repeated key, a wrong count of cells, a marker that
// is missing, more than 2000 markers, two markers alike in some turn.
ArucoDictionary parse_aruco_dictionary(std::string_view text, const std::string& name);
ArucoDictionary read_aruco_dictionary(const std::filesystem::path& path);

// The file that a family's name names, "aruco:FILE.yml" (or .yaml); empty for other names.
std::string aruco_file(std::string_view family);

}  // namespace asperity
