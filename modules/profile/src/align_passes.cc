#include "asperity/profile/align_passes.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>

#include "asperity/base/error.h"
#include "asperity/signal/chi_square.h"
#include "asperity/signal/spectrum.h"
#include "pass_signal.h"
#include "spectrum_at.h"

namespace asperity {

namespace {

// Weights of frequencies, by the coherence that is possible there.
class Weights {
 public:
  Weights(const PassSignal& a, const PassSignal& b, double place_sigma_mm, const AlignPassesConfig& config)
      : a_(a),
        b_(b),
        place_sigma_mm_(place_sigma_mm),
        low_(config.low_cycles_per_mm),
        high_(config.high_cycles_per_mm) {}

  // The density by which both spectra are divided, and the weight of what is left.
  double whitened(double frequency, std::complex<double> a, std::complex<double> b, std::complex<double>& out) const {
    if (frequency < low_ || frequency > high_) return 0.0;
    const double of_a = spectrum_at(a_.frequency, a_.density, frequency);
    const double of_b = spectrum_at(b_.frequency, b_.density, frequency);
    if (!(of_a > 0.0) || !(of_b > 0.0)) return 0.0;
    const double surface_a = std::max(0.0, 1.0 - spectrum_at(a_.frequency, a_.noise, frequency) / of_a);
    const double surface_b = std::max(0.0, 1.0 - spectrum_at(b_.frequency, b_.noise, frequency) / of_b);
    const double phase = 2.0 * std::numbers::pi * frequency * place_sigma_mm_;
    const double weight = surface_a * surface_b * std::exp(-0.5 * phase * phase);
    out = weight / std::sqrt(of_a * of_b) * a * std::conj(b);
    return weight;
  }

 private:
  const PassSignal& a_;
  const PassSignal& b_;
  double place_sigma_mm_, low_, high_;
};

std::vector<std::complex<double>> padded_dft(std::span<const double> x, std::size_t n) {
  std::vector<double> all(n, 0.0);
  std::copy(x.begin(), x.end(), all.begin());
  return real_dft(all);
}

std::vector<double> stretched(const std::vector<double>& x, double stretch) {
  const auto n = static_cast<std::size_t>(static_cast<double>(x.size() - 1) / (1.0 + stretch)) + 1;
  std::vector<double> out(n);
  for (std::size_t i = 0; i < n; ++i) out[i] = height_at(x, static_cast<double>(i) * (1.0 + stretch));
  return out;
}

// What the positions of two passes' paths allow.
struct AllowedPlace {
  bool reversed = false;
  double shift_m = 0.0;  // as PassAlignment has it
  double reach_m = 0.0;
};

std::optional<AllowedPlace> allowed_place(const ProfilePass& reference, const ProfilePass& pass) {
  if (!reference.place || !pass.place) return std::nullopt;
  AllowedPlace out;
  out.reversed = reference.place->backward != pass.place->backward;
  const double ahead_m = (reference.place->backward ? -1.0 : 1.0) * (reference.place->start_m - pass.place->start_m);
  out.shift_m = ahead_m + (out.reversed ? pass.spacing_m * static_cast<double>(pass.size() - 1) : 0.0);
  out.reach_m = std::max(reference.place->reach_m, pass.place->reach_m);
  return out;
}

// Lags, in points.
struct LagRange {
  std::ptrdiff_t first = 0, last = 0;
};

struct Place {
  double value = 0.0;  // of the correlation over its spread
  double lag = 0.0;    // stretched pass[i + lag] lies on reference[i]
  double stretch = 0.0;
  bool reversed = false;
};

// The highest correlation of one stretch and direction, refined below a sample by a parabola.
Place best_lag(const std::vector<std::complex<double>>& reference, std::size_t reference_size,
               const std::vector<double>& pass, std::size_t n, double spacing_mm, const Weights& weights,
               double min_overlap, const std::optional<LagRange>& allowed) {
  const std::vector<std::complex<double>> other = padded_dft(pass, n);
  std::vector<std::complex<double>> cross(other.size());
  double spread = 0.0;
  for (std::size_t k = 1; k + 1 < cross.size(); ++k) {
    weights.whitened(static_cast<double>(k) / (static_cast<double>(n) * spacing_mm), other[k], reference[k], cross[k]);
    spread += 2.0 * std::norm(cross[k]);
  }
  Place out;
  if (!(spread > 0.0)) return out;
  const std::vector<double> value = inverse_real_dft(cross, n);
  // inverse: 2/n Σ Re(…) over k; its variance under even phases: (2/n)² Σ |c|²/2.
  const double sigma = std::sqrt(spread) / static_cast<double>(n);
  const auto at = [&](std::ptrdiff_t lag) {
    const auto size = static_cast<std::ptrdiff_t>(n);
    return value[static_cast<std::size_t>((lag % size + size) % size)];
  };
  const auto length = static_cast<std::ptrdiff_t>(pass.size());
  const auto whole = static_cast<std::ptrdiff_t>(reference_size);
  const auto least = static_cast<std::ptrdiff_t>(min_overlap * static_cast<double>(std::min(length, whole)));
  LagRange range{least - whole, length - least};
  if (allowed) range = {std::max(range.first, allowed->first), std::min(range.last, allowed->last)};
  if (range.first > range.last) return out;
  std::ptrdiff_t best = 0;
  double most = -1.0;
  for (std::ptrdiff_t lag = range.first; lag <= range.last; ++lag) {
    if (at(lag) <= most) continue;
    most = at(lag);
    best = lag;
  }
  const double before = at(best - 1), after = at(best + 1), bend = before - 2.0 * most + after;
  out.value = most / sigma;
  out.lag = static_cast<double>(best) + (bend < 0.0 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0.0);
  return out;
}

// Σ a cos φ over segments with half overlap, in standard deviations of even phases.
double agreement(const std::vector<double>& reference, const std::vector<double>& pass, double spacing_mm,
                 const Weights& weights) {
  const std::size_t segment = std::min(kPassSegment_points, reference.size());
  double sum = 0.0, square = 0.0;
  for (std::size_t begin = 0; begin + segment <= reference.size(); begin += std::max<std::size_t>(segment / 2, 1)) {
    std::vector<double> a(segment), b(segment);
    for (std::size_t i = 0; i < segment; ++i) {
      const double hann =
          0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(segment));
      a[i] = hann * reference[begin + i];
      b[i] = hann * pass[begin + i];
    }
    const std::vector<std::complex<double>> of_a = real_dft(a), of_b = real_dft(b);
    for (std::size_t k = 1; k < of_a.size(); ++k) {
      std::complex<double> cross;
      if (weights.whitened(static_cast<double>(k) / (static_cast<double>(segment) * spacing_mm), of_a[k], of_b[k],
                           cross) == 0.0)
        continue;
      sum += cross.real();
      square += 0.5 * std::norm(cross);
    }
  }
  // Neighbouring lines of a Hann window have a correlation of 2/3, the next of 1/6, in amplitude; neighbouring segments
  // of 1/6. Of products of independent passes these are squared.
  constexpr double kDependent = (1.0 + 2.0 * (4.0 / 9.0 + 1.0 / 36.0)) * (1.0 + 2.0 / 36.0 * 3.0);
  return square > 0.0 ? sum / std::sqrt(kDependent * square) : 0.0;
}

}  // namespace

PassAlignment align_passes(const ProfilePass& reference, const ProfilePass& pass, const AlignPassesConfig& config) {
  if (!(std::abs(reference.spacing_m - pass.spacing_m) <= 1e-9 * reference.spacing_m)) {
    throw Error("passes '" + reference.name + "' and '" + pass.name + "' have different spacings");
  }
  const PassSignal a = pass_signal(reference), forward = pass_signal(pass), backward = reversed(forward);
  const auto place_sigma = [&](const ProfilePass& one) {
    return std::isfinite(one.place_sigma_m) ? one.place_sigma_m : config.place_sigma_m;
  };
  const Weights weights(a, forward, 1e3 * std::hypot(place_sigma(reference), place_sigma(pass)), config);
  const double longest = static_cast<double>(std::max(a.size(), forward.size()));
  const double step = 0.5 / (config.high_cycles_per_mm * longest * a.spacing_mm);
  const auto steps = static_cast<int>(std::ceil(config.max_stretch / step));
  const std::size_t n =
      power_of_two(a.size() + static_cast<std::size_t>(longest * (1.0 + 2.0 * config.max_stretch)) + 2);
  const std::vector<std::complex<double>> of_a = padded_dft(a.height_m, n);

  // In points of each one's heights from its first that is known.
  const double last = static_cast<double>(pass.size() - 1);
  const auto first_known = [&](bool turned) {
    return turned ? last - static_cast<double>(forward.first + forward.size() - 1) : static_cast<double>(forward.first);
  };
  const std::optional<AllowedPlace> allowed = allowed_place(reference, pass);
  const auto allowed_lags = [&](bool turned, double stretch) -> std::optional<LagRange> {
    if (!allowed) return std::nullopt;
    const double lag =
        (allowed->shift_m / pass.spacing_m - first_known(turned)) / (1.0 + stretch) + static_cast<double>(a.first);
    const double reach = allowed->reach_m / pass.spacing_m;
    return LagRange{static_cast<std::ptrdiff_t>(std::floor(lag - reach)),
                    static_cast<std::ptrdiff_t>(std::ceil(lag + reach))};
  };

  Place best;
  for (const bool turned : {false, true}) {
    if (allowed && allowed->reversed != turned) continue;
    for (int i = -steps; i <= steps; ++i) {
      const double stretch = static_cast<double>(i) * step;
      Place place = best_lag(of_a, a.size(), stretched((turned ? backward : forward).height_m, stretch), n,
                             a.spacing_mm, weights, config.min_overlap, allowed_lags(turned, stretch));
      if (place.value <= best.value) continue;
      best = place;
      best.stretch = stretch;
      best.reversed = turned;
    }
  }

  PassAlignment out;
  out.reversed = best.reversed;
  out.stretch = best.stretch;
  const std::vector<double>& chosen = (best.reversed ? backward : forward).height_m;
  std::vector<double> on_a, on_pass;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double place = (static_cast<double>(i) + best.lag) * (1.0 + best.stretch);
    if (place < 0.0 || place > static_cast<double>(chosen.size() - 1)) continue;
    on_a.push_back(a.height_m[i]);
    on_pass.push_back(height_at(chosen, place));
  }
  // In places of the whole arrays.
  out.shift_m =
      pass.spacing_m * (first_known(best.reversed) + (best.lag - static_cast<double>(a.first)) * (1.0 + best.stretch));
  out.score = agreement(on_a, on_pass, a.spacing_mm, weights);
  const double searched = allowed
                              ? 2.0 * allowed->reach_m / pass.spacing_m
                              : static_cast<double>(a.size() + forward.size()) -
                                    2.0 * config.min_overlap * static_cast<double>(std::min(a.size(), forward.size()));
  const double lags = 2.0 * config.high_cycles_per_mm * a.spacing_mm * searched;
  const double trials = (allowed ? 1.0 : 2.0) * std::max(1.0, lags) * static_cast<double>(2 * steps + 1);
  // The normal quantile, by that of its square.
  out.threshold = std::sqrt(chi_square_quantile(1.0 - 2.0 * std::min(0.25, config.false_alarm / trials), 1.0));
  out.agrees = out.score > out.threshold;
  return out;
}

}  // namespace asperity
