#include "noise_of_merge.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "asperity/profile/measure_spectrum.h"
#include "spectrum_at.h"

namespace asperity {

namespace {

constexpr double kSureOfMerge = 1.96;

double density_integral(const std::vector<double>& frequency, const std::vector<double>& density) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < frequency.size(); ++i)
    sum += 0.5 * (density[i] + density[i + 1]) * (frequency[i + 1] - frequency[i]);
  return sum;
}

}  // namespace

TextureNoise noise_of_merge(const AveragedPasses& mean, std::span<const PassOnGrid> passes, double spacing_mm,
                            double default_place_sigma_m) {
  TextureNoise out;
  double texture_m2 = 0.0, points = 0.0;
  for (const double h : mean.texture_m) {
    if (!std::isfinite(h)) continue;
    texture_m2 += h * h;
    points += 1.0;
  }
  texture_m2 /= std::max(1.0, points);
  out.texture_rms_m = std::sqrt(texture_m2);
  double relative = 0.0, place_m2 = 0.0, along = 0.0, count = 0.0;
  bool all_known = true;
  for (const PassOnGrid& one : passes) {
    const ProfilePass& pass = *one.pass;
    all_known &= !one.noise_psd_m2_mm.empty();
    relative = std::max(relative, pass.noise_relative);
    out.scale_sigma = std::max(out.scale_sigma, pass.scale_sigma);
    out.contact_rms_m = std::max(out.contact_rms_m, pass.contact_rms_m);
    const double place_m = std::isfinite(pass.place_sigma_m) ? pass.place_sigma_m : default_place_sigma_m;
    place_m2 += place_m * place_m;
    if (std::isfinite(pass.along_sigma)) along = std::max(along, pass.along_sigma);
    count += 1.0;
  }
  const double added_m2 = density_integral(mean.frequency_cycles_per_mm, mean.noise_psd_m2_mm);
  if (!all_known || !(added_m2 > 0.0) || !(texture_m2 > 0.0)) return out;

  out.frequency_cycles_per_mm = mean.frequency_cycles_per_mm;
  out.added_psd_m2_mm = mean.noise_psd_m2_mm;
  out.place_sigma_m = std::sqrt(place_m2) / count;
  const PowerSpectrum measured = measure_spectrum(mean.texture_m, 1e-3 * spacing_mm);
  for (std::size_t i = 0; i < out.frequency_cycles_per_mm.size(); ++i) {
    const double f = out.frequency_cycles_per_mm[i];
    const double surface = std::max(0.0, spectrum_at(measured.frequency, measured.density, f) - out.added_psd_m2_mm[i]);
    const double phase = 2.0 * std::numbers::pi * f * 1e3 * out.place_sigma_m;
    out.misplaced_psd_m2_mm.push_back(2.0 * (1.0 - std::exp(-0.5 * phase * phase)) * surface);
  }
  const double misplaced_m2 = density_integral(out.frequency_cycles_per_mm, out.misplaced_psd_m2_mm);
  out.added_sigma_m = mean.sigma_m;
  for (double& sigma_m : out.added_sigma_m) sigma_m = std::isfinite(sigma_m) ? sigma_m : 0.0;
  out.misplaced_sigma_m.assign(mean.sigma_m.size(), std::sqrt(misplaced_m2));

  const double noise_m2 = added_m2 + misplaced_m2 + texture_m2 * out.scale_sigma * out.scale_sigma;
  const double most = 1.0 + kSureOfMerge * relative;
  out.noise_rms_m = std::sqrt(noise_m2);
  out.noise_rms_stderr_m = 0.5 * relative * out.noise_rms_m;
  out.added_rms_m = std::sqrt(added_m2);
  out.added_rms_stderr_m = 0.5 * relative * out.added_rms_m;
  out.contact_rms_m = std::min(out.contact_rms_m, out.added_rms_m);
  out.along_sigma = along;
  out.length_stderr_m = along * 1e-3 * spacing_mm * points;
  out.typical_texture_rms_m = out.texture_rms_m;
  out.typical_added_rms_m = out.added_rms_m;
  out.typical_misplaced_rms_m = std::sqrt(misplaced_m2);
  const double apart_m2 = added_m2 + misplaced_m2;
  out.snr = std::max(0.0, texture_m2 - added_m2) / apart_m2;
  out.snr_low = std::max(0.0, texture_m2 - most * added_m2) / (most * apart_m2);
  out.measured_snr_low = std::max(0.0, texture_m2 - most * added_m2) / (most * added_m2);
  out.at_most_m = std::sqrt(std::max(0.0, texture_m2 - added_m2 * std::max(0.0, 1.0 - kSureOfMerge * relative)));
  return out;
}

}  // namespace asperity
