#include "asperity/profile/apply_wiener_filter.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>

#include "asperity/base/error.h"
#include "asperity/signal/spectrum.h"
#include "gap_runs.h"

namespace asperity {

namespace {

constexpr std::size_t kLeastReach_bins = 4;
constexpr std::size_t kReach_share = 16;  // of the frequency: surfaces have lines among long waves
constexpr std::size_t kShortest_points = 16;

// Means over ± 4 bins, or a sixteenth of the frequency if that is more; fewer at the ends.
std::vector<double> smooth(const std::vector<double>& x) {
  std::vector<double> sums(x.size() + 1, 0.0);
  for (std::size_t i = 0; i < x.size(); ++i) sums[i + 1] = sums[i] + x[i];
  std::vector<double> out(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const std::size_t reach = std::max(kLeastReach_bins, i / kReach_share);
    const std::size_t first = i < reach ? 0 : i - reach;
    const std::size_t last = std::min(i + reach + 1, x.size());
    out[i] = (sums[last] - sums[first]) / static_cast<double>(last - first);
  }
  return out;
}

class NoiseDensity {
 public:
  NoiseDensity(std::span<const double> frequency, std::span<const double> psd) : frequency_(frequency), psd_(psd) {}

  // At frequencies that do not fall from call to call.
  double at(double frequency) {
    if (psd_.empty()) return 0.0;
    while (next_ + 1 < frequency_.size() && frequency_[next_] < frequency) ++next_;
    if (next_ == 0 || frequency >= frequency_[next_]) return psd_[next_];
    const double share = (frequency - frequency_[next_ - 1]) / (frequency_[next_] - frequency_[next_ - 1]);
    return psd_[next_ - 1] + share * (psd_[next_] - psd_[next_ - 1]);
  }

 private:
  std::span<const double> frequency_, psd_;
  std::size_t next_ = 0;
};

// Powers summed over the frequencies of all runs.
struct Powers {
  double surface = 0.0, covariance = 0.0, noise = 0.0, error = 0.0, kept = 0.0, out = 0.0;
};

std::vector<double> filter_run(std::span<const double> run, double spacing_mm, NoiseDensity noise, NoiseDensity kept,
                               Powers& powers) {
  const std::size_t n = run.size();
  std::vector<double> mirrored(run.begin(), run.end());
  mirrored.insert(mirrored.end(), run.rbegin(), run.rend());
  std::vector<std::complex<double>> spectrum = real_dft(mirrored);
  const double to_density = 2.0 * spacing_mm / static_cast<double>(mirrored.size());
  std::vector<double> density(spectrum.size());
  for (std::size_t i = 0; i < spectrum.size(); ++i) density[i] = to_density * std::norm(spectrum[i]);
  density = smooth(density);
  const double step_cycles_per_mm = 1.0 / (spacing_mm * static_cast<double>(mirrored.size()));
  const double weight = step_cycles_per_mm * static_cast<double>(n);
  for (std::size_t i = 0; i < spectrum.size(); ++i) {
    const double frequency = step_cycles_per_mm * static_cast<double>(i);
    const double noise_here = noise.at(frequency), kept_said = kept.at(frequency);
    // What was measured is surface and both errors: the second is no larger than what the first leaves.
    const double above = std::max(0.0, density[i] - noise_here), kept_here = std::min(kept_said, above);
    const double surface = above - kept_here;
    const double gain = density[i] > 0.0 ? above / density[i] : 0.0, lost = 1.0 - gain;
    spectrum[i] *= gain;
    powers.surface += weight * surface;
    powers.covariance += weight * gain * surface;
    powers.noise += weight * (noise_here + kept_said);
    powers.error += weight * (lost * lost * surface + gain * gain * (noise_here + kept_here));
    powers.kept += weight * gain * gain * kept_here;
    powers.out += weight * gain * gain * density[i];
  }
  std::vector<double> out = inverse_real_dft(spectrum, mirrored.size());
  out.resize(n);
  return out;
}

}  // namespace

WienerTexture apply_wiener_filter(std::span<const double> texture_m, double spacing_m,
                                  std::span<const double> frequency_cycles_per_mm,
                                  std::span<const double> noise_psd_m2_mm, double bridge_m,
                                  std::span<const double> kept_psd_m2_mm) {
  if (frequency_cycles_per_mm.empty() || frequency_cycles_per_mm.size() != noise_psd_m2_mm.size() ||
      (!kept_psd_m2_mm.empty() && kept_psd_m2_mm.size() != noise_psd_m2_mm.size()) || !(spacing_m > 0.0)) {
    throw Error("Wiener's filter: " + std::to_string(frequency_cycles_per_mm.size()) + " frequencies, " +
                std::to_string(noise_psd_m2_mm.size()) + " densities, a spacing that must be positive");
  }
  WienerTexture out;
  std::vector<Powers> runs;
  const auto bridge = static_cast<std::size_t>(std::lround(bridge_m / spacing_m));
  out.texture_m = filter_runs(texture_m, bridge, {}, kShortest_points, [&](std::span<const double> run) {
    return filter_run(run, 1e3 * spacing_m, NoiseDensity(frequency_cycles_per_mm, noise_psd_m2_mm),
                      NoiseDensity(frequency_cycles_per_mm, kept_psd_m2_mm), runs.emplace_back());
  });

  Powers all;
  for (const Powers& run : runs) {
    all.surface += run.surface;
    all.covariance += run.covariance;
    all.noise += run.noise;
    all.error += run.error;
    all.kept += run.kept;
    all.out += run.out;
  }
  double points = 0.0;
  for (const double h : out.texture_m) points += std::isfinite(h) ? 1.0 : 0.0;
  out.error_ratio = all.noise > 0.0 ? std::sqrt(all.error / all.noise) : 0.0;
  out.error_rms_m = points > 0.0 ? std::sqrt(all.error / points) : 0.0;
  out.kept_rms_m = points > 0.0 ? std::sqrt(all.kept / points) : 0.0;
  const double powers = all.surface * all.out;
  out.expected_correlation = powers > 0.0 ? all.covariance / std::sqrt(powers) : 0.0;
  return out;
}

}  // namespace asperity
