#pragma once

#include <span>
#include <vector>

#include "asperity/signal/butterworth.h"

namespace asperity {

// `x` filtered by the cascade forward, then backward: no phase, the gain squared (Gustafsson 1996's
// forward-backward filter). Both ends are continued by odd reflection (2x₀ - x) until the filter's
// transient has decayed to a thousandth, at most by x's length, and the recursion starts in the steady
// state of its first sample. Returns as many samples as x. Throws Error for a sample that is not
// finite: gaps are bridged by the caller first (resample.h), and marked again after.
std::vector<double> zero_phase_filter(std::span<const double> x, std::span<const Biquad> sections);

// Zero-phase Butterworth filters whose gain at `cutoff` is -3 dB for the WHOLE forward-backward filter:
// each pass is designed at a corner moved by zero_phase_corner_ratio (thesis §5.2, errata 12 and 13).
// `cutoff` and `rate` share one unit. Throw Error as butterworth.h and zero_phase_filter do.
std::vector<double> zero_phase_highpass(std::span<const double> x, double cutoff, double rate, int order = 2);
std::vector<double> zero_phase_lowpass(std::span<const double> x, double cutoff, double rate, int order = 2);
std::vector<double> zero_phase_bandpass(std::span<const double> x, double low, double high, double rate, int order = 2);

// The sections that one pass of the filters above uses.
std::vector<Biquad> zero_phase_highpass_pass(double cutoff, double rate, int order = 2);
std::vector<Biquad> zero_phase_lowpass_pass(double cutoff, double rate, int order = 2);
std::vector<Biquad> zero_phase_bandpass_pass(double low, double high, double rate, int order = 2);

// Two passes have the gain 1/(1 + (ω_pass/ω)^2n) for a high-pass. It is 1/√2 at ω where
// ω_pass = (√2 - 1)^(1/2n) ω: 0.802 for order 2. A low-pass pass is designed at ω divided by it.
double zero_phase_corner_ratio(int order);

}  // namespace asperity
