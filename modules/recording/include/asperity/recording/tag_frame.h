#pragma once

#include <optional>
#include <string_view>

#include <Eigen/Geometry>

namespace asperity {

// The orientation of a tag's frame on the tag, where there are several habits (docs/tracking.md).
enum class TagFrame {
  kAprilTag,       // x right, y down, z into the tag
  kOpenCv,         // x right, y up, z out of the tag, for a tag upright as OpenCV draws it
  kOpenCvUpright,  // the same for a tag upright as libapriltag draws it
};

// "apriltag", "opencv" or "opencv_upright": as it is declared in a file.
std::string_view name_of(TagFrame frame);
std::optional<TagFrame> tag_frame_of(std::string_view name);

// The rotation that maps our tag frame's coordinates into those of `frame` for a tag of `family`.
Eigen::Quaterniond R_frame_tag(TagFrame frame, std::string_view family);

}  // namespace asperity
