#include "asperity/import/stroke_spectra.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "asperity/base/random.h"

namespace asperity {
namespace {

// White acceleration of this RMS at 2 kHz in motion, white noise of the same all the time: at rest for 0.4 s, of which
// one window of 0.25 s is away from the motion.
Stroke made_stroke(std::uint64_t seed, double rms_mps2) {
  Random random(seed);
  Stroke out;
  out.rate_Hz = 2000.0;
  out.high_pass_Hz = 10.0;
  out.axes = 1;
  out.speed_is_measured = true;
  for (int i = 0; i < 12000; ++i) {
    const bool moves = i >= 800;
    out.speed_mps.push_back(moves ? 0.05 : 0.0);
    out.acceleration_mps2.push_back(rms_mps2 * (random.normal() + (moves ? random.normal() : 0.0)));
  }
  return out;
}

// The error of an octave's power, which is known in closed form, beside the stated one: the quiet spectrum is one
// window against twenty in motion, and all of them have its error.
TEST(StrokeHeightSpectrum, StatesTheErrorOfTheQuietToo) {
  constexpr double kRms_mps2 = 0.05;
  constexpr int kSeeds = 300;
  double squares[3] = {}, stated[3] = {};
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const StrokeHeightSpectrum spectrum =
        stroke_height_spectrum(made_stroke(static_cast<std::uint64_t>(seed), kRms_mps2));
    for (int k = 0; k < 3; ++k) {  // from 1, 2 and 4 cycles/mm: 50, 100 and 200 Hz
      const StrokeHeightBand* band = nullptr;
      for (const StrokeHeightBand& one : spectrum.octaves)
        if (one.low_cycles_per_mm == std::exp2(k)) band = &one;
      ASSERT_NE(band, nullptr);
      const double low = 2.0 * std::numbers::pi * 50.0 * band->low_cycles_per_mm;
      // ∫ S (2πf)⁻⁴ df over the octave, S = a²/(1 kHz).
      const double truth =
          kRms_mps2 * kRms_mps2 / 1000.0 / (2.0 * std::numbers::pi) * (1.0 - 0.125) / 3.0 * std::pow(low, -3);
      const double power = band->rms_m * band->rms_m;
      const double shown = 2.0 * band->rms_m * band->rms_sigma_m;
      const double sigma = shown < power ? shown : band->rms_sigma_m * band->rms_sigma_m;
      squares[k] += std::pow(power - truth, 2);
      stated[k] += sigma * sigma;
    }
  }
  for (int k = 0; k < 3; ++k) {
    EXPECT_GT(std::sqrt(squares[k] / stated[k]), 0.85) << k;
    EXPECT_LT(std::sqrt(squares[k] / stated[k]), 1.15) << k;
  }
}

}  // namespace
}  // namespace asperity
