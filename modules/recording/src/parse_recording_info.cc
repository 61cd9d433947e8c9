#include <fmt/format.h>

#include "asperity/base/text.h"
#include "asperity/base/units.h"
#include "asperity/json/parse_json.h"
#include "asperity/recording/parse_recording.h"
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
  if (out.end_ns < out.start_ns) object.fail("end_ns", "lies before start_ns");
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
