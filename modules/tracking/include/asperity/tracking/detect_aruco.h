#pragma once

#include <memory>
#include <vector>

#include "asperity/image/gray_image.h"
#include "asperity/tracking/aruco_dictionary.h"
#include "asperity/tracking/tracked_pose.h"

namespace asperity {

struct ArucoConfig {
  double smallest_perimeter = 0.03;
  double false_alarms = 1e-3;

  template <class V>
  void visit(V& v) {
    v.field("smallest_perimeter", smallest_perimeter, "of a marker, over the image's larger side", {0.005, 4.0});
    v.field("false_alarms", false_alarms,
            "share of random squares that are taken for markers: bounds the wrong cells that are put right",
            {0.0, 1.0});
  }
};

// Finds ArUco markers by OpenCV's detector without its refinement of corners, which leaves them 0.2 px inside (by
// windows about corners) or 0.5 px (by contours); ours fits lines to the sides. One thread at a time.
class ArucoDetector {
 public:
  explicit ArucoDetector(const ArucoDictionary& dictionary, const ArucoConfig& config = {});
  ~ArucoDetector();

  // The markers in the image by rising id. Corners in px, the centre of the first pixel at (0, 0): of the black border,
  // top left, top right, bottom right, bottom left of the marker upright.
  std::vector<TagDetection> detect(const GrayImage& image) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace asperity
