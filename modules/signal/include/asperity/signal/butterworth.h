#pragma once

#include <complex>
#include <span>
#include <vector>

namespace asperity {

// H(z) = (b0 + b1 z⁻¹ + b2 z⁻²) / (1 + a1 z⁻¹ + a2 z⁻²).
struct Biquad {
  double b0 = 1.0, b1 = 0.0, b2 = 0.0;
  double a1 = 0.0, a2 = 0.0;
};

// Digital Butterworth filters as second-order sections, by the bilinear transform with the cut-off
// prewarped, so that the gain there is exactly -3 dB (1/√2). `cutoff` and `rate` share one unit (Hz,
// or cycles/mm with samples/mm). Order 1 to 8; 0 < cutoff < rate/2. Throws Error otherwise.
std::vector<Biquad> butterworth_lowpass(int order, double cutoff, double rate);
std::vector<Biquad> butterworth_highpass(int order, double cutoff, double rate);

// -3 dB at `low` and `high`; `order` is that of the low-pass prototype, so there are 2·order poles and
// each skirt falls as a filter of that order (the convention of MATLAB and SciPy).
std::vector<Biquad> butterworth_bandpass(int order, double low, double high, double rate);

// The cascade's complex gain at `frequency`.
std::complex<double> frequency_response(std::span<const Biquad> sections, double frequency, double rate);

}  // namespace asperity
