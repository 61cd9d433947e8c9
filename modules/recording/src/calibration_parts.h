#pragma once

#include <string>
#include <string_view>

#include "asperity/json/json_object.h"
#include "asperity/recording/calibration.h"

namespace asperity {

// Objects that calibration.json shares with other files.
CameraCalibration read_camera_object(JsonObject object);
MarkerPlacement read_marker_object(JsonObject object);
// Throws Error for a text that is not a body's name (tracked_body.h).
std::string read_body_name(JsonObject& object, std::string_view key);

}  // namespace asperity
