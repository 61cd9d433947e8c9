#pragma once

#include <optional>
#include <string_view>

namespace asperity {

struct CharucoDictionary {
  int opencv_id = 0;  // cv::aruco::PREDEFINED_DICTIONARY_NAME
  int markers = 0;
};

// By OpenCV's name, for example "DICT_4X4_50".
std::optional<CharucoDictionary> find_charuco_dictionary(std::string_view name);

}  // namespace asperity
