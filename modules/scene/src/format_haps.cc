#include "asperity/scene/format_haps.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/json/json.h"

namespace asperity {

std::string format_haps(std::span<const VibrationPoint> points, double duration_s, double full_scale,
                        const VibrationNote& note) {
  if (points.empty() || !(duration_s > 0.0)) throw Error(".haps: a vibration without samples");
  if (!(full_scale > 0.0) || !std::isfinite(full_scale))
    throw Error(".haps: a full scale of " + number_text(full_scale));
  double low_Hz = std::numeric_limits<double>::infinity();
  double high_Hz = 0.0;
  for (const VibrationPoint& point : points) {
    if (point.frequency_Hz == 0.0) continue;
    low_Hz = std::min(low_Hz, std::floor(point.frequency_Hz));
    high_Hz = std::max(high_Hz, std::ceil(point.frequency_Hz));
  }
  if (!(low_Hz < high_Hz)) {
    low_Hz = std::isfinite(low_Hz) ? low_Hz : 0.0;
    high_Hz = low_Hz + 1.0;
  }
  Json amplitude = Json::array();
  Json pitch = Json::array();
  const auto add = [&](const VibrationPoint& point, double t_s) {
    const double part = (point.frequency_Hz - low_Hz) / (high_Hz - low_Hz);
    amplitude.push_back({{"position", t_s}, {"value", std::min(1.0, point.amplitude / full_scale)}});
    pitch.push_back({{"position", t_s}, {"value", std::clamp(part, 0.0, 1.0)}});
  };
  // What plays before the first keyframe is not stated anywhere: there is none before it.
  if (points.front().t_s > 0.0) add(points.front(), 0.0);
  for (const VibrationPoint& point : points) add(point, point.t_s);
  Json notes = Json::array();
  notes.push_back({{"position", 0.0}, {"length", duration_s}, {"waveform", "Sine"}});
  notes.at(0)["amplitude"]["keyframes"] = std::move(amplitude);
  notes.at(0)["pitch"]["keyframes"] = std::move(pitch);
  Json melodies = Json::array();
  melodies.push_back(Json::object());
  melodies.at(0)["notes"] = std::move(notes);
  Json out;
  out["version"] = "6";
  out["description"] = printable(note.name + ": " + note.text, 2000);
  out["vibration"]["frequency_range"] = {{"min", low_Hz}, {"max", high_Hz}};
  out["vibration"]["melodies"] = std::move(melodies);
  return out.dump_repaired(2) + "\n";
}

}  // namespace asperity
