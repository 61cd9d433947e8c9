#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "asperity/camera/camera_source.h"
#include "asperity/tracking/pose_source.h"
#include "asperity/tracking/track_body.h"

namespace asperity {

struct CameraPoseConfig {
  bool newest = true;            // pass over frames that came while the last was worked on; false for files: take each
  double nominal_rate_Hz = 0.0;  // 0: unknown
};

// The poses of a marker body in a camera's images, and of `further` bodies in the same ones: of a frame the first
// body's pose comes first, then theirs in order, `sample.body` saying whose. The statistics are the first body's.
// `on_frame`, if not empty, is given every frame that was read, the ones passed over too, in the thread that reads.
std::unique_ptr<PoseSource> make_camera_pose_source(std::unique_ptr<CameraSource> camera, BodyTracker tracker,
                                                    const CameraPoseConfig& config = {},
                                                    std::function<void(const CameraFrame&)> on_frame = {},
                                                    std::vector<BodyTracker> further = {});

// A tracker for each further body that the markers are on, in the order of bodies_of(). Throws as BodyTracker does.
std::vector<BodyTracker> make_further_trackers(const CameraCalibration& camera,
                                               const std::vector<MarkerPlacement>& markers, const TrackConfig& config);

}  // namespace asperity
