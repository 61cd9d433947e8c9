#include "asperity/profile/erode_profile.h"

#include <algorithm>
#include <cmath>

#include "asperity/base/random.h"
#include "asperity/signal/tip_morphology.h"
#include "draw_noise.h"

namespace asperity {

namespace {

constexpr int kErosionDraws = 8;
constexpr std::uint64_t kErosionSeed = 20;
constexpr double kResolution_spacings = 2.0;

struct MeanAndRms {
  double mean = 0.0, rms = 0.0;
};

MeanAndRms mean_and_rms(std::span<const double> x) {
  MeanAndRms out;
  double count = 0.0;
  for (const double value : x) {
    if (!std::isfinite(value)) continue;
    out.mean += value;
    out.rms += value * value;
    count += 1.0;
  }
  if (count > 0.0) out = {out.mean / count, std::sqrt(out.rms / count)};
  return out;
}

double psd_power(const TextureNoise& noise) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < noise.frequency_cycles_per_mm.size(); ++i) {
    sum += 0.5 * (noise.added_psd_m2_mm[i] + noise.added_psd_m2_mm[i + 1]) *
           (noise.frequency_cycles_per_mm[i + 1] - noise.frequency_cycles_per_mm[i]);
  }
  return sum;
}

}  // namespace

ErodedProfile erode_profile(const Profile& profile, const TextureNoise& noise, double radius_m) {
  ErodedProfile out;
  out.radius_m = radius_m;
  const std::size_t points = profile.size();
  const double resolution_m = kResolution_spacings * profile.spacing_m;
  if (!(radius_m > resolution_m)) {
    out.reason = "the tip's radius is not known, or below the resolution of the heights";
    return out;
  }
  TipErosion eroded = erode_profile_by_tip(profile.height_m, profile.spacing_m, radius_m, resolution_m);
  out.surface_m = std::move(eroded.surface_m);
  out.touched = std::move(eroded.touched);

  const double power_m2 = noise.added_psd_m2_mm.empty() ? 0.0 : psd_power(noise);
  if (power_m2 > 0.0 && noise.noise_rms_m > 0.0) {
    std::vector<double> density = noise.added_psd_m2_mm;
    for (double& value : density) value *= noise.noise_rms_m * noise.noise_rms_m / power_m2;
    std::vector<double> changes_m;
    for (int draw = 0; draw < kErosionDraws; ++draw) {
      Random random(kErosionSeed, static_cast<std::uint64_t>(draw));
      std::vector<double> noisy_m =
          draw_noise(noise.frequency_cycles_per_mm, density, points, 1e3 * profile.spacing_m, random);
      for (std::size_t i = 0; i < points; ++i) noisy_m[i] += profile.height_m[i];
      const TipErosion again = erode_profile_by_tip(noisy_m, profile.spacing_m, radius_m, resolution_m);
      for (std::size_t i = 0; i < points; ++i) changes_m.push_back(again.surface_m[i] - out.surface_m[i]);
    }
    const MeanAndRms change = mean_and_rms(changes_m);
    out.noise_rms_m = change.rms;
    out.bias_m = change.mean;
    for (double& height_m : out.surface_m) height_m -= change.mean;
  }

  std::vector<double> correction_m(points);
  double known = 0.0, touched = 0.0;
  for (std::size_t i = 0; i < points; ++i) {
    correction_m[i] = profile.height_m[i] - out.surface_m[i];
    known += std::isfinite(correction_m[i]) ? 1.0 : 0.0;
    touched += out.touched[i] != 0 ? 1.0 : 0.0;
  }
  if (!(known > 0.0)) {
    out.reason = "the profile has no heights";
    return out;
  }
  out.touched_share = touched / known;
  const MeanAndRms correction = mean_and_rms(correction_m);
  out.correction_rms_m = std::sqrt(std::max(0.0, correction.rms * correction.rms - correction.mean * correction.mean));
  if (!std::isfinite(noise.noise_rms_m)) {
    out.reason = "the noise of the heights is not known";
    return out;
  }
  // The heights' own noise is in the correction too.
  const double done_m = std::isfinite(out.noise_rms_m) ? out.noise_rms_m : 0.0;
  const double all_m = std::hypot(done_m, noise.noise_rms_m);
  out.determined = all_m == 0.0 || all_m < out.correction_rms_m;
  if (!out.determined) out.reason = "what noise does to the erosion is as large as the correction";
  return out;
}

}  // namespace asperity
