#include "asperity/texture/compare_vibrations.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/signal/spectrum.h"
#include "asperity/texture/compare_textures.h"
#include "asperity/texture/synthesize_stroke.h"

namespace asperity {

namespace {

constexpr double kHighest = 0.45;  // of the rate
constexpr double kSigmas = 2.0;

struct MeanSpectrum {
  std::vector<double> density;
  double step_Hz = 0.0;
  double pieces = 0.0;

  double power(double low_Hz, double high_Hz) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < density.size(); ++k) {
      // The part of the bin that lies in the band, so that bands share no power and lose none.
      const double from = std::max(low_Hz, (static_cast<double>(k) - 0.5) * step_Hz);
      const double to = std::min(high_Hz, (static_cast<double>(k) + 0.5) * step_Hz);
      if (to > from) sum += density[k] * (to - from);
    }
    return sum;
  }
  double bins(double low_Hz, double high_Hz) const {
    return std::max(1.0, 0.5 * pieces * std::max(1.0, (high_Hz - low_Hz) / step_Hz));
  }
};

MeanSpectrum mean_spectrum(const std::vector<std::vector<double>>& pieces, double rate_Hz) {
  MeanSpectrum out;
  out.pieces = static_cast<double>(pieces.size());
  constexpr std::size_t kLeast = 16;
  for (const std::vector<double>& piece : pieces) {
    if (piece.size() < kLeast || piece.size() != pieces.front().size())
      throw Error("compare: a piece of " + std::to_string(piece.size()) +
                  " samples of a vibration; all need the same "
                  "number, 16 at least");
    const PowerSpectrum one = welch(piece, rate_Hz, piece.size());
    out.density.resize(one.density.size(), 0.0);
    for (std::size_t k = 0; k < one.density.size(); ++k) out.density[k] += one.density[k] / out.pieces;
    out.step_Hz = one.frequency[1] - one.frequency[0];
  }
  return out;
}

struct VibrationSide {
  MeanSpectrum all, noise;
  double most_noise = 0.0;  // m²/s⁴ in any band

  explicit VibrationSide(const ComparedVibration& of) {
    if (of.pieces_mps2.empty()) throw Error("compare: a vibration without a piece");
    all = mean_spectrum(of.pieces_mps2, of.rate_Hz);
    if (!of.noise_mps2.empty()) {
      noise = mean_spectrum(of.noise_mps2, of.rate_Hz);
    } else {
      most_noise = of.most_noise_mps2 * of.most_noise_mps2;
    }
  }
  // The least that the power can be.
  double least_power(double low_Hz, double high_Hz) const { return std::max(0.0, power(low_Hz, high_Hz) - most_noise); }
  double power(double low_Hz, double high_Hz) const {
    return std::max(0.0, all.power(low_Hz, high_Hz) - noise.power(low_Hz, high_Hz));
  }
  // Relative variance of the power.
  double variance(double low_Hz, double high_Hz) const {
    const double whole = all.power(low_Hz, high_Hz), of_noise = noise.power(low_Hz, high_Hz);
    const double rest = power(low_Hz, high_Hz);
    if (!(rest > 0.0)) return whole > 0.0 ? std::numeric_limits<double>::infinity() : 0.0;
    double out = whole * whole / all.bins(low_Hz, high_Hz);
    if (of_noise > 0.0) out += of_noise * of_noise / noise.bins(low_Hz, high_Hz);
    return out / (rest * rest);
  }
};

// The difference of b from a, percent of a, and its standard error, at one power of each. A side's power is known to
// the same standard error whatever part of it is noise.
struct Difference {
  double percent = 0.0, sigma = 0.0;
};

Difference difference_at(const VibrationSide& a, double power_a, const VibrationSide& b, double power_b,
                         const VibrationBand& band) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  const double low = band.low_Hz, high = band.high_Hz, ratio = std::sqrt(power_b / power_a);
  // A variance is infinite where noise alone is left, and 0 where nothing was measured at all.
  if (!(power_a > 0.0) && !(power_b > 0.0)) return {0.0, band.sigma_percent};
  if (!(power_a > 0.0)) return {kInf, a.variance(low, high)};
  if (!(power_b > 0.0)) return {-100.0, std::isinf(b.variance(low, high)) ? kInf : 0.0};
  const double of_a = a.variance(low, high) * std::pow(a.power(low, high) / power_a, 2);
  const double of_b = b.variance(low, high) * std::pow(b.power(low, high) / power_b, 2);
  const double sigma = 50.0 * ratio * std::sqrt(of_a + of_b);
  return {100.0 * (ratio - 1.0), std::isnan(sigma) ? kInf : sigma};
}

// The least and the most that b differs from a, percent of a, each between its least and its most; and the verdict,
// which holds at both ends by two of the standard errors there.
void bound_difference(const VibrationSide& a, const VibrationSide& b, VibrationBand& band) {
  const double low_a = a.least_power(band.low_Hz, band.high_Hz), high_a = a.power(band.low_Hz, band.high_Hz);
  const double low_b = b.least_power(band.low_Hz, band.high_Hz), high_b = b.power(band.low_Hz, band.high_Hz);
  const Difference lowest = difference_at(a, high_a, b, low_b, band),
                   highest = difference_at(a, low_a, b, high_b, band);
  const double above = lowest.percent, below = -highest.percent;
  band.least_percent = std::max({0.0, above, below});
  band.most_percent = std::max(highest.percent, -lowest.percent);
  band.verdict = VibrationVerdict::kUndetermined;
  const auto least = [](double percent, double sigma) { return percent - kSigmas * sigma; };
  const auto most = [](double percent, double sigma) { return percent + kSigmas * sigma; };
  if (least(above, lowest.sigma) > band.jnd_percent || least(below, highest.sigma) > band.jnd_percent) {
    band.verdict = VibrationVerdict::kNoticeable;
  } else if (most(highest.percent, highest.sigma) <= band.jnd_percent &&
             most(-lowest.percent, lowest.sigma) <= band.jnd_percent) {
    band.verdict = VibrationVerdict::kSame;
  }
}

}  // namespace

VibrationComparison compare_vibrations(const ComparedVibration& a, const ComparedVibration& b,
                                       const CompareVibrationsConfig& config) {
  const VibrationSide side_a(a), side_b(b);
  VibrationComparison out;
  out.low_Hz = config.low_Hz;
  out.high_Hz = std::min({config.high_Hz, kHighest * a.rate_Hz, kHighest * b.rate_Hz});
  if (!(out.low_Hz < out.high_Hz))
    throw Error("compare: the band from " + number_text(out.low_Hz) + " to " + number_text(out.high_Hz) +
                " Hz is empty");
  out.a_mps2 = std::sqrt(side_a.power(out.low_Hz, out.high_Hz));
  out.b_mps2 = std::sqrt(side_b.power(out.low_Hz, out.high_Hz));
  bool noticeable = false, undetermined = false, compared = false;
  for (double from = out.low_Hz; from < out.high_Hz * (1.0 - 1e-9);) {
    // A last band of less than half an octave joins the one before.
    const double to = 2.0 * from * std::sqrt(2.0) > out.high_Hz ? out.high_Hz : 2.0 * from;
    VibrationBand band;
    band.low_Hz = from;
    band.high_Hz = to;
    band.a_mps2 = std::sqrt(side_a.power(from, to));
    band.b_mps2 = std::sqrt(side_b.power(from, to));
    if (band.a_mps2 != band.b_mps2) band.percent = 100.0 * (band.b_mps2 - band.a_mps2) / band.a_mps2;
    const double ratio = band.a_mps2 > 0.0 ? band.b_mps2 / band.a_mps2 : 1.0;
    band.sigma_percent = 50.0 * ratio * std::sqrt(side_a.variance(from, to) + side_b.variance(from, to));
    if (std::isnan(band.sigma_percent)) band.sigma_percent = std::numeric_limits<double>::infinity();
    band.jnd_percent = just_noticeable_percent(std::sqrt(from * to));
    band.is_compared = band.a_mps2 > config.least_part * out.a_mps2 || band.b_mps2 > config.least_part * out.b_mps2;
    bound_difference(side_a, side_b, band);
    if (band.is_compared) {
      compared = true;
      noticeable = noticeable || band.verdict == VibrationVerdict::kNoticeable;
      undetermined = undetermined || band.verdict == VibrationVerdict::kUndetermined;
    }
    out.bands.push_back(band);
    from = to;
  }
  if (noticeable) {
    out.verdict = VibrationVerdict::kNoticeable;
  } else if (compared && !undetermined) {
    out.verdict = VibrationVerdict::kSame;
  }
  return out;
}

ComparedVibration vibration_of(const Texture& texture, const std::vector<double>& speed_mps,
                               const std::vector<double>& force_N, double rate_Hz, double piece_s) {
  if (speed_mps.size() != force_N.size()) throw Error("compare: speeds and forces differ in number");
  ComparedVibration out;
  out.rate_Hz = rate_Hz;
  StrokeConfig stroke;
  stroke.rate_Hz = rate_Hz;
  stroke.duration_s = piece_s;
  for (std::size_t i = 0; i < speed_mps.size(); ++i) {
    stroke.speed_mps = speed_mps[i];
    stroke.force_N = force_N[i];
    stroke.seed = static_cast<std::int64_t>(i) + 1;
    out.pieces_mps2.push_back(synthesize_stroke(texture, stroke));
    stroke.start_m += speed_mps[i] * piece_s;
  }
  return out;
}

}  // namespace asperity
