#pragma once

#include <functional>
#include <memory>

#include "asperity/camera/camera_source.h"
#include "asperity/tracking/pose_source.h"
#include "asperity/tracking/track_body.h"

namespace asperity {

struct CameraPoseConfig {
  bool newest = true;            // pass over frames that came while the last was worked on; false for files: take each
  double nominal_rate_Hz = 0.0;  // 0: unknown
};

// The poses of a marker body in a camera's images. `on_frame`, if not empty, is given every frame that was read, the
// ones passed over too, in the thread that reads.
std::unique_ptr<PoseSource> make_camera_pose_source(std::unique_ptr<CameraSource> camera, BodyTracker tracker,
                                                    const CameraPoseConfig& config = {},
                                                    std::function<void(const CameraFrame&)> on_frame = {});

}  // namespace asperity
