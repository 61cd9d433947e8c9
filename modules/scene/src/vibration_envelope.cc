#include "asperity/scene/vibration_envelope.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

std::vector<VibrationPoint> vibration_envelope(std::span<const double> samples, double rate_Hz, double window_s) {
  if (!(rate_Hz > 0.0) || !std::isfinite(rate_Hz)) throw Error("vibration: a rate of " + number_text(rate_Hz) + " Hz");
  if (!(window_s > 0.0) || !std::isfinite(window_s))
    throw Error("vibration: a window of " + number_text(window_s) + " s");
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (!std::isfinite(samples[i])) throw Error("vibration: sample " + std::to_string(i) + " is not finite");
  const std::size_t width = std::clamp<std::size_t>(static_cast<std::size_t>(std::llround(window_s * rate_Hz)), 2,
                                                    std::max<std::size_t>(samples.size(), 2));
  std::vector<VibrationPoint> out;
  for (std::size_t begin = 0; begin < samples.size();) {
    const std::size_t end = samples.size() - begin < 2 * width ? samples.size() : begin + width;
    double power = 0.0;
    double change = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
      power += samples[i] * samples[i];
      const double step = i > 0 ? samples[i] - samples[i - 1] : 0.0;
      change += step * step;
    }
    VibrationPoint& point = out.emplace_back();
    point.t_s = 0.5 * static_cast<double>(begin + end) / rate_Hz;
    point.amplitude = std::sqrt(2.0 * power / static_cast<double>(end - begin));
    if (power > 0.0)
      point.frequency_Hz = rate_Hz / std::numbers::pi * std::asin(std::min(1.0, 0.5 * std::sqrt(change / power)));
    begin = end;
  }
  return out;
}

}  // namespace asperity
