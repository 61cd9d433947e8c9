// The vibration of asperity_feel.h.

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "asperity/device/render_vibration.h"
#include "status.h"

namespace {

using asperity::c_library::BadArgument;
using asperity::c_library::guarded;
using asperity::c_library::there;

}  // namespace

extern "C" {

asperity_status asperity_vibration_samples(const double* force_N, size_t count, double force_rate_Hz,
                                           double sample_rate_Hz, double volume, double full_scale_N, float* samples,
                                           size_t capacity, size_t* written) {
  if (written != nullptr) *written = 0;
  return guarded([&] {
    std::size_t& out = there(written, "written");
    if (count > 0) there(force_N, "force_N");
    asperity::VibrationConfig config;
    config.servo_rate_Hz = force_rate_Hz;
    config.audio_rate_Hz = sample_rate_Hz;
    config.volume = volume;
    config.full_scale_N = full_scale_N;
    std::vector<double> sound;
    try {
      sound = asperity::render_vibration({force_N, count}, config);
    } catch (const asperity::Error& fault) {
      throw BadArgument(fault.what());
    }
    if (samples == nullptr) {
      out = sound.size();
      return;
    }
    out = std::min(capacity, sound.size());
    std::transform(sound.begin(), sound.begin() + static_cast<std::ptrdiff_t>(out), samples,
                   [](double x) { return static_cast<float>(x); });
  });
}

double asperity_vibration_rumble(const double* force_N, size_t count, double full_scale_N) {
  if (force_N == nullptr || count == 0 || !(full_scale_N > 0.0)) return 0.0;
  double square = 0.0;
  for (std::size_t i = 0; i < count; ++i) square += force_N[i] * force_N[i] / static_cast<double>(count);
  const double level = std::sqrt(square) / full_scale_N;
  return std::isfinite(level) ? std::clamp(level, 0.0, 1.0) : 0.0;
}
}
