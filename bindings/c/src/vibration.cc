// The vibration of asperity_feel.h.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "asperity/device/render_vibration.h"
#include "status.h"

namespace {

using asperity::c_library::BadArgument;
using asperity::c_library::guarded;
using asperity::c_library::there;
using asperity::c_library::within;

constexpr double kHighPass_Hz = 20.0, kSplit_Hz = 100.0;  // as open_rumble_sink has them

constexpr double kMost_N = 1000.0;  // no device has more: a tracker's jump must not ring for seconds

constexpr asperity::Range kFullScale_N{0.001, 1000.0};

double level_of(double share) noexcept { return std::isfinite(share) ? std::clamp(share, 0.0, 1.0) : 0.0; }

// RMS of what the least-squares line through the values leaves, NaN if one of them is not finite.
double rms_about_line(std::span<const double> values) noexcept {
  const auto n = static_cast<double>(values.size());
  const double middle = 0.5 * (n - 1.0);
  double sum = 0.0, moment = 0.0, spread = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double x = static_cast<double>(i) - middle;
    sum += values[i];
    moment += x * values[i];
    spread += x * x;
  }
  const double mean = sum / n, slope = spread > 0.0 ? moment / spread : 0.0;
  double square = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double rest = values[i] - mean - slope * (static_cast<double>(i) - middle);
    square += rest * rest / n;
  }
  return std::sqrt(square);
}

}  // namespace

extern "C" {

asperity_status asperity_vibration_samples(const double* force_N, size_t count, double force_rate_Hz,
                                           double sample_rate_Hz, double volume, double full_scale_N, float* samples,
                                           size_t capacity, size_t* written) {
  if (written != nullptr) *written = 0;
  return guarded([&] {
    std::size_t& out = there(written, "written");
    if (count > 0) there(force_N, "force_N");
    if (count > PTRDIFF_MAX / sizeof(double)) throw std::length_error("count");
    asperity::VibrationConfig config;
    config.servo_rate_Hz = within(force_rate_Hz, {100.0, 4000.0}, "force_rate_Hz");
    config.audio_rate_Hz = within(sample_rate_Hz, {8000.0, 192000.0}, "sample_rate_Hz");
    config.volume = within(volume, {0.0, 1.0}, "volume");
    config.full_scale_N = within(full_scale_N, kFullScale_N, "full_scale_N");
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
  return level_of(rms_about_line({force_N, count}) / full_scale_N);
}

asperity_status asperity_rumble_create(double force_rate_Hz, double full_scale_N, asperity_rumble** rumble) {
  if (rumble != nullptr) *rumble = nullptr;
  return guarded([&] {
    asperity_rumble*& out = there(rumble, "rumble");
    within(force_rate_Hz, {400.0, 20000.0}, "force_rate_Hz");
    within(full_scale_N, kFullScale_N, "full_scale_N");
    out = new asperity_rumble{{kHighPass_Hz, kSplit_Hz, force_rate_Hz}, full_scale_N, true};
  });
}

void asperity_rumble_free(asperity_rumble* rumble) { delete rumble; }

void asperity_rumble_add(asperity_rumble* rumble, double force_N) {
  if (rumble == nullptr || !std::isfinite(force_N)) return;
  const double bounded_N = std::clamp(force_N, -kMost_N, kMost_N);
  if (!rumble->running) rumble->bands.start_at(bounded_N);
  rumble->running = true;
  rumble->bands.add(bounded_N);
}

void asperity_rumble_take(asperity_rumble* rumble, double* slow, double* fast) {
  asperity::RumbleBands::Amplitudes amplitudes;
  double full_scale_N = 1.0;
  if (rumble != nullptr) {
    amplitudes = rumble->bands.take();
    full_scale_N = rumble->full_scale_N;
  }
  if (slow != nullptr) *slow = level_of(amplitudes.slow_N / full_scale_N);
  if (fast != nullptr) *fast = level_of(amplitudes.fast_N / full_scale_N);
}

void asperity_rumble_reset(asperity_rumble* rumble) {
  if (rumble == nullptr) return;
  rumble->bands.take();
  rumble->running = false;
}
}
