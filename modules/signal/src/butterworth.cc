#include "asperity/signal/butterworth.h"

#include <cmath>
#include <numbers>
#include <string>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {
namespace {

using std::numbers::pi;

void check_order(int order) {
  if (order < 1 || order > 8) throw Error("Butterworth order must be 1 to 8, not " + std::to_string(order));
}

// The analogue frequency that the bilinear transform z = (1+s)/(1-s) maps to `cutoff`.
double prewarp(double cutoff, double rate) {
  if (!(rate > 0.0) || !std::isfinite(rate)) throw Error("sampling rate must be positive, not " + number_text(rate));
  if (!(cutoff > 0.0 && cutoff < 0.5 * rate)) {
    throw Error("cut-off " + number_text(cutoff) + " must lie between 0 and half the sampling rate " +
                number_text(rate));
  }
  return std::tan(pi * cutoff / rate);
}

// (n0 + n1 s + n2 s²) / (d0 + d1 s + s²) with s = (1-z⁻¹)/(1+z⁻¹).
Biquad bilinear(double n0, double n1, double n2, double d0, double d1) {
  const double a0 = 1.0 + d1 + d0;
  return {(n2 + n1 + n0) / a0, 2.0 * (n0 - n2) / a0, (n2 - n1 + n0) / a0, 2.0 * (d0 - 1.0) / a0, (1.0 - d1 + d0) / a0};
}

// Twice the cosine of the angle between the k-th prototype pole pair and the negative real axis:
// its factor is s² + damping s + 1. Pairs come with falling damping, so resonant sections act last.
double damping(int order, int k) {
  return 2.0 * std::cos(pi * static_cast<double>(2 * k + 1 + (order % 2)) / static_cast<double>(2 * order));
}

}  // namespace

std::vector<Biquad> butterworth_lowpass(int order, double cutoff, double rate) {
  check_order(order);
  const double w = prewarp(cutoff, rate);
  std::vector<Biquad> sections;
  if (order % 2 == 1) sections.push_back({w / (1.0 + w), w / (1.0 + w), 0.0, (w - 1.0) / (1.0 + w), 0.0});
  for (int k = 0; k < order / 2; ++k) sections.push_back(bilinear(w * w, 0.0, 0.0, w * w, w * damping(order, k)));
  return sections;
}

std::vector<Biquad> butterworth_highpass(int order, double cutoff, double rate) {
  check_order(order);
  const double w = prewarp(cutoff, rate);
  std::vector<Biquad> sections;
  if (order % 2 == 1) sections.push_back({1.0 / (1.0 + w), -1.0 / (1.0 + w), 0.0, (w - 1.0) / (1.0 + w), 0.0});
  for (int k = 0; k < order / 2; ++k) sections.push_back(bilinear(0.0, 0.0, 1.0, w * w, w * damping(order, k)));
  return sections;
}

std::vector<Biquad> butterworth_bandpass(int order, double low, double high, double rate) {
  check_order(order);
  const double w_low = prewarp(low, rate);
  const double w_high = prewarp(high, rate);
  if (!(low < high)) throw Error("band's lower edge " + number_text(low) + " is not below " + number_text(high));
  const double width = w_high - w_low;
  const double centre2 = w_low * w_high;
  std::vector<Biquad> sections;
  // s -> (s² + centre²)/(width s): each prototype pole p becomes the two roots of s² - p width s + centre².
  if (order % 2 == 1) sections.push_back(bilinear(0.0, width, 0.0, centre2, width));
  for (int k = 0; k < order / 2; ++k) {
    const double real = -0.5 * damping(order, k);
    const std::complex<double> p(real, std::sqrt((1.0 - real) * (1.0 + real)));
    const std::complex<double> root = std::sqrt(p * p * (width * width) - 4.0 * centre2);
    for (const std::complex<double>& r : {0.5 * (p * width + root), 0.5 * (p * width - root)}) {
      sections.push_back(bilinear(0.0, width, 0.0, std::norm(r), -2.0 * r.real()));
    }
  }
  return sections;
}

std::complex<double> frequency_response(std::span<const Biquad> sections, double frequency, double rate) {
  const std::complex<double> z1 = std::polar(1.0, -2.0 * pi * frequency / rate);
  const std::complex<double> z2 = z1 * z1;
  std::complex<double> gain = 1.0;
  for (const Biquad& s : sections) gain *= (s.b0 + s.b1 * z1 + s.b2 * z2) / (1.0 + s.a1 * z1 + s.a2 * z2);
  return gain;
}

}  // namespace asperity
