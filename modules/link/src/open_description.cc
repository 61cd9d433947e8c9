#include <cmath>

#include <fmt/format.h>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/json/parse_json.h"
#include "asperity/link/open_protocol.h"

namespace asperity {

namespace {

constexpr double kMaxRate_Hz = 1e5;
constexpr double kMaxScale = 1e12;
constexpr double kLowestCount = -32768.0;
constexpr double kHighestCount = 32767.0;
constexpr std::size_t kMaxDepth = 4;

// Lists each figure once, for reading, writing and checking.
template <class Description, class Visit>
void visit_values(Description& description, Visit&& visit) {
  visit("rate_hz", description.rate_Hz, 0.0, kMaxRate_Hz);
  visit("adc_min", description.adc_min, kLowestCount, kHighestCount);
  visit("adc_max", description.adc_max, kLowestCount, kHighestCount);
  visit("accel_counts_per_mps2", description.accel_counts_per_mps2, 0.0, kMaxScale);
  visit("gyro_counts_per_radps", description.gyro_counts_per_radps, 0.0, kMaxScale);
  visit("force_rate_hz", description.force_rate_Hz, 0.0, kMaxRate_Hz);
  visit("force_newton_per_count", description.force_newton_per_count, 0.0, kMaxScale);
}

bool read_text(const Json& object, const char* key, std::string& out) {
  const Json* found = object.find(key);
  if (found == nullptr) return true;
  if (!found->is_string()) return false;
  out = found->get<std::string>();
  return out.size() <= kOpenMaxName_bytes;
}

bool read_figure(const Json& object, const char* key, double& out, double low, double high) {
  const Json* found = object.find(key);
  if (found == nullptr) return true;
  if (!found->is_number()) return false;
  out = found->get<double>();
  return std::isfinite(out) && out >= low && out <= high;
}

}  // namespace

std::optional<ProbeDescription> parse_open_description(std::string_view text) {
  JsonLimits limits;
  limits.bytes = kOpenMaxDescription_bytes;
  limits.depth = kMaxDepth;
  const Json object = parse_json_or_null(text, limits);
  if (!object.is_object()) return std::nullopt;
  ProbeDescription out;
  if (!read_text(object, "model", out.model) || out.model != "open") return std::nullopt;
  if (!read_text(object, "name", out.name) || !read_text(object, "firmware", out.firmware)) return std::nullopt;
  bool sound = true;
  visit_values(out, [&](const char* key, double& value, double low, double high) {
    sound = read_figure(object, key, value, low, high) && sound;
  });
  out.has_gyro = object.contains("gyro_counts_per_radps");
  if (const Json* axes = object.find("force_axes")) {
    sound = sound && axes->is_number() && (axes->get<double>() == 1.0 || axes->get<double>() == 3.0);
    if (sound) out.force_axes = axes->get<double>() == 3.0 ? 3 : 1;
  }
  if (!sound || out.adc_min > out.adc_max) return std::nullopt;
  return out;
}

std::string format_open_description(const ProbeDescription& description) {
  for (const std::string* text : {&description.name, &description.firmware}) {
    if (text->size() > kOpenMaxName_bytes || !is_utf8(*text)) {
      throw Error(
          fmt::format("open protocol: '{}' is not a text of at most {} bytes", printable(*text), kOpenMaxName_bytes));
    }
  }
  if (description.force_axes != 1 && description.force_axes != 3) {
    throw Error(fmt::format("open protocol: force_axes: {} is neither 1 nor 3", description.force_axes));
  }
  if (description.adc_min > description.adc_max) throw Error("open protocol: adc_min is above adc_max");
  Json object;
  object["model"] = "open";
  object["name"] = description.name;
  object["firmware"] = description.firmware;
  visit_values(description, [&](const char* key, double value, double low, double high) {
    if (!(value >= low && value <= high)) {
      throw Error(fmt::format("open protocol: {}: {} is outside {} to {}", key, value, low, high));
    }
    if (std::string_view(key) == "force_rate_hz") object["force_axes"] = description.force_axes;
    if (std::string_view(key) == "gyro_counts_per_radps" && !description.has_gyro) return;
    object[key] = value;
  });
  return object.dump();
}

}  // namespace asperity
