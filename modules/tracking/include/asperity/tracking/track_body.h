#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "asperity/base/problem.h"
#include "asperity/image/gray_image.h"
#include "asperity/recording/calibration.h"
#include "asperity/tracking/detect_tags.h"
#include "asperity/tracking/find_tag_frame.h"
#include "asperity/tracking/pose_source.h"
#include "asperity/tracking/refine_corners.h"
#include "asperity/tracking/solve_body_pose.h"
#include "asperity/tracking/tracked_pose.h"

namespace asperity {

struct TrackConfig {
  TagDetectorConfig detector;
  RefineCornersConfig refine;
  BodyPoseConfig pose;
  int most_pixels = 3600;       // of all tags of a frame that are compared with their pictures
  double region_margin = 0.25;  // round the predicted body, of its size in the image
  double largest_reprojection_px = 2.0;
  double longest_gap_s = 0.25;  // a pose predicts no longer than this
  double fastest_mps = 5.0;     // a single tag that has jumped farther is not the body's
  double fastest_radps = 60.0;
  bool find_tag_frame = true;
  bool find_faint = true;    // where no tag is seen: look again, in parts of the grey levels
  bool find_covered = true;  // tags that were not detected, by their picture, where the others say they are

  template <class V>
  void visit(V& v) {
    v.group("detector", detector);
    v.group("refine", refine);
    v.group("pose", pose);
    v.field("most_pixels", most_pixels, "of all tags of a frame that are compared with their pictures",
            {200, 10'000'000});
    v.field("region_margin", region_margin, "round the predicted body, of its size in the image", {0.0, 10.0});
    v.field("largest_reprojection_px", largest_reprojection_px, "a worse pose is none", {0.01, 100.0});
    v.field("longest_gap_s", longest_gap_s, "a pose predicts no longer than this", {0.0, 10.0});
    v.field("fastest_mps", fastest_mps, "a single tag that has jumped farther is not the body's", {0.01, 1000.0});
    v.field("fastest_radps", fastest_radps, "a single tag that has rotated farther is not the body's", {0.1, 10000.0});
    v.field("find_tag_frame", find_tag_frame,
            "find the rotation of the tags' frames where the declared one does not fit");
    v.field("find_faint", find_faint, "where no tag is seen: look again, in parts of the grey levels");
    v.field("find_covered", find_covered,
            "tags that were not detected, by their picture, where the others say they are");
  }
};

// Follows a rigid body of tags from frame to frame: predict by the last two poses, look for tags round the prediction
// (in the whole image where there is none, or nothing was found; then in parts of its grey levels, for tags of little
// contrast), refine their corners, solve the pose, look for tags that were not detected by their picture, solve it
// again. One thread at a time.
class BodyTracker {
 public:
  // Throws Error for a camera without a focal length, a body without tags or a family that is not known.
  BodyTracker(CameraCalibration camera, std::vector<MarkerPlacement> body, TrackConfig config = {});
  ~BodyTracker();
  BodyTracker(BodyTracker&&) noexcept;
  BodyTracker& operator=(BodyTracker&&) noexcept;

  // The body's pose in the camera's frame; nullopt if it was not found. Times are to rise. Throws Error if the image is
  // not of the camera's size, naming both.
  std::optional<TrackedPose> push(const GrayImage& image, std::int64_t t_ns);

  const TrackingStatistics& statistics() const;

  // The body, in terms of our tag frame: as it was given, or as it was found to be meant. When another tag frame has
  // been found, poses before it were none, or of a single tag in the frame declared: push those frames again to a
  // tracker of this body.
  const std::vector<MarkerPlacement>& body() const;
  bool tag_frame_was_changed() const;
  // What a person should know: that the tags' frames were found to be other than declared.
  const Problems& problems() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace asperity
