#include "asperity/profile/merge_gain.h"

#include <algorithm>
#include <cmath>

#include "spectrum_at.h"

namespace asperity {

namespace {

// Integral of a density over a band, by straight lines between its points.
double band_integral(const std::vector<double>& frequency, const std::vector<double>& density, double low,
                     double high) {
  const auto value = [&](double f) { return spectrum_at(frequency, density, f); };
  double sum = 0.0, at = low;
  for (const double f : frequency) {
    if (f <= low) continue;
    const double next = std::min(f, high);
    sum += 0.5 * (value(at) + value(next)) * (next - at);
    at = next;
    if (f >= high) break;
  }
  return sum + value(high) * (high - at);
}

}  // namespace

MergeGain merge_gain(const MergedProfile& merged, const AlignPassesConfig& config) {
  MergeGain out;
  const TextureNoise& noise = merged.noise;
  if (!merged.agrees || noise.frequency_cycles_per_mm.empty()) return out;
  double strokes_m2 = 0.0, count = 0.0;
  for (const MergedPass& pass : merged.passes) {
    if (!pass.used) continue;
    // fmax leaves out what is not known.
    const double rms_m = std::fmax(pass.stated_noise_rms_m, pass.noise_rms_m);
    strokes_m2 += rms_m * rms_m;
    count += 1.0;
  }
  const double low = config.low_cycles_per_mm, high = config.high_cycles_per_mm;
  double merged_m2 = band_integral(noise.frequency_cycles_per_mm, noise.added_psd_m2_mm, low, high);
  if (!noise.misplaced_psd_m2_mm.empty())
    merged_m2 += band_integral(noise.frequency_cycles_per_mm, noise.misplaced_psd_m2_mm, low, high);
  merged_m2 += std::pow(noise.scale_sigma * noise.texture_rms_m, 2);
  if (!(strokes_m2 > 0.0) || !std::isfinite(strokes_m2) || !std::isfinite(merged_m2)) return out;
  out.stroke_noise_rms_m = std::sqrt(strokes_m2 / count);
  out.merged_noise_rms_m = std::sqrt(merged_m2);
  out.share = out.merged_noise_rms_m / out.stroke_noise_rms_m;
  return out;
}

}  // namespace asperity
