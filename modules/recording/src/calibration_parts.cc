#include "calibration_parts.h"

#include <utility>

#include "asperity/base/text.h"
#include "asperity/recording/tracked_body.h"
#include "quaternion_check.h"

namespace asperity {
namespace {

int required_int(JsonObject& object, const std::string& key, std::int64_t low, std::int64_t high) {
  return static_cast<int>(object.required(key).integer(low, high));
}

}  // namespace

std::string read_body_name(JsonObject& object, std::string_view key) {
  std::string name = object.required(key).text();
  if (!is_body_name(name)) {
    object.fail(key, "'" + printable(name) + "' is not a body's name: 1 to 32 lower-case letters, digits, _ and -");
  }
  return name;
}

CameraCalibration read_camera_object(JsonObject object) {
  CameraCalibration out;
  out.width = required_int(object, "width", 1, 100'000);
  out.height = required_int(object, "height", 1, 100'000);
  for (const auto& [key, target] : {std::pair{"fx", &out.fx}, {"fy", &out.fy}, {"cx", &out.cx}, {"cy", &out.cy}}) {
    const bool focal = key[0] == 'f';
    *target = object.required(key).number(focal ? Range{1e-3, 1e7} : Range{-1e7, 1e7});
  }
  if (const auto distortion = object.optional("distortion")) {
    out.distortion.resize(5);
    distortion->numbers(out.distortion.data(), 5);
  }
  object.finish();
  return out;
}

MarkerPlacement read_marker_object(JsonObject object) {
  MarkerPlacement out;
  out.id = required_int(object, "id", 0, 1'000'000);
  out.family = object.required("family").text();
  out.size_m = object.required("size_m").number({1e-6, 100.0});
  double pose[7] = {};
  object.required("T_marker_tag").numbers(pose, 7);
  out.T_marker_tag.translation_m = {pose[0], pose[1], pose[2]};
  out.T_marker_tag.rotation = {pose[3], pose[4], pose[5], pose[6]};
  if (make_unit(out.T_marker_tag.rotation) == QuaternionState::kUnusable) {
    object.fail("T_marker_tag", "its quaternion is not of length one");
  }
  if (object.has("body")) out.body = read_body_name(object, "body");
  object.finish();
  return out;
}

}  // namespace asperity
