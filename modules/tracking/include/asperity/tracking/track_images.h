#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "asperity/base/progress.h"
#include "asperity/camera/camera_source.h"
#include "asperity/tracking/track_body.h"
#include "asperity/verdict/verdict.h"

namespace asperity {

struct TrackedImages {
  std::size_t frames = 0;
  std::vector<TrackedPose> poses;  // by time
  std::size_t ambiguous = 0;       // poses whose plane could lie the other way as well
  double median_reprojection_px = std::numeric_limits<double>::quiet_NaN();
  Eigen::Vector3d median_sigma_m = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());    // x, y, z
  Eigen::Vector3d median_sigma_rad = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());  // about them
  std::vector<MarkerPlacement> body;  // in terms of our tag frame, as it was found to be meant
  Problems problems;
  bool trustworthy = true;  // none of `verdicts` is invalid
  std::string verdict;      // the list as one sentence; empty: valid
  Verdicts verdicts;
};

// Follows a body through all images of a source, which `open` opens; once more from the beginning if the tags' frame
// turned out to be another than the one declared, so that all poses agree. An image that cannot be read throws.
// `frames_expected` is for the progress shown; 0: unknown.
TrackedImages track_images(const std::function<std::unique_ptr<CameraSource>()>& open, const CameraCalibration& camera,
                           const std::vector<MarkerPlacement>& body, const TrackConfig& config = {},
                           const Observer& observer = {}, std::size_t frames_expected = 0);

// A tracker.csv with the columns sigma_px_m … sigma_rz_rad behind its own: standard errors along and about the world's
// axes. Its first line begins with tracked_csv_header().
std::string format_tracked_csv(const std::vector<TrackedPose>& poses);
std::string tracked_csv_header();

}  // namespace asperity
