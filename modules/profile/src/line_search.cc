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

constexpr std::size_t kLinePadding = 4;  // bins to an independent frequency
constexpr int kHarmonicsAsked = 8;
constexpr double kPitchReach = 0.02;        // relative: as far as a first pitch may be off
constexpr double kLeastShare = 1.0 / 32.0;  // of the surface's power in a pattern's strongest line
constexpr double kFullTurn = 2.0 * std::numbers::pi;
constexpr double kWaveStep = 1e-3;  // of the wave's frequency, in independent frequencies

// Neighbours of a harmonic.
constexpr std::size_t kNearestNeighbour = 2;   // in independent frequencies: a line's own foot is left out
constexpr std::size_t kFarthestNeighbour = 8;  // as far as a hand's tremor keeps its density
constexpr std::size_t kFewestOfOneSide = 4;    // of one side

// The exponent q of exp(-q), the probability that an ordinate of a random process is so many times an estimate of its
// density that scatters as a gamma variable: (1 + v ratio)^(-1/v), v the variance of the estimate's logarithm.
double rarity_of(double ratio, double variance) { return std::log1p(variance * ratio) / variance; }

}  // namespace

LineSearch::LineSearch(std::span<const double> height_m, double spacing_m, std::span<const double> frequency,
                       std::span<const double> noise_psd_m2_mm, double most_noise, double shortest_m, double longest_m,
                       const Hypotheses& hypotheses)
    : x_m_(height_m.size(), 0.0),
      present_(height_m.size(), false),
      spacing_m_(spacing_m),
      hypotheses_(hypotheses),
      cycles_by_range_(0.5 * hypotheses.bend_by_range_m * (1.0 / shortest_m + 1.0 / longest_m)) {
  std::vector<double> x(kLinePadding * height_m.size(), 0.0);
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
    if (power_.size() > 1) surface_ += (power_.back() - expected) / static_cast<double>(kLinePadding);
  }
  // Ordinates that noise does not reach are the surface's. Where the noise is stated too large elsewhere, the sum over
  // all of them may be near 0 or below it, and every one would hold its share.
  double beyond_noise = 0.0;
  for (std::size_t bin = 1; bin < power_.size(); ++bin) {
    if (exceeds_noise(bin)) beyond_noise += (power_[bin] - noise_[bin]) / static_cast<double>(kLinePadding);
  }
  surface_ = std::max(surface_, beyond_noise);
}

// Of the highest ordinate of a continuous range of frequencies (Davies 1987), over a continuous range of directions
// too: the highest of a random field of exp(-q) exceeds q with N √q (1 + √(4π q) c) exp(-q), c the range of directions
// times the RMS phase in cycles that a unit of it adds (Adler and Taylor, Random Fields and Geometry, 15.10: the
// Euler characteristic of a χ² field of two degrees of freedom in one and two dimensions).
bool LineSearch::is_rare(double rarity, double trials) const {
  const double directions = 1.0 + std::sqrt(4.0 * std::numbers::pi * std::max(1.0, rarity)) * cycles_by_range_;
  return rarity >
         std::log(trials * directions / (hypotheses_.share * kByChance)) + 0.5 * std::log(std::max(1.0, rarity));
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
  Wave out{static_cast<double>(bin) / static_cast<double>(kLinePadding), power_[bin]};
  for (double step = 0.5 / static_cast<double>(kLinePadding); step > kWaveStep; step *= 0.5) {
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

bool LineSearch::exceeds(const Wave& wave, const Neighbours& neighbours, std::span<const double> rest_m) const {
  std::vector<double> offset, power, below, above;
  for (double j = neighbours.nearest; j <= neighbours.farthest; j += 1.0) {
    for (const double at : {-j, j}) {
      const double cycles = wave.cycles + at;
      if (cycles < 0.75 || cycles > 0.5 * static_cast<double>(x_m_.size())) continue;
      offset.push_back(at);
      power.push_back(power_at(rest_m, cycles));
      (at < 0.0 ? below : above).push_back(power.back());
    }
  }
  const LocalDensity fit = fit_local_density(offset, power);
  if (fit.used == 0) return false;
  double density = fit.density;
  // At the edge of a band the other side is empty, and a parabola fits neither.
  for (const std::vector<double>& side : {below, above}) {
    if (neighbours.sides && side.size() >= kFewestOfOneSide)
      density = std::max(density, median(side) / std::numbers::ln2);
  }
  return is_rare(rarity_of(wave.power / density, fit.variance), neighbours.trials);
}

bool LineSearch::exceeds_noise(std::size_t bin) const {
  return power_[bin] > 0.0 && (!(noise_[bin] > 0.0) || is_rare(power_[bin] / noise_[bin], trials_));
}

bool LineSearch::may_be_line(std::size_t bin) const {
  const double power = power_[bin];
  const double gaps = static_cast<double>(x_m_.size()) / points_;
  if (!(power > 0.0) || !(gaps * power > kLeastShare * surface_)) return false;
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
  const std::vector<double> rest_m = without_wave(wave.cycles);
  // Broad spectra by many neighbours, for all frequencies of the search; a narrow peak by few, for those of the peak,
  // as narrow as a twentieth of its frequency.
  const double periods = wave.cycles;
  const double nearest = periods < 50.0 ? 1.0 : periods < 100.0 ? 2.0 : 3.0;
  return exceeds(wave, {2.0, 16.0, trials_, true}, rest_m) &&
         exceeds(wave, {nearest, std::clamp(std::round(0.16 * periods), 5.0, 16.0), 32.0, false}, rest_m);
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
  return false;
}

double LineSearch::find_line_m(double shortest_m, double longest_m) const {
  const auto first = static_cast<std::size_t>(std::max(1.0, std::ceil(length_m_ / longest_m)));
  const auto last = static_cast<std::size_t>(length_m_ / shortest_m);
  std::size_t best = 0;
  for (std::size_t bin = first; bin <= last && bin < power_.size(); ++bin) {
    if ((best == 0 || power_[bin] > power_[best]) && is_line(bin)) best = bin;
  }
  return best > 0 ? length_m_ / static_cast<double>(best) : 0.0;
}

bool LineSearch::is_local_line(std::size_t bin, double near_trials) const {
  if (!(power_[bin] > std::log(searched_ * near_trials / kByChance) * noise_[bin])) return false;
  std::vector<double> below, above;
  for (std::size_t j = kNearestNeighbour; j <= kFarthestNeighbour; ++j) {
    if (bin > j * kLinePadding) below.push_back(power_[bin - j * kLinePadding]);
    if (bin + j * kLinePadding < power_.size()) above.push_back(power_[bin + j * kLinePadding]);
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
                                                                          static_cast<double>(kLinePadding));
  for (std::size_t bin = reach.first; bin < reach.last; ++bin) {
    if (is_local_line(bin, near_trials)) return true;
  }
  return false;
}

}  // namespace asperity
