#pragma once

#include <memory>
#include <string>

#include "asperity/tracking/detect_tags.h"

namespace asperity {

// AprilTag 3 (Wang and Olson, 2016; Krogius et al., 2019), by libapriltag. `family` is one of is_apriltag_family().
std::unique_ptr<TagDetector> make_apriltag_detector(const std::string& family, const TagDetectorConfig& config);

}  // namespace asperity
