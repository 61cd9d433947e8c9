#include "asperity/recording/read_markers.h"

#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/inner_path.h"
#include "asperity/base/text.h"
#include "asperity/json/parse_json.h"
#include "calibration_parts.h"
#include "camera_covariance.h"
#include "json_limits.h"

namespace asperity {

namespace {

constexpr std::size_t kMostInFile = 1000;

bool is_calibration(const Json& root) {
  return root.is_object() && root.contains("format") && root["format"] == "asperity-calibration";
}

TagFrame read_tag_frame(JsonObject& object) {
  std::string text = "apriltag";
  object.read_text("tag_frame", text);
  const auto frame = tag_frame_of(text);
  if (!frame)
    object.fail("tag_frame", fmt::format("'{}' is not apriltag or opencv or opencv_upright", printable(text)));
  return *frame;
}

}  // namespace

MarkerFile parse_markers(std::string_view text, const std::string& name, const ReadLimits& limits) {
  const Json root = parse_json(text, name, json_limits(limits));
  JsonObject object(root, name);
  MarkerFile out;
  if (is_calibration(root)) {
    if (auto extra = object.optional_object("extra")) out.declared = read_tag_frame(*extra);
  } else {
    out.declared = read_tag_frame(object);
    if (object.has("format")) object.require_format("asperity-markers");
    object.extra();
  }
  const JsonItem markers = object.required("markers");
  if (!markers.json().is_array() || markers.json().empty() || markers.json().size() > kMostInFile) {
    markers.fail(fmt::format("must be an array of 1 to {} markers", kMostInFile));
  }
  std::set<std::pair<std::string, int>> seen;
  for (JsonItem& item : markers.elements(kMostInFile)) {
    JsonObject placement(std::move(item));
    MarkerPlacement marker = read_marker_object(placement);
    if (!seen.emplace(marker.family, marker.id).second) {
      placement.fail("id", fmt::format("marker {} is given twice", marker.id));
    }
    marker.T_marker_tag.rotation = marker.T_marker_tag.rotation * R_frame_tag(out.declared, marker.family);
    out.markers.push_back(std::move(marker));
  }
  if (!is_calibration(root)) object.finish();
  return out;
}

MarkerFile read_markers(const std::filesystem::path& path, const ReadLimits& limits) {
  MarkerFile out = parse_markers(read_file(path, limits.json_bytes), path.string(), limits);
  for (MarkerPlacement& marker : out.markers) {
    constexpr std::string_view kPrefix = "aruco:";
    const bool is_file = marker.family.ends_with(".yml") || marker.family.ends_with(".yaml");
    if (!is_file || !marker.family.starts_with(kPrefix)) continue;
    const std::string written = marker.family.substr(kPrefix.size());
    if (!inner_file(path.parent_path(), written)) {
      throw Error(fmt::format("{}: family '{}' names a file that is not in the folder of this one", path.string(),
                              printable(marker.family)));
    }
    marker.family = std::string(kPrefix) + (path.parent_path() / written).string();
  }
  return out;
}

CameraCalibration parse_camera(std::string_view text, const std::string& name, const ReadLimits& limits) {
  const Json root = parse_json(text, name, json_limits(limits));
  JsonObject object(root, name);
  object.require_format("asperity-calibration");
  CameraCalibration out = read_camera_object(object.required_object("camera"));
  if (const Json* extra = root.find("extra"); extra != nullptr && extra->is_object()) {
    if (const Json* covariance = extra->find(kCameraCovariance)) take_camera_covariance(*covariance, out);
  }
  return out;
}

CameraCalibration read_camera(const std::filesystem::path& path, const ReadLimits& limits) {
  return parse_camera(read_file(path, limits.json_bytes), path.string(), limits);
}

}  // namespace asperity
