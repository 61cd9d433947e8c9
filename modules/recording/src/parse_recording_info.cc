#include <algorithm>

#include <fmt/format.h>

#include "asperity/base/text.h"
#include "asperity/base/units.h"
#include "asperity/json/parse_json.h"
#include "asperity/recording/parse_recording.h"
#include "calibration_parts.h"
#include "json_eigen.h"
#include "json_limits.h"
#include "known_extra.h"
#include "time_order.h"

namespace asperity {

namespace {

constexpr Range kRate_Hz{0.0, 1e7};
constexpr double kStrongestGravity_mps2 = 30.0;
constexpr Range kGravity{-kStrongestGravity_mps2, kStrongestGravity_mps2};

Segment read_segment(JsonObject object) {
  Segment out;
  object.read_text("name", out.name);
  for (const auto& [key, target] : {std::pair{"start_ns", &out.start_ns}, {"end_ns", &out.end_ns}}) {
    *target = object.required(key).integer(-kLatestTime_ns, kLatestTime_ns);
  }
  if (out.end_ns < out.start_ns) object.fail("end_ns", "is before start_ns");
  object.finish();
  return out;
}

void read_probe(JsonObject object, RecordingInfo& info) {
  object.read_text("model", info.probe_model);
  object.read_number("nominal_rate_hz", info.probe_rate_Hz, kRate_Hz);
  object.read_number("adc_min", info.adc_min, {-1e12, 1e12});
  object.read_number("adc_max", info.adc_max, {-1e12, 1e12});
  if (info.adc_max < info.adc_min) object.fail("adc_max", "is below adc_min");
  object.finish();
}

TrackedBody read_body(JsonObject object) {
  constexpr std::size_t kMostBodyMarkers = 1000;
  constexpr double kLargestId = 1e6;
  TrackedBody out;
  out.name = read_body_name(object, "name");
  if (const auto file = object.optional("file"); file && file->text() != body_file(out.name))
    object.fail("file", "must be '" + body_file(out.name) + "'");
  if (const auto markers = object.optional("markers")) {
    for (const double id : markers->numbers(kMostBodyMarkers, {0.0, kLargestId})) {
      if (id != static_cast<double>(static_cast<int>(id))) object.fail("markers", "an id is not a whole number");
      out.markers.push_back(static_cast<int>(id));
    }
  }
  object.finish();
  return out;
}

void read_bodies(const JsonItem& list, std::vector<TrackedBody>& bodies) {
  for (JsonItem& item : list.elements(kMostBodies)) {
    TrackedBody body = read_body(JsonObject(item));
    const bool twice =
        std::any_of(bodies.begin(), bodies.end(), [&](const TrackedBody& other) { return other.name == body.name; });
    if (twice) item.fail("the body '" + body.name + "' is listed twice");
    bodies.push_back(std::move(body));
  }
}

}  // namespace

RecordingInfo parse_recording_info(std::string_view text, const std::string& name, const ReadLimits& limits,
                                   const Observer& observer) {
  const Json root = parse_json(text, name, json_limits(limits), observer.without_progress());
  JsonObject object(root, name);
  object.require_format("asperity-recording");
  RecordingInfo out;
  object.read_text("created", out.created);
  object.read_text("object", out.object);
  object.read_text("world", out.world);
  if (out.world != "camera" && out.world != "z_up") {
    object.fail("world", fmt::format("'{}' is neither camera nor z_up", printable(out.world)));
  }
  if (out.world == "z_up") out.gravity_world_mps2 = {0.0, 0.0, -kStandardGravity_mps2};
  read_vector(object, "gravity_world_mps2", out.gravity_world_mps2, kGravity);
  if (auto probe = object.optional_object("probe")) read_probe(*probe, out);
  if (auto tracker = object.optional_object("tracker")) {
    tracker->read_number("nominal_rate_hz", out.tracker_rate_Hz, kRate_Hz);
    tracker->finish();
  }
  if (const auto bodies = object.optional("bodies")) read_bodies(*bodies, out.bodies);
  if (const auto segments = object.optional("segments")) {
    for (JsonItem& segment : segments->elements(root.at("segments").size())) {
      out.segments.push_back(read_segment(JsonObject(std::move(segment))));
    }
  }
  if (auto problems = object.optional_object("problems")) {
    for (const auto& [key, count] : root.at("problems").items()) {
      problems->read_integer(key, out.problems[key], 0, INT64_MAX);
    }
  }
  Json extra = object.extra();
  take_known_extra(extra, out);
  out.extra = std::move(extra);
  object.finish();
  return out;
}

}  // namespace asperity
