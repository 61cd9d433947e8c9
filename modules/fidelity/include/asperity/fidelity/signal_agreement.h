#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "asperity/base/nan.h"

namespace asperity {

// Two signals in one band of spatial frequency.
struct BandSignals {
  double low_cycles_per_mm = 0.0;
  double high_cycles_per_mm = 0.0;
  double real_rms = kNan;
  double other_rms = kNan;
  double difference_dB = kNan;  // 20 log10(other / real), within ±40
  double correlation = kNan;
  double coherence = kNan;  // magnitude-squared
  double threshold = kNan;  // that chance exceeds with the probability that was asked for
  bool is_compared = false;
};

// Two signals over one path, in the bands that are compared.
struct SignalAgreement {
  double real_rms = kNan;  // over these bands
  double other_rms = kNan;
  double level_dB = kNan;     // 20 log10(other / real)
  double distance_dB = kNan;  // RMS over the bands of their differences
  double correlation = kNan;
  std::vector<BandSignals> bands;  // all
};

// Spectra and cross-spectra of two signals on one grid, segment by segment (Hann, half overlap, a straight line
// removed). A segment that a gap touches is empty.
struct CrossSpectra {
  std::size_t segment_points = 0;
  double spacing_mm = 0.0;
  std::vector<std::vector<double>> real, other;  // |X|², scaled so that the sum over the lines is the mean square
  std::vector<std::vector<std::complex<double>>> cross;

  std::size_t segments() const { return real.size(); }
  std::size_t whole_segments() const;
};

// Gaps of one up to a twentieth of a segment are bridged, in both alike. Throws Error if the sizes differ or a segment
// has fewer than 16 points.
CrossSpectra cross_spectra(std::span<const double> real, std::span<const double> other, double spacing_m,
                           double segment_m);

// Third-octave bands from low to high, each with at least two lines of the spectra: lowest ones are wider.
std::vector<BandSignals> third_octaves(const CrossSpectra& spectra, double low_cycles_per_mm,
                                       double high_cycles_per_mm);

// The agreement of two signals over the segments without `left_out` (an index; segments(): none), in the bands whose
// is_compared is set. The threshold of the coherence is 1 − α^(1/(n−1)) (Carter, Knapp and Nuttall 1973), n the number
// of lines and segments over 2.27, which allows for Hann's neighbours and for the overlap (docs/merge.md), and
// α = false_alarm over the number of bands.
SignalAgreement agreement_of(const CrossSpectra& spectra, const std::vector<BandSignals>& bands, std::size_t left_out,
                             double false_alarm);

// max(correlation, 0) · 2^(−distance / half_dB); nan where nothing is compared.
double agreement_score(const SignalAgreement& agreement, double half_dB);

}  // namespace asperity
