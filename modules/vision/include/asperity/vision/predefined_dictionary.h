#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace asperity {

// A dictionary of markers that OpenCV has.
struct PredefinedDictionary {
  std::string_view name;
  int opencv_id = 0;  // cv::aruco::PREDEFINED_DICTIONARY_NAME
  int markers = 0;
};

// By OpenCV's name: DICT_4X4_50 … DICT_7X7_1000, DICT_ARUCO_ORIGINAL, DICT_APRILTAG_16h5 … DICT_APRILTAG_36h11.
std::optional<PredefinedDictionary> find_predefined_dictionary(std::string_view name);

// All names, with a comma between them, for messages.
std::string predefined_dictionary_names();

}  // namespace asperity
