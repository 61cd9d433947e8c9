#pragma once

#include "asperity/json/json_object.h"
#include "asperity/recording/calibration.h"

namespace asperity {

// Objects that calibration.json shares with other files.
CameraCalibration read_camera_object(JsonObject object);
MarkerPlacement read_marker_object(JsonObject object);

}  // namespace asperity
