#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "asperity/base/problem.h"
#include "asperity/texture/decaying_sinusoids.h"

namespace asperity {

// One tap: acceleration from the moment of contact on (the first sample is t = 0).
struct TapRecording {
  std::span<const double> acceleration_mps2;
  double speed_mps = 0.0;  // of the impact
  double force_N = 0.0;
};

struct FitDecayingSinusoidsConfig {
  double rate_Hz = 1000.0;
  int max_iterations = 100;
  double mass_kg = 0.05;

  template <class V>
  void visit(V& v) {
    v.field("rate_Hz", rate_Hz, "samples a second of the taps", {1.0, 1e7});
    v.field("max_iterations", max_iterations, "of the least squares", {1, 10000});
    v.field("mass_kg", mass_kg, "effective mass of tool and hand", {0.0, 1e3});
  }
};

struct DecayingSinusoidsFit {
  DecayingSinusoids texture;
  std::vector<double> amplitude_mps2;  // per tap, fitted to it alone with the common B and ω
  std::vector<double> tap_error_mps2;  // per tap, RMS
  double rms_mps2 = 0.0;               // of the taps
  double rms_error_mps2 = 0.0;         // of the model against them
  bool converged = false;
  bool speed_and_force_determined = true;  // false: the taps' (v, f) lie on one ray; the shortest (a, b) was taken
  int iterations = 0;
  Problems problems;  // "not_determined"
};

// Okamura's model of several taps by least squares over a, b, B and ω together: B and ω start from the common poles of
// all taps (matrix pencil on their joint lag matrix, Hua and Sarkar 1990), a and b from linear least squares, and all
// four are refined by Levenberg's and Marquardt's method. Throws Error without taps, for a tap shorter than 16 samples,
// numbers that are not finite, silence, or taps that do not oscillate below half the rate.
DecayingSinusoidsFit fit_decaying_sinusoids(const std::vector<TapRecording>& taps,
                                            const FitDecayingSinusoidsConfig& config = {});

}  // namespace asperity
