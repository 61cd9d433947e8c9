#include "compare_passes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Core>

#include "asperity/algebra/solve.h"
#include "asperity/signal/spectrum.h"
#include "pass_signal.h"
#include "spectrum_at.h"

namespace asperity {

namespace {

constexpr double kSure95 = 1.96;

// The longest stretch in which all passes are known.
std::pair<std::size_t, std::size_t> shared_stretch(std::span<const PassOnGrid> passes) {
  const std::size_t points = passes.front().known.size();
  std::size_t best = 0, best_end = 0, begin = 0;
  for (std::size_t i = 0; i <= points; ++i) {
    const bool all = i < points && std::all_of(passes.begin(), passes.end(),
                                               [&](const PassOnGrid& pass) { return pass.known[i] != 0; });
    if (all) continue;
    if (i - begin > best_end - best) {
      best = begin;
      best_end = i;
    }
    begin = i + 1;
  }
  return {best, best_end};
}

struct Band {
  double low, high;
  bool holds(double f) const { return f >= low && f <= high; }
};

double power(const PowerSpectrum& spectrum, const Band& band) {
  double sum = 0.0;
  for (std::size_t i = 0; i < spectrum.density.size(); ++i)
    sum += band.holds(spectrum.frequency[i]) ? spectrum.density[i] : 0.0;
  return sum * spectrum.frequency[1];
}

double square(double x) { return x * x; }

// Of all pairs the one whose difference has the least power for what both state.
template <class SpectrumOf>
void find_closest(std::span<const PassOnGrid> passes, std::size_t begin, const SpectrumOf& spectrum_of,
                  const Band& band, PassDifferences& out) {
  for (std::size_t b = 1; b < passes.size(); ++b) {
    for (std::size_t a = 0; a < b; ++a) {
      const PowerSpectrum apart =
          spectrum_of([&](std::size_t i) { return passes[a].texture_m[begin + i] - passes[b].texture_m[begin + i]; });
      const double step = apart.frequency[1];
      double stated_m2 = 0.0, stated_square = 0.0;
      for (const double f : apart.frequency) {
        if (!band.holds(f)) continue;
        const double both = stated_noise_m2_mm(*passes[a].pass, f) + stated_noise_m2_mm(*passes[b].pass, f);
        stated_m2 += step * both;
        stated_square += square(step * both);
      }
      if (!(stated_m2 > 0.0)) continue;
      // As many independent squares as the stated noise would have, if it were there.
      const double freedom = 2.0 * out.independent_segments * stated_m2 * stated_m2 / stated_square;
      const double error = std::hypot(std::max(passes[a].pass->noise_relative, passes[b].pass->noise_relative),
                                      std::sqrt(2.0 / freedom));
      const double ratio = power(apart, band) / stated_m2;
      const double high = ratio * std::exp(kSure95 * error);
      if (std::isfinite(out.closest_ratio_high) && high >= out.closest_ratio_high) continue;
      out.closest_first = a;
      out.closest_second = b;
      out.closest_ratio = ratio;
      out.closest_ratio_high = high;
    }
  }
}

// The differences as noise and lines apart.
SplitDifferences parts_of(const PassDifferences& differences, const PowerSpectrum& of_mean,
                          std::span<const PassOnGrid> passes, const Band& band) {
  const double count = static_cast<double>(passes.size());
  std::vector<double> frequency, difference, noise, surface;
  for (std::size_t i = 0; i < of_mean.frequency.size(); ++i) {
    const double f = of_mean.frequency[i];
    if (!band.holds(f)) continue;
    double stated = 0.0;
    for (const PassOnGrid& pass : passes) stated += stated_noise_m2_mm(*pass.pass, f) / count;
    frequency.push_back(f);
    difference.push_back(differences.scatter_psd_m2_mm[i]);
    noise.push_back(stated);
    surface.push_back(std::max(0.0, of_mean.density[i] - differences.scatter_psd_m2_mm[i] / count));
  }
  return split_differences(frequency, difference, noise, surface);
}

}  // namespace

PassDifferences compare_passes(std::span<const PassOnGrid> passes, double spacing_mm, const AlignPassesConfig& config) {
  PassDifferences out;
  const auto stretch = shared_stretch(passes);
  const std::size_t begin = stretch.first, end = stretch.second;
  if (end < begin + kPassSegment_points) return out;
  const std::size_t points = end - begin;
  const double count = static_cast<double>(passes.size());
  out.independent_segments = static_cast<double>(points) / static_cast<double>(kPassSegment_points);
  const Band band{config.low_cycles_per_mm, config.high_cycles_per_mm};
  std::vector<double> all(points, 0.0);
  for (const PassOnGrid& pass : passes) {
    for (std::size_t i = 0; i < points; ++i) all[i] += pass.texture_m[begin + i];
  }
  const auto spectrum_of = [&](const auto& value) {
    std::vector<double> x(points);
    for (std::size_t i = 0; i < points; ++i) x[i] = value(i);
    return welch(x, 1.0 / spacing_mm, kPassSegment_points);
  };
  const PowerSpectrum of_mean = spectrum_of([&](std::size_t i) { return all[i] / count; });
  out.frequency_cycles_per_mm = of_mean.frequency;
  out.scatter_psd_m2_mm.assign(of_mean.density.size(), 0.0);
  std::vector<double> difference_m2;
  for (const PassOnGrid& pass : passes) {
    const auto own = [&](std::size_t i) { return pass.texture_m[begin + i]; };
    const auto others = [&](std::size_t i) { return (all[i] - own(i)) / (count - 1.0); };
    const PowerSpectrum apart = spectrum_of([&](std::size_t i) { return own(i) - others(i); });
    const PowerSpectrum of_own = spectrum_of(own), of_others = spectrum_of(others);
    // y − mean of the others is K/(K−1) of y − mean of all.
    for (std::size_t i = 0; i < apart.density.size(); ++i)
      out.scatter_psd_m2_mm[i] += apart.density[i] * (count - 1.0) / (count * count);
    difference_m2.push_back(power(apart, band));
    const double product_m2 = 0.5 * (power(of_own, band) + power(of_others, band) - difference_m2.back());
    out.coherence.push_back(product_m2 * std::abs(product_m2) / (power(of_own, band) * power(of_others, band)));
  }

  find_closest(passes, begin, spectrum_of, band, out);

  // Stated: added noise, places that differ as the passes state, and their scales.
  double stated_sum_m2 = 0.0, scatter_m2 = 0.0, scatter_square = 0.0, relative = 0.0;
  const double step = of_mean.frequency[1];
  for (const PassOnGrid& pass : passes) {
    const double place_mm =
        1e3 * (std::isfinite(pass.pass->place_sigma_m) ? pass.pass->place_sigma_m : config.place_sigma_m);
    double stated_m2 = 0.0;
    for (std::size_t i = 0; i < of_mean.frequency.size(); ++i) {
      const double f = of_mean.frequency[i];
      if (!band.holds(f)) continue;
      const double surface = std::max(0.0, of_mean.density[i] - out.scatter_psd_m2_mm[i] / count);
      const double phase = 2.0 * std::numbers::pi * f * place_mm;
      stated_m2 += step * (stated_noise_m2_mm(*pass.pass, f) + surface * 2.0 * (1.0 - std::exp(-0.5 * phase * phase)) +
                           surface * pass.pass->scale_sigma * pass.pass->scale_sigma);
    }
    out.stated_m2.push_back(stated_m2);
    stated_sum_m2 += stated_m2 / count;
    relative += pass.pass->noise_relative / count;
  }
  for (std::size_t i = 0; i < of_mean.frequency.size(); ++i) {
    if (!band.holds(of_mean.frequency[i])) continue;
    scatter_m2 += step * out.scatter_psd_m2_mm[i];
    scatter_square += std::pow(step * out.scatter_psd_m2_mm[i], 2);
  }
  if (!(stated_sum_m2 > 0.0) || !(scatter_m2 > 0.0)) {
    out.noise_m2 = std::vector<double>(passes.size(), kNan);
    return out;
  }
  // A line of the spectrum holds two squares a segment of independent length.
  const double freedom = 2.0 * (count - 1.0) * out.independent_segments * scatter_m2 * scatter_m2 / scatter_square;
  const double error = std::hypot(relative, std::sqrt(2.0 / freedom));
  out.ratio = scatter_m2 / stated_sum_m2;
  out.parts = parts_of(out, of_mean, passes, band);
  out.ratio_low = out.ratio * std::exp(-kSure95 * error);
  out.ratio_high = out.ratio * std::exp(kSure95 * error);

  // D_k = V_k + Σ_{j≠k} V_j/(K−1)² (Grubbs 1948); of two passes only the sum is known.
  if (passes.size() == 2) {
    const double stated_both_m2 = out.stated_m2[0] + out.stated_m2[1];
    for (const double stated_m2 : out.stated_m2) out.noise_m2.push_back(difference_m2[0] * stated_m2 / stated_both_m2);
    return out;
  }
  const auto size = static_cast<Eigen::Index>(passes.size());
  Eigen::MatrixXd mixing = Eigen::MatrixXd::Constant(size, size, 1.0 / ((count - 1.0) * (count - 1.0)));
  mixing.diagonal().setOnes();
  const Eigen::VectorXd solved = solve_symmetric(mixing, Eigen::Map<const Eigen::VectorXd>(difference_m2.data(), size));
  for (Eigen::Index k = 0; k < size; ++k) out.noise_m2.push_back(std::max(0.0, solved[k]));
  return out;
}

}  // namespace asperity
