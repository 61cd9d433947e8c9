#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace asperity {

// The square markers of ArUco (Garrido-Jurado et al., 2014): `bits` by `bits` cells within a black border of one cell.
struct ArucoDictionary {
  int bits = 0;                                    // cells a side, without the border
  std::vector<std::vector<std::uint8_t>> markers;  // by id: bits·bits cells, row by row, 1 for white
  int correctable_bits = 0;                        // wrong cells with which a marker is still told from all others
};

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
