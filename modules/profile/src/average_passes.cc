#include "average_passes.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "asperity/base/nan.h"
#include "asperity/signal/spectrum.h"
#include "pass_signal.h"
#include "spectrum_at.h"

namespace asperity {

namespace {

constexpr double kLowestBand_cycles_per_mm = 0.2;  // all below is one band
constexpr double kPassBandRatio = 2.0;
constexpr double kDensities_per_band = 8.0;

// Share of a frequency that is in a band: bands overlap with cosines over the logarithm, and add up to 1.
double band_share(double frequency, std::size_t band, std::size_t bands) {
  const double place =
      frequency > 0.0 ? std::log(frequency / kLowestBand_cycles_per_mm) / std::log(kPassBandRatio) : -1e9;
  const double clamped = std::clamp(place, 0.0, static_cast<double>(bands - 1));
  const double away = std::abs(clamped - static_cast<double>(band));
  return away >= 1.0 ? 0.0 : 0.5 + 0.5 * std::cos(std::numbers::pi * away);
}

std::vector<double> in_band(const std::vector<std::complex<double>>& spectrum, std::size_t n, std::size_t points,
                            double spacing_mm, std::size_t band, std::size_t bands) {
  std::vector<std::complex<double>> part(spectrum.size());
  for (std::size_t k = 0; k < part.size(); ++k) {
    const double f = static_cast<double>(k) / (static_cast<double>(n) * spacing_mm);
    part[k] = band_share(f, band, bands) * spectrum[k];
  }
  std::vector<double> out = inverse_real_dft(part, n);
  out.resize(points);
  return out;
}

double noise_m2_mm(const PassOnGrid& pass, double cycles_per_mm) {
  if (pass.noise_psd_m2_mm.empty()) return 0.0;
  return spectrum_at(pass.frequency_cycles_per_mm, pass.noise_psd_m2_mm, cycles_per_mm);
}

// The power of a density in a band.
template <class Density>
double band_power(const std::vector<double>& frequency, std::size_t band, std::size_t bands, Density density) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < frequency.size(); ++i) {
    const double step = frequency[i + 1] - frequency[i], at = 0.5 * (frequency[i] + frequency[i + 1]);
    sum += step * band_share(at, band, bands) * density(at);
  }
  return sum;
}

}  // namespace

double stated_noise_m2_mm(const ProfilePass& pass, double cycles_per_mm) {
  if (pass.noise_psd_m2_mm.empty()) return 0.0;
  return spectrum_at(pass.frequency_cycles_per_mm, pass.noise_psd_m2_mm, cycles_per_mm);
}

AveragedPasses average_passes(std::span<const PassOnGrid> passes, double spacing_mm) {
  const std::size_t points = passes.front().texture_m.size();
  AveragedPasses out;
  const double highest = 0.5 / spacing_mm;
  const auto bands = static_cast<std::size_t>(
      std::max(1.0, std::ceil(std::log(highest / kLowestBand_cycles_per_mm) / std::log(kPassBandRatio)) + 1.0));
  for (double f = 0.05 * kLowestBand_cycles_per_mm; f < highest * 1.0001;
       f *= std::pow(kPassBandRatio, 1.0 / kDensities_per_band))
    out.frequency_cycles_per_mm.push_back(std::min(f, highest));
  out.noise_psd_m2_mm.assign(out.frequency_cycles_per_mm.size(), 0.0);

  const std::size_t n = power_of_two(points + 256);
  std::vector<std::vector<std::complex<double>>> spectra;
  for (const PassOnGrid& pass : passes) {
    std::vector<double> padded(n, 0.0);
    std::copy(pass.texture_m.begin(), pass.texture_m.end(), padded.begin());
    spectra.push_back(real_dft(padded));
  }

  out.texture_m.assign(points, 0.0);
  out.sigma_m.assign(points, 0.0);
  out.weight.assign(passes.size(), 0.0);
  for (std::size_t band = 0; band < bands; ++band) {
    // Without a stated noise of each pass all count alike.
    std::vector<double> power_m2(passes.size());
    for (std::size_t k = 0; k < passes.size(); ++k) {
      power_m2[k] =
          band_power(out.frequency_cycles_per_mm, band, bands, [&](double f) { return noise_m2_mm(passes[k], f); });
    }
    const bool known_noise = std::all_of(power_m2.begin(), power_m2.end(), [](double one_m2) { return one_m2 > 0.0; });
    std::vector<std::vector<double>> parts;
    for (const auto& spectrum : spectra) parts.push_back(in_band(spectrum, n, points, spacing_mm, band, bands));
    std::vector<double> square_of_weight(passes.size(), 0.0), mean_weight(passes.size(), 0.0);
    double counted = 0.0;
    std::vector<double> weight(passes.size());
    for (std::size_t i = 0; i < points; ++i) {
      double sum = 0.0;
      for (std::size_t k = 0; k < passes.size(); ++k) {
        const double sigma = passes[k].noisier[i];
        weight[k] = passes[k].known[i] == 0 ? 0.0 : 1.0 / ((known_noise ? power_m2[k] : 1.0) * sigma * sigma);
        sum += weight[k];
      }
      if (!(sum > 0.0)) continue;
      counted += 1.0;
      for (std::size_t k = 0; k < passes.size(); ++k) {
        const double w = weight[k] / sum;
        out.texture_m[i] += w * parts[k][i];
        if (known_noise) out.sigma_m[i] += w * w * power_m2[k] * passes[k].noisier[i] * passes[k].noisier[i];
        square_of_weight[k] += w * w;
        mean_weight[k] += w;
      }
    }
    for (std::size_t k = 0; k < passes.size() && counted > 0.0; ++k) {
      out.weight[k] += mean_weight[k] / counted / static_cast<double>(bands);
      for (std::size_t i = 0; i < out.frequency_cycles_per_mm.size(); ++i) {
        const double f = out.frequency_cycles_per_mm[i];
        out.noise_psd_m2_mm[i] +=
            band_share(f, band, bands) * square_of_weight[k] / counted * noise_m2_mm(passes[k], f);
      }
    }
  }

  out.slow_m.assign(points, kNan);
  for (std::size_t i = 0; i < points; ++i) {
    double sum = 0.0, count = 0.0;
    bool any = false;
    for (const PassOnGrid& pass : passes) {
      any |= pass.known[i] != 0;
      if (pass.known[i] == 0 || !std::isfinite(pass.slow_m[i])) continue;
      sum += pass.slow_m[i];
      count += 1.0;
    }
    out.sigma_m[i] = std::sqrt(out.sigma_m[i]);
    if (count > 0.0) out.slow_m[i] = sum / count;
    if (any) continue;
    out.texture_m[i] = kNan;
    out.sigma_m[i] = kNan;
  }
  return out;
}

}  // namespace asperity
