#include "band_limited_reader.h"

#include <cmath>
#include <numbers>

namespace asperity {

namespace {

constexpr double kCutoff = 0.46;      // of the samples' rate: middle of the transition
constexpr double kKaiserBeta = 6.76;  // 0.1102 (A − 8.7) at A = 70 dB (Kaiser 1974)

double sinc(double x) { return x == 0.0 ? 1.0 : std::sin(std::numbers::pi * x) / (std::numbers::pi * x); }

}  // namespace

BandLimitedReader::BandLimitedReader() : kernel_(kPhases + 1) {
  constexpr double kHalf = 0.5 * kTaps;
  for (std::size_t phase = 0; phase <= kPhases; ++phase) {
    double sum = 0.0;
    for (std::size_t i = 0; i < kTaps; ++i) {
      // Tap i is the sample kHalf − 1 − i behind fraction 0.
      const double t = static_cast<double>(phase) / kPhases + kHalf - 1.0 - static_cast<double>(i);
      const double place = t / kHalf;
      const double window =
          std::abs(place) > 1.0 ? 0.0 : std::cyl_bessel_i(0.0, kKaiserBeta * std::sqrt(1.0 - place * place));
      kernel_[phase][i] = 2.0 * kCutoff * sinc(2.0 * kCutoff * t) * window;
      sum += kernel_[phase][i];
    }
    // A constant force comes out constant: no ripple at the servo's rate.
    for (double& tap : kernel_[phase]) tap /= sum;
  }
}

double BandLimitedReader::at(double fraction) const noexcept {
  const double place = fraction * kPhases;
  const auto row = static_cast<std::size_t>(place);
  const double part = place - static_cast<double>(row);
  const auto& low = kernel_[row];
  const auto& high = kernel_[row + 1];
  double sum_low = 0.0, sum_high = 0.0;
  for (std::size_t i = 0; i < kTaps; ++i) {
    const double x = window_[(newest_ + 1 + i) % kTaps];
    sum_low += low[i] * x;
    sum_high += high[i] * x;
  }
  return sum_low + part * (sum_high - sum_low);
}

}  // namespace asperity
