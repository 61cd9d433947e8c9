#include "asperity/scene/format_ahap.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/json/json.h"

namespace asperity {

namespace {

constexpr double kLongestEvent_s = 30.0;
constexpr std::size_t kMostPoints = 16;  // of a parameter curve

double sharpness(double frequency_Hz) {
  return std::clamp((frequency_Hz - kSharpnessLow_Hz) / (kSharpnessHigh_Hz - kSharpnessLow_Hz), 0.0, 1.0);
}

Json parameter(const char* name, double value) { return {{"ParameterID", name}, {"ParameterValue", value}}; }

template <class Value>
void add_curves(Json& pattern, const char* name, std::span<const VibrationPoint> points, const Value& value) {
  for (std::size_t begin = 0; begin < points.size(); begin += kMostPoints) {
    const auto some = points.subspan(begin, std::min(kMostPoints, points.size() - begin));
    Json controls = Json::array();
    for (const VibrationPoint& point : some)
      controls.push_back({{"Time", point.t_s - some.front().t_s}, {"ParameterValue", value(point)}});
    Json curve;
    curve["ParameterID"] = name;
    curve["Time"] = some.front().t_s;
    curve["ParameterCurveControlPoints"] = std::move(controls);
    Json item;
    item["ParameterCurve"] = std::move(curve);
    pattern.push_back(std::move(item));
  }
}

}  // namespace

std::string format_ahap(std::span<const VibrationPoint> given, double duration_s, double full_scale,
                        const VibrationNote& note) {
  if (given.empty() || !(duration_s > 0.0)) throw Error("AHAP: a vibration without samples");
  // Before the first control point of its curves an event plays at its own, full intensity.
  std::vector<VibrationPoint> points(given.begin(), given.end());
  if (points.front().t_s > 0.0) {
    points.insert(points.begin(), points.front());
    points.front().t_s = 0.0;
  }
  if (!(full_scale > 0.0) || !std::isfinite(full_scale))
    throw Error("AHAP: a full scale of " + number_text(full_scale));
  Json pattern = Json::array();
  for (double begin_s = 0.0; begin_s < duration_s; begin_s += kLongestEvent_s) {
    Json event;
    event["Time"] = begin_s;
    event["EventType"] = "HapticContinuous";
    event["EventDuration"] = std::min(kLongestEvent_s, duration_s - begin_s);
    event["EventParameters"] = Json::array({parameter("HapticIntensity", 1.0), parameter("HapticSharpness", 0.0)});
    Json item;
    item["Event"] = std::move(event);
    pattern.push_back(std::move(item));
  }
  add_curves(pattern, "HapticIntensityControl", points,
             [&](const VibrationPoint& point) { return std::min(1.0, point.amplitude / full_scale); });
  add_curves(pattern, "HapticSharpnessControl", points,
             [](const VibrationPoint& point) { return sharpness(point.frequency_Hz); });
  Json out;
  out["Version"] = 1.0;
  out["Metadata"] = {{"Project", printable(note.name, 200)}, {"Description", printable(note.text, 2000)}};
  out["Pattern"] = std::move(pattern);
  return out.dump_repaired(2) + "\n";
}

}  // namespace asperity
