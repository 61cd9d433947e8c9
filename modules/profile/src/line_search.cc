#include "line_search.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "asperity/signal/spectrum.h"
#include "asperity/signal/statistics.h"
#include "local_density.h"
#include "spectrum_at.h"

namespace asperity {

namespace {

constexpr int kHarmonicsAsked = 8;
constexpr double kPitchReach = 0.02;        // relative: as far as a first pitch may be off
constexpr double kLeastShare = 1.0 / 32.0;  // of the surface's power in a pattern's strongest line
constexpr double kFullTurn = 2.0 * std::numbers::pi;
constexpr double kWaveStep = 1e-3;                 // of the wave's frequency, in independent frequencies
constexpr double kPeakFrequencies = 32.0;          // asked for among few neighbours
constexpr double kPairChance = 0.1;                // of the chance of a search: that of its pairs
constexpr double kPairOrder = 1.5811388300841898;  // √(5/2): RMS of 1 and 2
constexpr double kFlatStep = 1e-3;                 // relative
constexpr int kFlatHalvings = 40;

// Neighbours of a harmonic.
constexpr std::size_t kNearestNeighbour = 2;   // in independent frequencies: a line's own foot is left out
constexpr std::size_t kFarthestNeighbour = 8;  // as far as a hand's tremor keeps its density
constexpr std::size_t kFewestOfOneSide = 4;    // of one side

// The exponent q of exp(-q), the probability that an ordinate of a random process is so many times an estimate of its
// density that scatters as a gamma variable: (1 + v ratio)^(-1/v), v the variance of the estimate's logarithm.
double rarity_of(double ratio, double variance) { return std::log1p(variance * ratio) / variance; }

// Of one side of a wave, at the wave: the noise that is expected there and a flat density, by the median. Without a
// noise the median itself.
double density_of_side(std::span<const double> power, std::span<const double> noise, double noise_here) {
  double low = 0.0, high = median(power) / std::numbers::ln2;
  std::vector<double> ratio(power.size());
  for (int halving = 0; halving < kFlatHalvings && high - low > kFlatStep * (high + noise_here); ++halving) {
    const double flat = 0.5 * (low + high);
    for (std::size_t i = 0; i < power.size(); ++i) ratio[i] = power[i] / (noise[i] + flat);
    (median(ratio) > std::numbers::ln2 ? low : high) = flat;
  }
  return noise_here + high;
}

}  // namespace

LineSearch::LineSearch(std::span<const double> height_m, double spacing_m, std::span<const double> frequency,
                       std::span<const double> noise_psd_m2_mm, double most_noise, double shortest_m, double longest_m,
                       const Hypotheses& hypotheses)
    : x_m_(height_m.size(), 0.0),
      present_(height_m.size(), false),
      spacing_m_(spacing_m),
      most_noise_(most_noise),
      hypotheses_(hypotheses),
      middle_per_m_(0.5 * (1.0 / shortest_m + 1.0 / longest_m)) {
  std::vector<double> x(kPadding * height_m.size(), 0.0);
  double sum = 0.0;
  for (const double h : height_m) {
    if (!std::isfinite(h)) continue;
    points_ += 1.0;
    sum += h;
  }
  for (std::size_t i = 0; i < height_m.size(); ++i) {
    if (!std::isfinite(height_m[i])) continue;
    x[i] = x_m_[i] = height_m[i] - sum / points_;
    present_[i] = true;
  }
  length_m_ = spacing_m * static_cast<double>(x.size());
  const double profile_m = spacing_m * static_cast<double>(height_m.size());
  searched_ = std::max(2.0, profile_m / shortest_m);
  trials_ = std::max(2.0, profile_m * (1.0 / shortest_m - 1.0 / longest_m));
  searched_bins_ = static_cast<std::size_t>(length_m_ / shortest_m) + 1;
  // Fewer heights than independent frequencies do not tell these apart. Such a path is wild and long, and nearly every
  // ordinate would be asked.
  if (points_ == 0.0 || points_ < std::min(searched_, 0.5 * static_cast<double>(height_m.size()))) return;
  for (const std::complex<double>& line : real_dft(x)) {
    power_.push_back(2e3 * spacing_m * std::norm(line) / points_);
    const double at = 1e-3 * static_cast<double>(power_.size() - 1) / length_m_;
    const double expected = frequency.empty() ? 0.0 : spectrum_at(frequency, noise_psd_m2_mm, at);
    noise_.push_back(most_noise * expected);
    if (power_.size() > 1) surface_ += (power_.back() - expected) / static_cast<double>(kPadding);
  }
  // Ordinates that noise does not reach are the surface's. Where the noise is stated too large elsewhere, the sum over
  // all of them may be near 0 or below it, and every one would hold its share.
  double beyond_noise = 0.0;
  for (std::size_t bin = 1; bin < power_.size(); ++bin) {
    if (exceeds_noise(bin)) beyond_noise += (power_[bin] - noise_[bin]) / static_cast<double>(kPadding);
  }
  surface_ = std::max(surface_, beyond_noise);
}

// Of the highest sum of the rarities of the first K waves, over a continuous range of frequencies: half of a χ² process
// of 2K degrees of freedom, which exceeds T with N m T^(K - 1/2) exp(-T) / (K - 1)!, m² the mean square of the waves'
// orders (Davies 1987). Over a continuous range of directions too, a χ² field, with 1 + √(4π T) m c times that, c the
// range of directions times the RMS phase in cycles that a unit of it adds (Adler and Taylor, Random Fields and
// Geometry, 15.10: the Euler characteristic in one and two dimensions). Both of K = 1 and K = 2 are asked.
bool LineSearch::is_rare(double rarity, std::size_t waves, double trials, double bend_cycles) const {
  const bool pair = waves == 2;
  const double orders = pair ? kPairOrder : 1.0, least = std::max(1.0, rarity);
  const double chance = hypotheses_.share * kByChance * (pair ? kPairChance : 1.0 - kPairChance);
  const double directions = 1.0 + std::sqrt(4.0 * std::numbers::pi * least) * orders * bend_cycles;
  return rarity > std::log(trials * orders * directions / chance) + (pair ? 1.5 : 0.5) * std::log(least);
}

// Among many neighbours over all frequencies of the search; among few over those of a peak, at its own frequency.
bool LineSearch::are_rare(const Rarities& rarities, std::size_t waves, const Wave& first) const {
  const double per_m = first.cycles / (spacing_m_ * static_cast<double>(x_m_.size()));
  return is_rare(rarities.broad, waves, trials_, hypotheses_.bend_by_range_m * middle_per_m_) &&
         is_rare(rarities.narrow, waves, kPeakFrequencies, hypotheses_.bend_by_range_m * per_m);
}

double LineSearch::power_at(std::span<const double> heights_m, double cycles) const {
  const double f = cycles / static_cast<double>(heights_m.size());
  const std::complex<double> step = std::polar(1.0, -kFullTurn * f);
  std::complex<double> sum = 0.0, phasor = 1.0;
  for (std::size_t k = 0; k < heights_m.size(); ++k) {
    // Renewed now and then: the product's rounding errors add up.
    if (k % 256 == 0) phasor = std::polar(1.0, -kFullTurn * std::fmod(f * static_cast<double>(k), 1.0));
    sum += heights_m[k] * phasor;
    phasor *= step;
  }
  return 2e3 * spacing_m_ * std::norm(sum) / points_;
}

// The highest ordinate near a bin, between the bins too.
LineSearch::Wave LineSearch::find_wave(std::size_t bin) const {
  Wave out{static_cast<double>(bin) / static_cast<double>(kPadding), power_[bin]};
  for (double step = 0.5 / static_cast<double>(kPadding); step > kWaveStep; step *= 0.5) {
    for (const double cycles : {out.cycles - step, out.cycles + step}) {
      const double power = power_at(x_m_, cycles);
      if (power <= out.power) continue;
      out = {cycles, power};
      break;
    }
  }
  return out;
}

// The heights less the wave, by least squares: in gaps it would go on and spread over its neighbours.
std::vector<double> LineSearch::without_wave(double cycles) const {
  const double turn = kFullTurn * cycles / static_cast<double>(x_m_.size());
  double cc = 0.0, cs = 0.0, ss = 0.0, cx = 0.0, sx = 0.0;
  for (std::size_t k = 0; k < x_m_.size(); ++k) {
    if (!present_[k]) continue;
    const double c = std::cos(turn * static_cast<double>(k)), s = std::sin(turn * static_cast<double>(k));
    cc += c * c;
    cs += c * s;
    ss += s * s;
    cx += c * x_m_[k];
    sx += s * x_m_[k];
  }
  const double determinant = cc * ss - cs * cs;
  if (!(determinant > 0.0)) return x_m_;
  const double a = (ss * cx - cs * sx) / determinant, b = (cc * sx - cs * cx) / determinant;
  std::vector<double> out(x_m_.size(), 0.0);
  for (std::size_t k = 0; k < x_m_.size(); ++k) {
    if (!present_[k]) continue;
    const double angle = turn * static_cast<double>(k);
    out[k] = x_m_[k] - a * std::cos(angle) - b * std::sin(angle);
  }
  return out;
}

double LineSearch::rarity_among(const Wave& wave, const Neighbours& neighbours, std::span<const double> rest_m,
                                double& density) const {
  struct Side {
    std::vector<double> power, noise;
  };
  std::vector<double> offset, power;
  Side below, above;
  const auto expected_at = [&](double cycles) {
    const auto bin = static_cast<std::size_t>(std::lround(cycles * static_cast<double>(kPadding)));
    return noise_[std::min(bin, noise_.size() - 1)] / most_noise_;
  };
  for (double j = neighbours.nearest; j <= neighbours.farthest; j += 1.0) {
    for (const double at : {-j, j}) {
      const double cycles = wave.cycles + at;
      if (cycles < 0.75 || cycles > 0.5 * static_cast<double>(x_m_.size())) continue;
      offset.push_back(at);
      power.push_back(power_at(rest_m, cycles));
      Side& side = at < 0.0 ? below : above;
      side.power.push_back(power.back());
      side.noise.push_back(expected_at(cycles));
    }
  }
  const LocalDensity fit = fit_local_density(offset, power);
  if (fit.used == 0) return 0.0;
  density = fit.density;
  // At the edge of a band the other side is empty, and a parabola fits neither.
  for (const Side& side : {below, above}) {
    if (neighbours.sides && side.power.size() >= kFewestOfOneSide)
      density = std::max(density, density_of_side(side.power, side.noise, expected_at(wave.cycles)));
  }
  return rarity_of(wave.power / density, fit.variance);
}

// Broad spectra by many neighbours; a peak as narrow as a twentieth of its frequency by few.
LineSearch::Rarities LineSearch::rarities_of(const Wave& wave) const {
  const std::vector<double> rest_m = without_wave(wave.cycles);
  const double periods = wave.cycles, nearest = periods < 50.0 ? 1.0 : periods < 100.0 ? 2.0 : 3.0;
  Rarities out;
  double beside = 0.0;
  out.broad = rarity_among(wave, {2.0, 16.0, true}, rest_m, out.density);
  out.narrow = rarity_among(wave, {nearest, std::clamp(std::round(0.16 * periods), 5.0, 16.0), false}, rest_m, beside);
  return out;
}

bool LineSearch::exceeds_noise(std::size_t bin) const {
  return power_[bin] > 0.0 && (!(noise_[bin] > 0.0) || is_rare(power_[bin] / noise_[bin], 1, trials_,
                                                               hypotheses_.bend_by_range_m * middle_per_m_));
}

bool LineSearch::holds_share(double power) const {
  const double gaps = static_cast<double>(x_m_.size()) / points_;
  return power > 0.0 && gaps * power > kLeastShare * surface_;
}

bool LineSearch::may_be_line(std::size_t bin) const {
  const double power = power_[bin];
  if (!holds_share(power)) return false;
  if (power < power_[bin - 1] || (bin + 1 < power_.size() && power < power_[bin + 1])) return false;
  return exceeds_noise(bin);
}

std::size_t LineSearch::count_candidates() const {
  std::size_t out = 0;
  for (std::size_t bin = 1; bin < std::min(searched_bins_, power_.size()); ++bin) out += may_be_line(bin) ? 1 : 0;
  return out;
}

bool LineSearch::is_line(std::size_t bin) const {
  if (!may_be_line(bin)) return false;
  const Wave wave = find_wave(bin);
  return are_rare(rarities_of(wave), 1, wave);
}

LineSearch::Reach LineSearch::reach_of(double pitch_m, int harmonic) const {
  const double middle = harmonic * length_m_ / pitch_m, reach = std::max(1.0, kPitchReach * middle);
  return {static_cast<std::size_t>(std::max(1.0, std::ceil(middle - reach))),
          std::min(static_cast<std::size_t>(middle + reach) + 1, power_.size())};
}

bool LineSearch::has_pattern(double pitch_m) const {
  for (int h = 1; h <= kHarmonicsAsked; ++h) {
    const Reach reach = reach_of(pitch_m, h);
    for (std::size_t bin = reach.first; bin < std::min(reach.last, searched_bins_); ++bin) {
      if (is_line(bin)) return true;
    }
  }
  const Reach reach = reach_of(pitch_m, 1);
  return find_pair(reach.first, reach.last) > 0;
}

double LineSearch::find_line_m(double shortest_m, double longest_m) const {
  const auto first = static_cast<std::size_t>(std::max(1.0, std::ceil(length_m_ / longest_m)));
  const auto last = static_cast<std::size_t>(length_m_ / shortest_m);
  std::size_t best = 0;
  for (std::size_t bin = first; bin <= last && bin < power_.size(); ++bin) {
    if ((best == 0 || power_[bin] > power_[best]) && is_line(bin)) best = bin;
  }
  if (best == 0) best = find_pair(first, last + 1);
  return best > 0 ? length_m_ / static_cast<double>(best) : 0.0;
}

bool LineSearch::is_local_line(std::size_t bin, double near_trials) const {
  if (!(power_[bin] > std::log(searched_ * near_trials / kByChance) * noise_[bin])) return false;
  std::vector<double> below, above;
  for (std::size_t j = kNearestNeighbour; j <= kFarthestNeighbour; ++j) {
    if (bin > j * kPadding) below.push_back(power_[bin - j * kPadding]);
    if (bin + j * kPadding < power_.size()) above.push_back(power_[bin + j * kPadding]);
  }
  if (below.size() < kFewestOfOneSide && above.size() < kFewestOfOneSide) return true;
  // The higher side: at the edge of a band, as a tremor's, the other one is empty.
  const double around = std::max(below.size() < kFewestOfOneSide ? 0.0 : median(below),
                                 above.size() < kFewestOfOneSide ? 0.0 : median(above));
  const auto m = static_cast<double>(below.size() + above.size());
  const double clear = 0.5 * m * (std::pow(near_trials / kByChance, 2.0 / m) - 1.0);
  return power_[bin] > clear * around / std::numbers::ln2;
}

bool LineSearch::has_line(double pitch_m, int harmonic) const {
  const Reach reach = reach_of(pitch_m, harmonic);
  if (reach.first >= reach.last) return false;
  const double near_trials = 2.0 * kFarthestNeighbour + std::max(1.0, static_cast<double>(reach.last - reach.first) /
                                                                          static_cast<double>(kPadding));
  for (std::size_t bin = reach.first; bin < reach.last; ++bin) {
    if (is_local_line(bin, near_trials)) return true;
  }
  return false;
}

}  // namespace asperity
