#include "asperity/recording/tag_frame.h"

namespace asperity {

std::string_view name_of(TagFrame frame) {
  if (frame == TagFrame::kAprilTag) return "apriltag";
  return frame == TagFrame::kOpenCv ? "opencv" : "opencv_upright";
}

Eigen::Quaterniond R_frame_tag(TagFrame frame, std::string_view family) {
  if (frame == TagFrame::kAprilTag) return Eigen::Quaterniond::Identity();
  // OpenCV's frame is x right, y up, z towards the viewer, and its pictures of AprilTag's first families are turned by
  // half a turn in their plane.
  const bool turned = frame == TagFrame::kOpenCv &&
                      (family == "tag36h11" || family == "tag36h10" || family == "tag25h9" || family == "tag16h5");
  return turned ? Eigen::Quaterniond(0.0, 0.0, 1.0, 0.0) : Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0);
}

std::optional<TagFrame> tag_frame_of(std::string_view name) {
  for (const TagFrame frame : {TagFrame::kAprilTag, TagFrame::kOpenCv, TagFrame::kOpenCvUpright}) {
    if (name == name_of(frame)) return frame;
  }
  return std::nullopt;
}

}  // namespace asperity
