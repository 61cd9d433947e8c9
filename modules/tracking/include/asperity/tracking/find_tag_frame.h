#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "asperity/tracking/seen_tag.h"
#include "asperity/tracking/solve_body_pose.h"

namespace asperity {

// Which of a square's eight frames a body's T_marker_tag mean.
struct TagFrameFinding {
  Eigen::Quaterniond R_frame_tag = Eigen::Quaterniond::Identity();  // from our tag frame's coordinates into the body's
  bool as_declared = true;           // identity: the body means what it says, or nothing else fits better
  bool determined = false;           // a frame with two tags fits one of the eight
  double error_px = 0.0;             // mean distance of the corners, each at most 20 px, as found
  double declared_error_px = 0.0;    // and with the frame declared
  std::string description;           // of the frame found, for a person: "x right, y up, z out of the tag, …"
  std::vector<std::string> as_good;  // descriptions of the other frames that fit alike: the images cannot tell
};

// Solves the body's pose in each frame, in which two or more tags are seen, with the tags' frames turned and mirrored
// in all eight ways. Another way than the one declared is adopted only where that does not fit and the other does: a
// body whose tags lie so that several fit alike (two beside each other, both upright) keeps what it declares. Of
// several others that fit alike the most usual is taken: OpenCV's on AprilTag's picture, OpenCV's on its own, the rest.
TagFrameFinding find_tag_frame(const CameraCalibration& camera, const std::vector<MarkerPlacement>& body,
                               std::span<const std::vector<SeenTag>> frames, const BodyPoseConfig& config = {});

// The body in terms of our tag frame, when its own is `R_frame_tag`.
std::vector<MarkerPlacement> with_tag_frame(std::vector<MarkerPlacement> body, const Eigen::Quaterniond& R_frame_tag);

}  // namespace asperity
