#include "asperity/fidelity/signal_agreement.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "asperity/base/error.h"
#include "asperity/signal/resample.h"
#include "asperity/signal/spectrum.h"

namespace asperity {

namespace {

constexpr double kBridged = 0.05;  // of a segment
constexpr double kMost_dB = 40.0;
constexpr std::size_t kLeastLines = 2;
// Dependent lines and segments of a Hann window, as align_passes.h has it.
constexpr double kDependent = (1.0 + 2.0 * (4.0 / 9.0 + 1.0 / 36.0)) * (1.0 + 6.0 / 36.0);

// A segment in the gaps of both signals bridged, and without its straight line; empty if there are too many gaps.
std::vector<double> whole_segment(std::span<const double> x, std::span<const double> other) {
  std::vector<double> out(x.begin(), x.end());
  std::size_t gaps = 0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (std::isfinite(x[i]) && std::isfinite(other[i])) continue;
    out[i] = kNan;
    ++gaps;
  }
  if (static_cast<double>(gaps) > kBridged * static_cast<double>(out.size())) return {};
  out = bridge_gaps(out);
  const double n = static_cast<double>(out.size()), middle = 0.5 * (n - 1.0);
  double sum = 0.0, moment = 0.0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    sum += out[i];
    moment += (static_cast<double>(i) - middle) * out[i];
  }
  const double slope = moment * 12.0 / (n * (n * n - 1.0));
  for (std::size_t i = 0; i < out.size(); ++i) out[i] -= sum / n + slope * (static_cast<double>(i) - middle);
  return out;
}

struct BandSums {
  double real = 0.0, other = 0.0;
  std::complex<double> cross;
  double lines = 0.0;

  BandSums& operator+=(const BandSums& more) {
    real += more.real;
    other += more.other;
    cross += more.cross;
    lines += more.lines;
    return *this;
  }
};

BandSums sums_of(const CrossSpectra& spectra, const BandSignals& band, std::size_t left_out) {
  BandSums out;
  const double line = 1.0 / (static_cast<double>(spectra.segment_points) * spectra.spacing_mm);
  for (std::size_t s = 0; s < spectra.segments(); ++s) {
    if (s == left_out || spectra.real[s].empty()) continue;
    for (std::size_t k = 1; k < spectra.real[s].size(); ++k) {
      const double f = static_cast<double>(k) * line;
      if (f < band.low_cycles_per_mm || f >= band.high_cycles_per_mm) continue;
      out += {spectra.real[s][k], spectra.other[s][k], spectra.cross[s][k], 1.0};
    }
  }
  return out;
}

double difference_dB(const BandSums& sums) {
  if (sums.real == sums.other) return 0.0;
  return std::clamp(10.0 * std::log10(sums.other / sums.real), -kMost_dB, kMost_dB);
}

double correlation_of(const BandSums& sums) {
  const double scale = std::sqrt(sums.real * sums.other);
  return scale > 0.0 ? sums.cross.real() / scale : 0.0;
}

}  // namespace

std::size_t CrossSpectra::whole_segments() const {
  return static_cast<std::size_t>(
      std::count_if(real.begin(), real.end(), [](const std::vector<double>& one) { return !one.empty(); }));
}

CrossSpectra cross_spectra(std::span<const double> real, std::span<const double> other, double spacing_m,
                           double segment_m) {
  if (real.size() != other.size()) throw Error("cross spectra: the signals differ in size");
  CrossSpectra out;
  out.spacing_mm = 1e3 * spacing_m;
  out.segment_points = static_cast<std::size_t>(std::llround(segment_m / spacing_m));
  const std::size_t n = out.segment_points;
  if (n < 16) throw Error("cross spectra: a segment has fewer than 16 points");
  std::vector<double> window(n);
  double square = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    window[i] = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(n));
    square += window[i] * window[i];
  }
  // One-sided: each line but the first and the last counts twice.
  const double scale = 2.0 / (static_cast<double>(n) * square);
  for (std::size_t begin = 0; begin + n <= real.size(); begin += n / 2) {
    std::vector<double>& of_real = out.real.emplace_back();
    std::vector<double>& of_other = out.other.emplace_back();
    std::vector<std::complex<double>>& of_both = out.cross.emplace_back();
    const std::span<const double> one = real.subspan(begin, n), two = other.subspan(begin, n);
    std::vector<double> a = whole_segment(one, two), b = whole_segment(two, one);
    if (a.empty() || b.empty()) continue;
    for (std::size_t i = 0; i < n; ++i) {
      a[i] *= window[i];
      b[i] *= window[i];
    }
    const std::vector<std::complex<double>> of_a = real_dft(a), of_b = real_dft(b);
    for (std::size_t k = 0; k < of_a.size(); ++k) {
      of_real.push_back(scale * std::norm(of_a[k]));
      of_other.push_back(scale * std::norm(of_b[k]));
      of_both.push_back(scale * of_a[k] * std::conj(of_b[k]));
    }
  }
  return out;
}

std::vector<BandSignals> third_octaves(const CrossSpectra& spectra, double low_cycles_per_mm,
                                       double high_cycles_per_mm) {
  const double line = 1.0 / (static_cast<double>(spectra.segment_points) * spectra.spacing_mm);
  const auto lines = [&](double low, double high) {
    return std::max(0.0, std::ceil(high / line - 1e-9) - std::ceil(low / line - 1e-9));
  };
  std::vector<BandSignals> out;
  double low = low_cycles_per_mm;
  while (low < high_cycles_per_mm * (1.0 - 1e-9)) {
    double high = low * std::cbrt(2.0);
    while (high < high_cycles_per_mm && lines(low, high) < static_cast<double>(kLeastLines)) high *= 1.01;
    // What is left of a band at the end goes with the one before.
    if (high * std::pow(2.0, 1.0 / 6.0) > high_cycles_per_mm) high = high_cycles_per_mm;
    BandSignals band;
    band.low_cycles_per_mm = low;
    band.high_cycles_per_mm = high;
    if (lines(low, high) >= static_cast<double>(kLeastLines)) out.push_back(band);
    low = high;
  }
  return out;
}

SignalAgreement agreement_of(const CrossSpectra& spectra, const std::vector<BandSignals>& bands, std::size_t left_out,
                             double false_alarm) {
  SignalAgreement out;
  BandSums all;
  double square = 0.0, compared = 0.0;
  for (BandSignals band : bands) {
    const BandSums sums = sums_of(spectra, band, left_out);
    const double segments = std::max(1.0, static_cast<double>(spectra.whole_segments()));
    const double averages = sums.lines / kDependent;
    band.real_rms = std::sqrt(sums.real / segments);
    band.other_rms = std::sqrt(sums.other / segments);
    band.difference_dB = difference_dB(sums);
    band.correlation = correlation_of(sums);
    const double power = sums.real * sums.other;
    band.coherence = power > 0.0 ? std::norm(sums.cross) / power : 0.0;
    band.threshold =
        averages > 1.0 ? 1.0 - std::pow(false_alarm / static_cast<double>(bands.size()), 1.0 / (averages - 1.0)) : 1.0;
    if (band.is_compared) {
      all += sums;
      square += band.difference_dB * band.difference_dB;
      compared += 1.0;
    }
    out.bands.push_back(band);
  }
  if (compared == 0.0) return out;
  const double segments = std::max(1.0, static_cast<double>(spectra.whole_segments()));
  out.real_rms = std::sqrt(all.real / segments);
  out.other_rms = std::sqrt(all.other / segments);
  out.level_dB = difference_dB(all);
  out.distance_dB = std::sqrt(square / compared);
  out.correlation = correlation_of(all);
  return out;
}

double agreement_score(const SignalAgreement& agreement, double half_dB) {
  return std::max(agreement.correlation, 0.0) * std::exp2(-agreement.distance_dB / half_dB);
}

}  // namespace asperity
