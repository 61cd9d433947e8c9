#pragma once

#include "asperity/json/json.h"
#include "asperity/recording/calibration.h"

namespace asperity {

inline constexpr const char* kCameraCovariance = "camera_covariance";  // of a calibration's `extra`

// Nine rows of nine numbers, as `extra.camera_covariance` has them. What is no covariance (another shape, a negative
// variance) gives false and leaves the camera as it is.
bool take_camera_covariance(const Json& value, CameraCalibration& camera);

// The camera's own; null where it has none.
Json camera_covariance_json(const CameraCalibration& camera);

}  // namespace asperity
