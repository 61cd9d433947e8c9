#include <algorithm>
#include <cmath>
#include <vector>

#include "asperity/profile/apply_wiener_filter.h"
#include "process_stages.h"

namespace asperity {

namespace {

double square(double x) { return x * x; }

// The SNR of a texture from which the noise was removed but for `error_ratio` of it: with the error e² that is left of
// a surface of power P, the expected texture's correlation with it is √(1 − e²/P).
double snr_after_removal(const TextureNoise& noise, double more, double error_ratio) {
  const double surface_m2 = square(noise.typical_texture_rms_m) - more * square(noise.typical_added_rms_m);
  const double left_m2 =
      more * (square(error_ratio * noise.typical_added_rms_m) + square(noise.typical_misplaced_rms_m));
  return left_m2 > 0.0 ? std::max(0.0, surface_m2 / left_m2 - 1.0) : 0.0;
}

}  // namespace

void remove_noise(double bridge_m, Profile& profile, TextureNoise& noise) {
  if (noise.added_psd_m2_mm.empty()) return;
  constexpr double kSure = 1.96;
  // What the normals' lean carries into the heights has an expected value of 0: it stays. The rest is known to a factor
  // of two: as much of the lean's part as there is of the rest is removed with it.
  const auto filter = [&](double more) {
    std::vector<double> removed = noise.added_psd_m2_mm, kept = noise.carried_psd_m2_mm;
    for (std::size_t i = 0; i < kept.size(); ++i) {
      kept[i] = std::max(0.0, 2.0 * kept[i] - removed[i]);
      removed[i] -= kept[i];
    }
    for (double& density : removed) density *= more;
    for (double& density : kept) density *= more;
    return apply_wiener_filter(profile.texture_m, profile.spacing_m, noise.frequency_cycles_per_mm, removed, bridge_m,
                               kept);
  };
  const WienerTexture expected = filter(1.0);
  if (!std::isfinite(expected.error_ratio)) return;
  const double scale_m2 = square(noise.scale_sigma * noise.texture_rms_m);
  const double most = 1.0 + kSure * 2.0 * noise.added_rms_stderr_m / noise.added_rms_m;
  noise.snr = snr_after_removal(noise, 1.0, expected.error_ratio);
  noise.snr_low = snr_after_removal(noise, most, filter(most).error_ratio);

  // The misplaced heights and their scale.
  const double kept_m2 = std::max(0.0, square(noise.noise_rms_m) - square(noise.added_rms_m));
  const double left = std::sqrt(kept_m2 + square(expected.error_ratio * noise.added_rms_m)) / noise.noise_rms_m;
  noise.noise_rms_m *= left;
  noise.noise_rms_stderr_m *= left;
  double expected_m2 = 0.0, points = 0.0;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    if (!std::isfinite(expected.texture_m[i])) continue;
    expected_m2 += square(expected.texture_m[i]);
    points += 1.0;
    profile.height_m[i] += expected.texture_m[i] - profile.texture_m[i];
    profile.texture_m[i] = expected.texture_m[i];
    profile.texture_sigma_m[i] = noise.added_sigma_m.empty()
                                     ? profile.texture_sigma_m[i] * left
                                     : std::sqrt(square(expected.error_ratio * noise.added_sigma_m[i]) +
                                                 square(noise.misplaced_sigma_m[i]) + scale_m2);
    // Waves about the cut-off are in the texture and below it, in phase: what is left of heights is no difference of
    // powers.
    if (!noise.slow_sigma_m.empty()) profile.sigma_m[i] = std::hypot(noise.slow_sigma_m[i], profile.texture_sigma_m[i]);
  }
  if (points > 0.0) {
    const double surface_m2 = std::max(0.0, expected_m2 - points * square(expected.kept_rms_m));
    const double all_m2 = surface_m2 + points * square(noise.noise_rms_m);
    const double in_place = std::isfinite(noise.stretch_correlation) ? noise.stretch_correlation : 1.0;
    noise.expected_correlation = all_m2 > 0.0 ? in_place * std::sqrt(surface_m2 / all_m2) : 0.0;
  }
}

Coverage measure_coverage(const Profile& profile) {
  Coverage out;
  const auto present = [&](std::size_t i) { return std::isfinite(profile.height_m[i]); };
  std::size_t first = 0;
  std::size_t last = profile.size();
  while (first < last && !present(first)) ++first;
  while (last > first && !present(last - 1)) --last;
  std::size_t covered = 0;
  for (std::size_t i = first; i < last; ++i) {
    covered += present(i) ? 1 : 0;
    out.gaps += !present(i) && present(i - 1) ? 1 : 0;
  }
  if (last == first) return out;
  // Where the heights reach an end of the path, up to it: a grid's points alone are too short by a spacing or more.
  const double reach_m = 2.0 * profile.spacing_m;
  const double first_m = profile.s_m[first], last_m = profile.s_m[last - 1];
  const double from_m = first_m - profile.from_m < reach_m + profile.crept_first_m ? profile.from_m : first_m;
  const double to_m = profile.to_m - last_m < reach_m + profile.crept_last_m ? profile.to_m : last_m;
  out.length_m = to_m - from_m;
  out.covered = static_cast<double>(covered) / static_cast<double>(last - first);
  return out;
}

}  // namespace asperity
