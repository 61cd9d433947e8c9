#include <array>
#include <optional>

#include "asperity/base/error.h"
#include "asperity/json/json_writer.h"
#include "asperity/recording/format_recording.h"
#include "known_extra.h"
#include "plain_number.h"

namespace asperity {

namespace {

Json extra_object(const Json& strangers, const char* what) {
  if (!strangers.is_object()) throw Error(std::string(what) + ": extra is not an object: " + shown(strangers));
  return strangers;
}

// Takes what JsonWriter does; whole numbers are without a point, as in its text.
class MembersOf {
 public:
  explicit MembersOf(Json& object) : object_(object) {}
  void integer(std::string_view key, std::int64_t value) { object_[key] = value; }
  void text(std::string_view key, const std::string& value) { object_[key] = value; }
  void number(std::string_view key, double value) { object_[key] = plain_number(value); }
  void numbers(std::string_view key, const double* values, std::size_t count) {
    Json& list = object_[key] = Json::array();
    for (std::size_t i = 0; i < count; ++i) list.push_back(plain_number(values[i]));
  }

 private:
  Json& object_;
};

void write_vector(JsonWriter& out, std::string_view key, const Eigen::Vector3d& value) {
  out.numbers(key, value.data(), 3);
}
void write_matrix(JsonWriter& out, std::string_view key, const Eigen::Matrix<double, 3, Eigen::Dynamic>& value) {
  out.matrix(key, value.data(), 3, static_cast<std::size_t>(value.cols()));
}

const char* model_name(AccelerometerModel model) {
  switch (model) {
    case AccelerometerModel::kScalarOffset:
      return "scalar_offset";
    case AccelerometerModel::kLinear:
      return "linear";
    case AccelerometerModel::kQuadric:
      return "quadric";
  }
  throw Error("calibration: accelerometer.model has no name");
}

void write_sensors(JsonWriter& out, const Calibration& calibration) {
  const AccelerometerCalibration& accelerometer = calibration.accelerometer;
  out.begin_object("accelerometer");
  out.text("model", model_name(accelerometer.model));
  write_matrix(out, "B", accelerometer.B);
  write_vector(out, "C", accelerometer.C);
  write_vector(out, "residual_counts", accelerometer.residual_counts);
  if (accelerometer.standard_errors.cols() > 0) write_matrix(out, "stderr", accelerometer.standard_errors);
  out.boolean("rotation_known", accelerometer.rotation_known);
  if (accelerometer.position_in_marker_m)
    write_vector(out, "position_in_marker_m", *accelerometer.position_in_marker_m);
  out.end_object();
  if (calibration.gyroscope) {
    out.begin_object("gyroscope");
    write_matrix(out, "B", calibration.gyroscope->B);
    write_vector(out, "C", calibration.gyroscope->C);
    out.end_object();
  }
  out.begin_object("force");
  out.number("newton_per_count", calibration.force.newton_per_count);
  out.number("offset_newton", calibration.force.offset_newton);
  out.number("residual_newton", calibration.force.residual_newton);
  if (calibration.force.axis_in_marker) write_vector(out, "axis_in_marker", *calibration.force.axis_in_marker);
  out.end_object();
}

template <class Out>
void write_camera(Out& out, const CameraCalibration& camera) {
  out.integer("width", camera.width);
  out.integer("height", camera.height);
  out.number("fx", camera.fx);
  out.number("fy", camera.fy);
  out.number("cx", camera.cx);
  out.number("cy", camera.cy);
  if (!camera.distortion.empty()) out.numbers("distortion", camera.distortion.data(), camera.distortion.size());
}

template <class Out>
void write_marker(Out& out, const MarkerPlacement& marker) {
  const Eigen::Vector3d& p = marker.T_marker_tag.translation_m;
  const Eigen::Quaterniond& q = marker.T_marker_tag.rotation;
  const double pose[7] = {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()};
  out.integer("id", marker.id);
  out.text("family", marker.family);
  out.number("size_m", marker.size_m);
  out.numbers("T_marker_tag", pose, 7);
  if (!marker.body.empty()) out.text("body", marker.body);
}

void write_markers(JsonWriter& out, const std::vector<MarkerPlacement>& markers) {
  out.begin_array("markers");
  for (const auto& marker : markers) {
    out.begin_element();
    write_marker(out, marker);
    out.end_object();
  }
  out.end_array();
}

void write_bodies(JsonWriter& out, const std::vector<TrackedBody>& bodies) {
  out.begin_array("bodies");
  for (const TrackedBody& body : bodies) {
    out.begin_element();
    out.text("name", body.name);
    out.text("file", body_file(body.name));
    const std::vector<double> ids(body.markers.begin(), body.markers.end());
    out.numbers("markers", ids.data(), ids.size());
    out.end_object();
  }
  out.end_array();
}

}  // namespace

std::string format_calibration(const Calibration& calibration) {
  JsonWriter out;
  out.text("format", "asperity-calibration");
  out.integer("version", 1);
  write_sensors(out, calibration);
  write_vector(out, "tip_in_marker_m", calibration.tip_in_marker_m);
  out.number("tip_radius_m", calibration.tip_radius_m);
  out.begin_object("tracker");
  write_vector(out, "sigma_position_m", calibration.tracker.sigma_position_m);
  write_vector(out, "sigma_rotation_rad", calibration.tracker.sigma_rotation_rad);
  out.number("latency_s", calibration.tracker.latency_s);
  out.number("latency_sigma_s", calibration.tracker.latency_sigma_s);
  out.end_object();
  if (calibration.camera) {
    out.begin_object("camera");
    write_camera(out, *calibration.camera);
    out.end_object();
  }
  if (!calibration.markers.empty()) write_markers(out, calibration.markers);
  Json extra = extra_object(calibration.extra, "calibration");
  const auto give = [&](const char* key, double value) {
    if (value != 0.0) extra[key] = value;
  };
  give("accelerometer_position_sigma_m", calibration.accelerometer.position_sigma_m);
  give("accelerometer_rotation_sigma_rad", calibration.accelerometer.rotation_sigma_rad);
  give("probe_latency_s", calibration.probe_latency_s);
  give("probe_latency_sigma_s", calibration.probe_latency_sigma_s);
  const auto give3 = [&](const char* key, const std::optional<Eigen::Vector3d>& value) {
    if (value) extra[key] = Json(std::array{value->x(), value->y(), value->z()});
  };
  give3("tip_sigma_m", calibration.tip_sigma_m);
  give3("tracker_slow_sigma_m", calibration.tracker.slow_sigma_m);
  if (calibration.tracker.slow_time_s) extra["tracker_slow_time_s"] = *calibration.tracker.slow_time_s;
  add_known_extra(calibration, extra);
  out.raw("extra", extra.dump_sorted());
  return out.finish();
}

std::string format_markers(const std::vector<MarkerPlacement>& markers) {
  JsonWriter out;
  out.text("format", "asperity-markers");
  out.integer("version", 1);
  out.text("tag_frame", "apriltag");
  write_markers(out, markers);
  return out.finish();
}

Json camera_json(const CameraCalibration& camera) {
  Json out;
  MembersOf members(out);
  write_camera(members, camera);
  return out;
}

Json markers_json(const std::vector<MarkerPlacement>& markers) {
  Json out = Json::array();
  for (const MarkerPlacement& marker : markers) {
    Json one;
    MembersOf members(one);
    write_marker(members, marker);
    out.push_back(std::move(one));
  }
  return out;
}

std::string format_recording_info(const RecordingInfo& info) {
  JsonWriter out;
  out.text("format", "asperity-recording");
  out.integer("version", 1);
  out.text("created", info.created);
  out.text("object", info.object);
  out.text("world", info.world);
  out.begin_object("probe");
  out.text("model", info.probe_model);
  out.number("nominal_rate_hz", info.probe_rate_Hz);
  out.number("adc_min", info.adc_min);
  out.number("adc_max", info.adc_max);
  out.end_object();
  out.begin_object("tracker");
  out.number("nominal_rate_hz", info.tracker_rate_Hz);
  out.end_object();
  if (!info.bodies.empty()) write_bodies(out, info.bodies);
  write_vector(out, "gravity_world_mps2", info.gravity_world_mps2);
  out.begin_array("segments");
  for (const auto& segment : info.segments) {
    out.begin_element();
    out.text("name", segment.name);
    out.integer("start_ns", segment.start_ns);
    out.integer("end_ns", segment.end_ns);
    out.end_object();
  }
  out.end_array();
  out.begin_object("problems");
  for (const auto& [name, count] : info.problems) out.integer(name, count);
  out.end_object();
  Json extra = extra_object(info.extra, "recording");
  add_known_extra(info, extra);
  out.raw("extra", extra.dump_sorted());
  return out.finish();
}

}  // namespace asperity
