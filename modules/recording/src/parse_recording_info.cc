#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "asperity/base/text.h"
#include "asperity/base/units.h"
#include "asperity/recording/parse.h"
#include "json_reader.h"
#include "known_extra.h"
#include "time_order.h"

namespace asperity {

using nlohmann::json;

namespace {

constexpr Range kRate_Hz{0.0, 1e7};
constexpr double kStrongestGravity_mps2 = 30.0;
constexpr Range kGravity{-kStrongestGravity_mps2, kStrongestGravity_mps2};

Segment read_segment(JsonObject object) {
  Segment out;
  object.read_text("name", out.name);
  for (const auto& [key, target] : {std::pair{"start_ns", &out.start_ns}, {"end_ns", &out.end_ns}}) {
    object.require(key);
    object.read_integer(key, *target, -kLatestTime_ns, kLatestTime_ns);
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

RecordingInfo parse_recording_info(std::string_view text, const std::string& name, const ReadLimits& limits) {
  const json root = parse_json(text, name, limits);
  JsonObject object(root, name, "");
  object.require_format("asperity-recording");
  RecordingInfo out;
  object.read_text("created", out.created);
  object.read_text("object", out.object);
  object.read_text("world", out.world);
  if (out.world != "camera" && out.world != "z_up") {
    object.fail("world", fmt::format("'{}' is neither camera nor z_up", printable(out.world)));
  }
  if (out.world == "z_up") out.gravity_world_mps2 = {0.0, 0.0, -kStandardGravity_mps2};
  object.read_vector("gravity_world_mps2", out.gravity_world_mps2, kGravity);
  if (auto probe = object.object("probe")) read_probe(*probe, out);
  if (auto tracker = object.object("tracker")) {
    tracker->read_number("nominal_rate_hz", out.tracker_rate_Hz, kRate_Hz);
    tracker->finish();
  }
  if (const json* segments = object.find("segments")) {
    if (!segments->is_array()) object.fail("segments", "must be an array");
    for (std::size_t i = 0; i < segments->size(); ++i) {
      out.segments.push_back(read_segment(JsonObject((*segments)[i], name, fmt::format("segments[{}]", i))));
    }
  }
  if (auto problems = object.object("problems")) {
    for (const auto& item : root.at("problems").items()) {
      problems->read_integer(item.key(), out.problems[item.key()], 0, INT64_MAX);
    }
  }
  json extra = object.read_extra();
  take_known_extra(extra, out);
  out.extra_json = extra.dump();
  object.finish();
  return out;
}

}  // namespace asperity
