#include "known_extra.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <initializer_list>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "camera_covariance.h"
#include "force3_json.h"
#include "plain_number.h"

namespace asperity {

namespace {

constexpr const char* kPose = "T_mesh_world";

// Passes the member to `use`, which says whether it is of the known form; takes it out then.
void take_member(Json& object, const char* key, const std::function<bool(const Json&)>& use) {
  const Json* found = object.find(key);
  if (found != nullptr && use(*found)) object.erase(key);
}

void take_text(Json& object, const char* key, const std::function<void(std::string)>& put) {
  take_member(object, key, [&](const Json& value) {
    if (value.is_string()) put(value.get<std::string>());
    return value.is_string();
  });
}

void take_flag(Json& object, const char* key, const std::function<void(bool)>& put) {
  take_member(object, key, [&](const Json& value) {
    if (value.is_boolean()) put(value.get<bool>());
    return value.is_boolean();
  });
}

bool is_int64(const Json& value) {
  if (!value.is_number_integer()) return false;
  constexpr auto kLargest = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  return !value.is_number_unsigned() || value.get<std::uint64_t>() <= kLargest;
}

void take_integer(Json& object, const char* key, const std::function<void(std::int64_t)>& put) {
  take_member(object, key, [&](const Json& value) {
    if (is_int64(value)) put(value.get<std::int64_t>());
    return is_int64(value);
  });
}

// Names alone are enough to say what was discarded.
bool take_segments(const Json& list, std::vector<Segment>& out) {
  if (!list.is_array()) return false;
  for (const Json& each : list) {
    if (!each.is_object() || !each.contains("name") || !each["name"].is_string()) continue;
    Segment segment{each["name"].get<std::string>(), 0, 0};
    if (each.contains("start_ns") && is_int64(each["start_ns"]))
      segment.start_ns = each["start_ns"].get<std::int64_t>();
    if (each.contains("end_ns") && is_int64(each["end_ns"])) segment.end_ns = each["end_ns"].get<std::int64_t>();
    out.push_back(std::move(segment));
  }
  return true;
}

bool take_gravity(const Json& value, std::optional<GravityAtRest>& out) {
  const auto is_number_or_null = [](const Json& each) { return each.is_number() || each.is_null(); };
  if (!value.is_object() || value.size() != 3) return false;
  if (!value.contains("measured") || !value["measured"].is_boolean()) return false;
  if (!value.contains("windows_at_rest") || !is_int64(value["windows_at_rest"])) return false;
  if (!value.contains("scatter_mps2") || !value["scatter_mps2"].is_array() || value["scatter_mps2"].size() != 3)
    return false;
  const Json& scatter = value["scatter_mps2"];
  if (!std::all_of(scatter.begin(), scatter.end(), is_number_or_null)) return false;
  GravityAtRest gravity;
  gravity.measured = value["measured"].get<bool>();
  gravity.windows_at_rest = value["windows_at_rest"].get<std::int64_t>();
  for (std::size_t i = 0; i < 3; ++i) {
    if (scatter[i].is_number()) gravity.scatter_mps2[static_cast<Eigen::Index>(i)] = scatter[i].get<double>();
  }
  out = gravity;
  return true;
}

// What is left of the recorder's object is a stranger's.
void take_recorder(Json& extra, RecordingInfo& info) {
  Json* found = extra.find("recorder");
  if (found == nullptr || !found->is_object()) return;
  RecorderState& out = info.recorder.emplace();
  Json& recorder = *found;
  take_text(recorder, "state", [&](std::string text) { out.state = std::move(text); });
  take_text(recorder, "mode", [&](std::string text) { out.mode = std::move(text); });
  take_flag(recorder, "last_segment_is_open", [&](bool flag) { out.last_segment_is_open = flag; });
  take_integer(recorder, "discarded_until_ns", [&](std::int64_t number) { out.discarded_until_ns = number; });
  take_integer(recorder, "discarded_segments", [&](std::int64_t number) { out.discarded_segments = number; });
  take_member(recorder, "discarded", [&](const Json& list) { return take_segments(list, out.discarded); });
  take_member(recorder, "gravity", [&](const Json& value) { return take_gravity(value, out.gravity); });
  take_text(recorder, "probe_name", [&](std::string text) { out.probe_name = std::move(text); });
  take_text(recorder, "probe_firmware", [&](std::string text) { out.probe_firmware = std::move(text); });
  if (recorder.empty()) extra.erase("recorder");
}

Json gravity_json(const GravityAtRest& gravity) {
  Json scatter = Json::array();
  for (const double value : gravity.scatter_mps2) scatter.push_back(number_or_null(value));
  return {{"measured", gravity.measured}, {"windows_at_rest", gravity.windows_at_rest}, {"scatter_mps2", scatter}};
}

void add_recorder(const RecorderState& state, Json& extra) {
  Json& out = extra["recorder"];
  if (!out.is_object()) out = Json::object();
  if (!state.state.empty()) out["state"] = state.state;
  if (!state.mode.empty()) out["mode"] = state.mode;
  if (state.last_segment_is_open) out["last_segment_is_open"] = *state.last_segment_is_open;
  if (state.discarded_until_ns) out["discarded_until_ns"] = *state.discarded_until_ns;
  if (state.discarded_segments) out["discarded_segments"] = *state.discarded_segments;
  for (const Segment& each : state.discarded)
    out["discarded"].push_back({{"name", each.name}, {"start_ns", each.start_ns}, {"end_ns", each.end_ns}});
  if (state.gravity) out["gravity"] = gravity_json(*state.gravity);
  if (state.probe_name) out["probe_name"] = *state.probe_name;
  if (state.probe_firmware) out["probe_firmware"] = *state.probe_firmware;
}

// x, y, z, qw, qx, qy, qz.
bool take_pose(const Json& value, std::optional<Pose>& out) {
  if (!value.is_array() || value.size() != 7) return false;
  std::array<double, 7> v{};
  for (std::size_t i = 0; i < v.size(); ++i) {
    if (!value[i].is_number() || !std::isfinite(value[i].get<double>())) return false;
    v[i] = value[i].get<double>();
  }
  const Eigen::Quaterniond rotation(v[3], v[4], v[5], v[6]);
  if (std::abs(rotation.norm() - 1.0) > 1e-3) return false;
  out = Pose{rotation, {v[0], v[1], v[2]}};
  return true;
}

Json pose_list(const Pose& pose) {
  const Eigen::Vector3d& p = pose.translation_m;
  const Eigen::Quaterniond& q = pose.rotation;
  Json out = Json::array();
  constexpr double kLargestWhole = 1e15;
  for (const double each : {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()}) {
    // Whole numbers have been written without a point ever since.
    const bool whole = std::trunc(each) == each && std::abs(each) < kLargestWhole;
    out.push_back(whole ? Json(static_cast<std::int64_t>(each)) : Json(each));
  }
  return out;
}

constexpr const char* kNoiseModel = "tracker_noise_model";

// nan is null in files.
std::optional<double> number_or_nan(const Json* value) {
  if (value != nullptr && value->is_null()) return std::numeric_limits<double>::quiet_NaN();
  return value != nullptr && value->is_number() ? std::optional(value->get<double>()) : std::nullopt;
}

bool take_numbers(const Json& object, std::initializer_list<std::pair<const char*, double*>> members) {
  return std::all_of(members.begin(), members.end(), [&object](const auto& member) {
    const std::optional<double> number = number_or_nan(object.find(member.first));
    if (number) *member.second = *number;
    return number.has_value();
  });
}

bool take_law(const Json& model, const char* key, NoiseLaw& law) {
  const Json* object = model.find(key);
  if (object == nullptr || !object->is_object()) return false;
  const Json* freedom = object->find("degrees_of_freedom");
  if (freedom == nullptr || !is_int64(*freedom)) return false;
  const auto degrees_of_freedom = freedom->get<std::int64_t>();
  law.degrees_of_freedom = static_cast<int>(std::clamp<std::int64_t>(degrees_of_freedom, 0, 1'000'000'000));
  return take_numbers(*object, {{"scale", &law.scale},
                                {"scale_stderr", &law.scale_error},
                                {"distance_power", &law.power},
                                {"tilt_power", &law.tilt_power},
                                {"tilt_power_stderr", &law.tilt_power_error},
                                {"measured_distance_power", &law.measured_power},
                                {"measured_distance_power_stderr", &law.measured_power_error},
                                {"chi_square", &law.chi_square}});
}

bool take_noise_model(const Json& value, std::optional<TrackerNoiseModel>& out) {
  if (!value.is_object()) return false;
  TrackerNoiseModel model;
  const bool whole = take_law(value, "position_across_ray_m", model.across_m) &&
                     take_law(value, "position_along_ray_m", model.along_m) &&
                     take_law(value, "rotation_about_ray_rad", model.about_rad) &&
                     take_law(value, "rotation_across_ray_rad", model.tilt_rad) &&
                     take_numbers(value, {{"nearest_m", &model.nearest_m},
                                          {"farthest_m", &model.farthest_m},
                                          {"steepest_rad", &model.steepest_rad}});
  // What says more, or says it otherwise, would not come back.
  if (!whole || noise_model_json(model).dump_sorted() != value.dump_sorted()) return false;
  out = model;
  return true;
}

void take_simulation(Json& extra, RecordingInfo& info) {
  take_member(extra, "simulation", [&](const Json& value) {
    if (value.is_object()) info.simulation.emplace().settings = value;
    return value.is_object();
  });
  if (!info.simulation) return;
  take_member(info.simulation->settings, "live", [&](const Json& value) {
    info.simulation->is_live = value == Json(true);
    return info.simulation->is_live;
  });
  take_member(extra, "path_length_m", [&](const Json& value) {
    const bool known = value.is_number() && plain_number(value.get<double>()).dump() == value.dump();
    if (known) info.simulation->path_length_m = value.get<double>();
    return known;
  });
}

void add_simulation(const SimulationOrigin& simulation, Json& extra) {
  Json& out = extra["simulation"] = simulation.settings;
  if (simulation.is_live) out["live"] = true;
  if (simulation.path_length_m) extra["path_length_m"] = plain_number(*simulation.path_length_m);
}

Json import_json(const ImportOrigin& imported) {
  return {{"imported", true},
          {"pose_rate_hz", imported.pose_rate_Hz},
          {"pose_noise_m", imported.pose_noise_m},
          {"rotation_noise_rad", imported.rotation_noise_rad},
          {"seed", imported.seed}};
}

bool take_three(const Json* list, std::array<double, 3>& out) {
  if (list == nullptr || !list->is_array() || list->size() != out.size()) return false;
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (!(*list)[i].is_number()) return false;
    out[i] = (*list)[i].get<double>();
  }
  return true;
}

void take_import(Json& extra, RecordingInfo& info) {
  ImportOrigin imported;
  const Json *rate = extra.find("pose_rate_hz"), *seed = extra.find("seed");
  if (rate == nullptr || !rate->is_number() || seed == nullptr || !is_int64(*seed)) return;
  imported.pose_rate_Hz = rate->get<double>();
  imported.seed = seed->get<std::int64_t>();
  if (!take_three(extra.find("pose_noise_m"), imported.pose_noise_m)) return;
  if (!take_three(extra.find("rotation_noise_rad"), imported.rotation_noise_rad)) return;
  const Json written = import_json(imported);
  for (const auto& [key, value] : written.items()) {
    const Json* found = extra.find(key);
    if (found == nullptr || found->dump() != value.dump()) return;
  }
  for (const auto& [key, value] : written.items()) extra.erase(key);
  info.imported = imported;
}

void take_calibrated(Json& extra, Calibration& calibration) {
  Json* found = extra.find("calibrated");
  if (found == nullptr || !found->is_object()) return;
  std::vector<std::string> kinds;
  for (const auto& [kind, details] : found->items()) {
    if (details.is_object()) kinds.push_back(kind);
  }
  for (const std::string& kind : kinds) {
    Json& details = found->at(kind);
    CalibrationRecord& out = calibration.calibrated[kind];
    take_flag(details, "trustworthy", [&](bool flag) { out.trustworthy = flag; });
    take_text(details, "verdict", [&](std::string text) { out.verdict = std::move(text); });
    out.details = std::move(details);
    found->erase(kind);
  }
  if (found->empty()) extra.erase("calibrated");
}

void add_calibrated(const Calibration& calibration, Json& extra) {
  if (calibration.calibrated.empty()) return;
  Json& out = extra["calibrated"];
  if (!out.is_object()) out = Json::object();
  for (const auto& [kind, record] : calibration.calibrated) {
    Json entry = record.details;
    if (record.trustworthy) entry["trustworthy"] = *record.trustworthy;
    if (record.verdict) entry["verdict"] = *record.verdict;
    out[kind] = std::move(entry);
  }
}

}  // namespace

void take_known_extra(Json& extra, RecordingInfo& info) {
  take_recorder(extra, info);
  take_member(extra, "force_sensor", [&](const Json& value) {
    if (value == Json(false)) info.has_force_sensor = false;
    return value == Json(false);
  });
  take_member(extra, kPose, [&](const Json& value) { return take_pose(value, info.T_mesh_world); });
  take_simulation(extra, info);
  take_import(extra, info);
  take_member(extra, "replayed", [&](const Json& value) {
    info.is_replayed = value == Json(true);
    return info.is_replayed;
  });
}

void add_known_extra(const RecordingInfo& info, Json& extra) {
  if (info.recorder) add_recorder(*info.recorder, extra);
  if (!info.has_force_sensor) extra["force_sensor"] = false;
  if (info.T_mesh_world) extra[kPose] = pose_list(*info.T_mesh_world);
  if (info.simulation) add_simulation(*info.simulation, extra);
  if (info.imported) extra.update(import_json(*info.imported));
  if (info.is_replayed) extra["replayed"] = true;
}

void take_known_extra(Json& extra, Calibration& calibration) {
  take_member(extra, "uncalibrated", [&](const Json& value) {
    if (value == Json(true)) calibration.uncalibrated = true;
    return value == Json(true);
  });
  take_calibrated(extra, calibration);
  take_member(extra, kCameraCovariance, [&](const Json& value) {
    return calibration.camera && take_camera_covariance(value, *calibration.camera);
  });
  take_member(extra, kNoiseModel,
              [&](const Json& value) { return take_noise_model(value, calibration.tracker.noise_model); });
  take_member(extra, kForce3, [&](const Json& value) { return take_force3(value, calibration.force3); });
  take_member(extra, "tag_frame", [&](const Json& value) {
    if (value.is_string()) calibration.tag_frame = tag_frame_of(value.text());
    return calibration.tag_frame.has_value();
  });
}

void add_known_extra(const Calibration& calibration, Json& extra) {
  if (calibration.uncalibrated) extra["uncalibrated"] = true;
  add_calibrated(calibration, extra);
  if (calibration.tracker.noise_model) extra[kNoiseModel] = noise_model_json(*calibration.tracker.noise_model);
  if (calibration.force3) extra[kForce3] = force3_json(*calibration.force3);
  if (calibration.tag_frame) extra["tag_frame"] = name_of(*calibration.tag_frame);
  if (calibration.camera && calibration.camera->covariance)
    extra[kCameraCovariance] = camera_covariance_json(*calibration.camera);
}

}  // namespace asperity
