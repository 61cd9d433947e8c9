#pragma once

#include <memory>
#include <string>

#include "asperity/tracking/detect_tags.h"

namespace asperity {

// ArUco markers for the tracker. `family` is "aruco:" and a name of OpenCV's or a dictionary's file (*.yml, *.yaml).
std::unique_ptr<TagDetector> make_aruco_tag_detector(const std::string& family);

}  // namespace asperity
