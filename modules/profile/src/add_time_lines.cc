#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "asperity/base/nan.h"
#include "asperity/profile/find_time_lines.h"

namespace asperity {

namespace {

constexpr double kSure = 1.96;

double power_of(double rms_m) { return rms_m * rms_m; }

// Adds a power at one frequency to a density whose integral by trapezoids it is.
void add_power(double at, double power_m2, const std::vector<double>& k, std::vector<double>& density) {
  const auto above = std::upper_bound(k.begin(), k.end(), at);
  if (above == k.begin() || above == k.end()) return;
  const auto i = static_cast<std::size_t>(above - k.begin());
  const double share = (at - k[i - 1]) / (k[i] - k[i - 1]);
  const auto width = [&](std::size_t j) { return 0.5 * (k[std::min(j + 1, k.size() - 1)] - k[j > 0 ? j - 1 : 0]); };
  density[i - 1] += (1.0 - share) * power_m2 / width(i - 1);
  density[i] += share * power_m2 / width(i);
}

}  // namespace

void add_time_lines(Profile& profile, TextureNoise& noise) {
  if (noise.added_psd_m2_mm.empty()) return;
  std::vector<double> speeds_mmps;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const double v = profile.speed_mps[i];
    if (v > 0.0 && std::isfinite(profile.texture_m[i])) speeds_mmps.push_back(1e3 * v);
  }
  if (speeds_mmps.empty()) return;
  double more_m2 = 0.0;
  for (const TimeLine& line : noise.time_lines) {
    if (line.could_be_surface) continue;
    const double power_m2 = power_of(line.rms_m);
    more_m2 += power_m2;
    for (const double v : speeds_mmps) {
      add_power(line.frequency_Hz / v, power_m2 / static_cast<double>(speeds_mmps.size()),
                noise.frequency_cycles_per_mm, noise.added_psd_m2_mm);
    }
  }
  if (!(more_m2 > 0.0)) return;
  // Both together are no more than what was measured: the first may have counted the lines already.
  const double all_m2 = power_of(noise.added_rms_m) + more_m2;
  const double share = std::min(1.0, power_of(noise.texture_rms_m) / all_m2);
  for (double& density : noise.added_psd_m2_mm) density *= share;
  for (std::vector<double>* sigma_m : {&noise.added_sigma_m, &profile.texture_sigma_m, &profile.sigma_m}) {
    for (double& sigma : *sigma_m) sigma = std::sqrt(power_of(sigma) + share * more_m2);
  }
  // Its users take the power's relative error as one factor of the whole density, so it stays as it is: smaller, the
  // rest of the noise would look better known than before.
  const double relative = 2.0 * noise.added_rms_stderr_m / noise.added_rms_m;
  const auto with = [&](double rms_m) { return std::sqrt(power_of(rms_m) + share * more_m2); };
  noise.added_rms_m = std::sqrt(share * all_m2);
  noise.added_rms_stderr_m = 0.5 * relative * noise.added_rms_m;
  noise.noise_rms_m = with(noise.noise_rms_m);
  noise.noise_rms_stderr_m = 0.5 * relative * noise.noise_rms_m;
  const double measured_m2 = power_of(noise.typical_texture_rms_m);
  const double typical_m2 = power_of(noise.typical_added_rms_m) + more_m2;
  const bool all_noise = typical_m2 >= measured_m2;
  noise.typical_added_rms_m = std::sqrt(std::min(typical_m2, measured_m2));
  const double added_m2 = power_of(noise.typical_added_rms_m);
  const double most = 1.0 + kSure * relative, both_m2 = added_m2 + power_of(noise.typical_misplaced_rms_m);
  noise.snr = all_noise ? 0.0 : (measured_m2 - added_m2) / both_m2;
  noise.snr_low = std::max(0.0, measured_m2 - most * added_m2) / (most * both_m2);
  noise.measured_snr_low = std::max(0.0, measured_m2 - most * added_m2) / (most * added_m2);
  const double least_m2 = power_of(noise.added_rms_m) * std::max(0.0, 1.0 - kSure * relative);
  noise.at_most_m = std::sqrt(std::max(0.0, power_of(noise.texture_rms_m) - least_m2));
}

}  // namespace asperity
