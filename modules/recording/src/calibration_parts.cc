#include "calibration_parts.h"

#include <utility>

#include <nlohmann/json.hpp>

#include "quaternion_check.h"

namespace asperity {
namespace {

int required_int(JsonObject& object, const std::string& key, std::int64_t low, std::int64_t high) {
  std::int64_t value = 0;
  object.require(key);
  object.read_integer(key, value, low, high);
  return static_cast<int>(value);
}

}  // namespace

CameraCalibration read_camera_object(JsonObject object) {
  CameraCalibration out;
  out.width = required_int(object, "width", 1, 100'000);
  out.height = required_int(object, "height", 1, 100'000);
  for (const auto& [key, target] : {std::pair{"fx", &out.fx}, {"fy", &out.fy}, {"cx", &out.cx}, {"cy", &out.cy}}) {
    object.require(key);
    const bool focal = key[0] == 'f';
    object.read_number(key, *target, focal ? Range{1e-3, 1e7} : Range{-1e7, 1e7});
  }
  if (object.find("distortion") != nullptr) {
    out.distortion.resize(5);
    object.read_numbers("distortion", out.distortion.data(), 5);
  }
  object.finish();
  return out;
}

MarkerPlacement read_marker_object(JsonObject object) {
  MarkerPlacement out;
  out.id = required_int(object, "id", 0, 1'000'000);
  object.require("family");
  object.read_text("family", out.family);
  object.require("size_m");
  object.read_number("size_m", out.size_m, {1e-6, 100.0});
  object.require("T_marker_tag");
  double pose[7] = {};
  object.read_numbers("T_marker_tag", pose, 7);
  out.T_marker_tag.translation_m = {pose[0], pose[1], pose[2]};
  out.T_marker_tag.rotation = {pose[3], pose[4], pose[5], pose[6]};
  if (make_unit(out.T_marker_tag.rotation) == QuaternionState::kUnusable) {
    object.fail("T_marker_tag", "its quaternion is not of length one");
  }
  object.finish();
  return out;
}

}  // namespace asperity
