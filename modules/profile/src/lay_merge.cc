#include "asperity/profile/lay_merge.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "asperity/base/error.h"
#include "pass_signal.h"
#include "spectrum_at.h"

namespace asperity {

namespace {

constexpr double kBlend_m = 1e-3;
constexpr double kSureOfLaid = 1.96;

double mean_square(const std::vector<double>& x) {
  double sum = 0.0, count = 0.0;
  for (const double value : x) {
    if (!std::isfinite(value)) continue;
    sum += value * value;
    count += 1.0;
  }
  return count > 0.0 ? sum / count : 0.0;
}

double integral(const std::vector<double>& frequency, const std::vector<double>& density) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < frequency.size(); ++i)
    sum += 0.5 * (density[i] + density[i + 1]) * (frequency[i + 1] - frequency[i]);
  return sum;
}

double square(double x) { return x * x; }

// The density with `share` of it the merge's, and what follows from it. `texture_before_m2`: of the measured texture.
void mix_noise(const TextureNoise& merged, double share, double texture_before_m2, double texture_m2,
               TextureNoise& noise) {
  const double before_m2 = integral(noise.frequency_cycles_per_mm, noise.added_psd_m2_mm);
  for (std::size_t i = 0; i < noise.added_psd_m2_mm.size(); ++i) {
    const double of_merge =
        spectrum_at(merged.frequency_cycles_per_mm, merged.added_psd_m2_mm, noise.frequency_cycles_per_mm[i]);
    const double before = noise.added_psd_m2_mm[i];
    noise.added_psd_m2_mm[i] += share * (of_merge - before);
    if (!noise.carried_psd_m2_mm.empty() && before > 0.0)
      noise.carried_psd_m2_mm[i] *= noise.added_psd_m2_mm[i] / before;
  }
  const double after_m2 = integral(noise.frequency_cycles_per_mm, noise.added_psd_m2_mm);
  const double less = before_m2 > 0.0 ? after_m2 / before_m2 : 1.0, root = std::sqrt(less);
  const double changed_m2 = texture_m2 - texture_before_m2;
  const double noise_before_m = noise.noise_rms_m;
  noise.noise_rms_m = std::sqrt(std::max(0.0, square(noise.noise_rms_m) - (1.0 - less) * square(noise.added_rms_m)));
  noise.noise_rms_stderr_m *= noise.noise_rms_m / noise_before_m;
  noise.added_rms_m *= root;
  noise.added_rms_stderr_m *= root;
  noise.contact_rms_m = std::min(noise.contact_rms_m, noise.added_rms_m);
  noise.texture_rms_m = std::sqrt(std::max(0.0, square(noise.texture_rms_m) + changed_m2));
  noise.typical_texture_rms_m = std::sqrt(std::max(0.0, square(noise.typical_texture_rms_m) + changed_m2));
  noise.typical_added_rms_m *= root;

  const double relative = 2.0 * noise.added_rms_stderr_m / noise.added_rms_m, most = 1.0 + kSureOfLaid * relative;
  const double texture = square(noise.typical_texture_rms_m), added = square(noise.typical_added_rms_m);
  const double apart = added + square(noise.typical_misplaced_rms_m);
  noise.snr = std::max(0.0, texture - added) / apart;
  noise.snr_low = std::max(0.0, texture - most * added) / (most * apart);
  noise.measured_snr_low = std::max(0.0, texture - most * added) / (most * added);
  noise.at_most_m = std::sqrt(std::max(
      0.0, square(noise.texture_rms_m) - square(noise.added_rms_m) * std::max(0.0, 1.0 - kSureOfLaid * relative)));
}

}  // namespace

void lay_merge(const MergedProfile& merged, std::span<const PassInProfile> passes, Profile& profile,
               TextureNoise& noise) {
  const double texture_before_m2 = mean_square(profile.texture_m);
  const double blend = kBlend_m / profile.spacing_m, scale_m = noise.scale_sigma * noise.texture_rms_m;
  double laid = 0.0;
  for (const PassInProfile& part : passes) {
    const MergedPass& pass = merged.passes.at(part.pass);
    if (!pass.used) continue;
    if (part.first + pass.on_merge.size() > profile.size())
      throw Error("lay_merge: pass '" + pass.name + "' reaches beyond the profile");
    std::size_t begin = 0, end = pass.on_merge.size();
    while (begin < end && !std::isfinite(pass.on_merge[begin])) ++begin;
    while (end > begin && !std::isfinite(pass.on_merge[end - 1])) --end;
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t at = part.first + i;
      const double place = pass.on_merge[i];
      if (!std::isfinite(place) || !std::isfinite(profile.texture_m[at])) continue;
      const auto nearest = std::min(static_cast<std::size_t>(std::lround(place)), merged.profile.size() - 1);
      const double texture_m = height_at(merged.profile.texture_m, place);
      if (!std::isfinite(texture_m)) continue;
      const double from_end = static_cast<double>(std::min(i - begin, end - 1 - i)) / blend;
      const double share = from_end >= 1.0 ? 1.0 : 0.5 - 0.5 * std::cos(std::numbers::pi * from_end);
      const double change_m = share * (texture_m - profile.texture_m[at]);
      profile.texture_m[at] += change_m;
      profile.height_m[at] += change_m;
      laid += share;
      if (noise.added_sigma_m.empty() || merged.noise.added_sigma_m.empty()) continue;
      noise.added_sigma_m[at] += share * (merged.noise.added_sigma_m[nearest] - noise.added_sigma_m[at]);
      const double sigma_m = std::hypot(noise.added_sigma_m[at], noise.misplaced_sigma_m[at], scale_m);
      if (!profile.texture_sigma_m.empty()) profile.texture_sigma_m[at] = sigma_m;
      if (!noise.slow_sigma_m.empty()) profile.sigma_m[at] = std::hypot(noise.slow_sigma_m[at], sigma_m);
    }
  }
  double known = 0.0;
  for (const double texture_m : profile.texture_m) known += std::isfinite(texture_m) ? 1.0 : 0.0;
  if (!(laid > 0.0) || noise.added_psd_m2_mm.empty() || merged.noise.added_psd_m2_mm.empty()) return;
  mix_noise(merged.noise, laid / known, texture_before_m2, mean_square(profile.texture_m), noise);
}

}  // namespace asperity
