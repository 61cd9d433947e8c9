#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/json/json_writer.h"
#include "asperity/json/parse_json.h"
#include "asperity/recording/format_recording.h"

namespace asperity {

namespace {

Json extra_object(const std::string& text, const char* what) {
  Json extra = parse_json_or_null(text.empty() ? "{}" : text);
  if (!extra.is_object()) throw Error(std::string(what) + ": extra_json is not a JSON object: " + printable(text));
  return extra;
}

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

void write_camera(JsonWriter& out, const CameraCalibration& camera) {
  out.begin_object("camera");
  out.integer("width", camera.width);
  out.integer("height", camera.height);
  out.number("fx", camera.fx);
  out.number("fy", camera.fy);
  out.number("cx", camera.cx);
  out.number("cy", camera.cy);
  if (!camera.distortion.empty()) out.numbers("distortion", camera.distortion.data(), camera.distortion.size());
  out.end_object();
}

void write_marker(JsonWriter& out, const MarkerPlacement& marker) {
  const Eigen::Vector3d& p = marker.T_marker_tag.translation_m;
  const Eigen::Quaterniond& q = marker.T_marker_tag.rotation;
  const double pose[7] = {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()};
  out.begin_element();
  out.integer("id", marker.id);
  out.text("family", marker.family);
  out.number("size_m", marker.size_m);
  out.numbers("T_marker_tag", pose, 7);
  out.end_object();
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
  if (calibration.camera) write_camera(out, *calibration.camera);
  if (!calibration.markers.empty()) {
    out.begin_array("markers");
    for (const auto& marker : calibration.markers) write_marker(out, marker);
    out.end_array();
  }
  Json extra = extra_object(calibration.extra_json, "calibration");
  const auto give = [&](const char* key, double value) {
    if (value != 0.0) extra[key] = value;
  };
  give("accelerometer_position_sigma_m", calibration.accelerometer.position_sigma_m);
  give("accelerometer_rotation_sigma_rad", calibration.accelerometer.rotation_sigma_rad);
  give("probe_latency_s", calibration.probe_latency_s);
  give("probe_latency_sigma_s", calibration.probe_latency_sigma_s);
  out.raw("extra", extra.dump_sorted());
  return out.finish();
}

std::string format_markers(const std::vector<MarkerPlacement>& markers) {
  JsonWriter out;
  out.text("format", "asperity-markers");
  out.integer("version", 1);
  out.text("tag_frame", "apriltag");
  out.begin_array("markers");
  for (const auto& marker : markers) write_marker(out, marker);
  out.end_array();
  return out.finish();
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
  out.raw("extra", extra_object(info.extra_json, "recording").dump_sorted());
  return out.finish();
}

}  // namespace asperity
