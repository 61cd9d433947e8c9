#include "asperity/profile/estimate_texture_noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "asperity/base/nan.h"
#include "asperity/profile/correlation_under_stretch.h"
#include "asperity/profile/height_error_density.h"
#include "asperity/profile/measure_spectrum.h"
#include "draw_height_errors.h"
#include "noise_blocks.h"

namespace asperity {

namespace {

constexpr std::size_t kFrequencies = 128;  // of the spectrum, evenly in the logarithm
constexpr double kBelowCutoff = 0.2;       // lowest frequency over the high-pass' cut-off: what is below is cut to 1e-5
constexpr double kLowest_cycles_per_mm = 1e-3;
constexpr double kFisher = 0.833;              // 3π/(8√2), the integral of (1 + x⁴)⁻²
constexpr double kPositionBandwidth = 1.1107;  // π/(2√2), the integral of (1 + x⁴)⁻¹
constexpr double kLeastInformation = 4.0;      // the floor is known to half its value even without a tracker
constexpr double kSure = 1.96;

std::vector<double> frequencies(double lowest, double highest) {
  std::vector<double> out(kFrequencies);
  const double step = std::log(highest / lowest) / static_cast<double>(kFrequencies - 1);
  for (std::size_t i = 0; i < kFrequencies; ++i) out[i] = lowest * std::exp(step * static_cast<double>(i));
  return out;
}

template <class Value>
double integrate(const std::vector<double>& at, const Value& value) {
  double sum = 0.0;
  for (std::size_t i = 1; i < at.size(); ++i) sum += 0.5 * (value(i) + value(i - 1)) * (at[i] - at[i - 1]);
  return sum;
}

// The frequency at which the noises of an acceleration (m²/s³) and of a tracker (m² s) meet.
double meeting_Hz(double accel_psd, double tracker_psd) {
  return std::pow(accel_psd / tracker_psd, 0.25) / (2.0 * std::numbers::pi);
}

// The density of a measured texture at a frequency, by straight lines.
double density_at(const PowerSpectrum& spectrum, double frequency) {
  if (spectrum.frequency.size() < 2) return 0.0;
  const double place = frequency / spectrum.frequency[1];
  const auto i = static_cast<std::size_t>(place);
  if (i + 1 >= spectrum.density.size()) return spectrum.density.back();
  const double share = place - static_cast<double>(i);
  return (1.0 - share) * spectrum.density[i] + share * spectrum.density[i + 1];
}

// The variance of one point's place along the path, m².
double place_variance_m2(const HeightErrors& errors) {
  if (!(errors.along_accel_psd_m2ps3 > 0.0) || !(errors.along_tracker_psd_m2ps > 0.0)) return 0.0;
  return errors.along_tracker_psd_m2ps * kPositionBandwidth *
         meeting_Hz(errors.along_accel_psd_m2ps3, errors.along_tracker_psd_m2ps);
}

// How much the power of a texture changes by being misplaced, relative: RMS over the draws.
double power_spread(const std::vector<double>& surface_m, const std::vector<std::vector<double>>& misplaced_m) {
  double power = 0.0, square = 0.0;
  for (const double h : surface_m) power += h * h;
  for (const std::vector<double>& draw : misplaced_m) {
    double change = 0.0;
    for (std::size_t i = 0; i < surface_m.size(); ++i) change += draw[i] * (2.0 * surface_m[i] + draw[i]);
    square += change * change / static_cast<double>(misplaced_m.size());
  }
  return power > 0.0 ? std::sqrt(square) / power : 0.0;
}

}  // namespace

double texture_power_gain(double cycles_per_mm, double cutoff_cycles_per_mm) {
  if (!(cutoff_cycles_per_mm > 0.0)) return 1.0;
  // The whole forward-backward filter of order 2 (zero_phase.h): −3 dB at the cut-off.
  const double ratio = cutoff_cycles_per_mm / cycles_per_mm;
  const double gain = 1.0 / (1.0 + (std::numbers::sqrt2 - 1.0) * ratio * ratio * ratio * ratio);
  return gain * gain;
}

TextureNoiseEstimate estimate_texture_noise(const Profile& profile, const HeightErrors& errors,
                                            double cutoff_cycles_per_mm, const TextureNoiseConfig& config) {
  TextureNoiseEstimate out;
  TextureNoise& noise = out.noise;
  out.texture_sigma_m.assign(profile.size(), kNan);
  noise.texture_rms_m = std::sqrt(mean_square(profile.texture_m));
  const std::vector<Block> blocks = find_blocks(profile);
  if (blocks.empty() || !(errors.accel_psd_m2ps3 > 0.0) || !(errors.tracker_psd_m2ps > 0.0)) return out;

  const double spacing_mm = 1e3 * profile.spacing_m;
  double points = 0.0, duration_s = 0.0;
  for (const Block& b : blocks) {
    points += b.points;
    duration_s += b.points * spacing_mm / b.speed_mmps;
  }
  const double length_mm = points * spacing_mm;

  // The spectrum's shape, as if each stretch were long, in mm.
  const double lowest = std::max(kLowest_cycles_per_mm, kBelowCutoff * cutoff_cycles_per_mm);
  const std::vector<double> k = frequencies(lowest, 0.5 / spacing_mm);
  const auto even_density = [&](const HeightErrors& of) {
    std::vector<double> density(k.size(), 0.0);
    for (std::size_t i = 0; i < k.size(); ++i) {
      const double gain = texture_power_gain(k[i], cutoff_cycles_per_mm);
      for (const Block& b : blocks) {
        density[i] +=
            b.points / points * gain * b.speed_mmps * 1e6 * height_error_density_m2ps(of, k[i] * b.speed_mmps);
      }
    }
    return density;
  };
  std::vector<double> added = even_density(errors);
  const double even_power = integrate(k, [&](std::size_t i) { return added[i]; });
  // The same with the sensor's own noise alone.
  HeightErrors own_errors = errors;
  own_errors.accel_psd_m2ps3 = errors.accel_own_psd_m2ps3;
  // What rests have shown of 1/f noise is the sensor's.
  const bool slow_is_known = errors.accel_corner_sigma_Hz > 0.0;
  if (slow_is_known && errors.accel_own_psd_m2ps3 > 0.0)
    own_errors.accel_corner_Hz *= errors.accel_psd_m2ps3 / errors.accel_own_psd_m2ps3;
  const std::vector<double> own = even_density(own_errors);
  const double own_power = integrate(k, [&](std::size_t i) { return own[i]; });
  HeightErrors upright = errors;
  upright.leaning_m2ps.clear();
  const std::vector<double> without_lean = even_density(upright);

  // The powers, from draws: they know of rests, slow ends and gaps.
  std::vector<double> surface_m(profile.size());
  const double measured_power = 1e6 * noise.texture_rms_m * noise.texture_rms_m;
  const double clean = std::sqrt(std::clamp(1.0 - even_power / measured_power, 0.0, 1.0));
  for (std::size_t i = 0; i < surface_m.size(); ++i) {
    surface_m[i] = std::isfinite(profile.texture_m[i]) ? clean * profile.texture_m[i] : 0.0;
  }
  const DrawnErrors drawn = draw_height_errors(profile, errors, cutoff_cycles_per_mm, config, surface_m);
  if (drawn.added_m.empty()) return out;
  BlockErrors added_errors = over_blocks(profile, blocks, drawn.added_m);
  const BlockErrors misplaced_errors = over_blocks(profile, blocks, drawn.misplaced_m);
  const BlockErrors height_errors = over_blocks(profile, blocks, drawn.height_m);
  const BlockErrors slow_errors = over_blocks(profile, blocks, difference(drawn.height_m, drawn.added_m));
  if (!(added_errors.power_m2 > 0.0) || !(even_power > 0.0)) return out;
  const std::vector<char> typical = without_noisiest(blocks, added_errors.block_m2);
  // What was measured is surface and noise: the noise is no larger.
  const double measured_m2 = mean_over(blocks, typical, squares_of(profile.texture_m, blocks));
  const double most_share = std::min(1.0, measured_m2 / mean_over(blocks, typical, added_errors.block_m2));
  added_errors.power_m2 *= most_share;
  for (double& block_m2 : added_errors.block_m2) block_m2 *= most_share;
  const double added_power = 1e6 * added_errors.power_m2;
  const double typical_added = 1e6 * mean_over(blocks, typical, added_errors.block_m2);
  const double typical_misplaced = 1e6 * mean_over(blocks, typical, misplaced_errors.block_m2);
  const double typical_measured = 1e6 * measured_m2;
  std::vector<double> carried(k.size());
  for (std::size_t i = 0; i < k.size(); ++i) {
    carried[i] = std::max(0.0, added[i] - without_lean[i]) * typical_added / even_power;
    added[i] *= typical_added / even_power;
  }

  const PowerSpectrum measured = measure_spectrum(profile.texture_m, profile.spacing_m);
  const double shape_mm2 = 1e6 * drawn.shape_variance_m2;
  std::vector<double> misplaced(k.size()), expected(k.size());
  for (std::size_t i = 0; i < k.size(); ++i) {
    const double all = 1e6 * density_at(measured, k[i]), surface = std::max(0.0, all - added[i]);
    expected[i] = all > 0.0 ? surface * surface / all : 0.0;  // without noise (apply_wiener_filter.h)
    const double phase_variance = std::pow(2.0 * std::numbers::pi * k[i], 2) * shape_mm2;
    misplaced[i] = 2.0 * (1.0 - std::exp(-0.5 * phase_variance)) * surface;
  }
  const double even_misplaced = integrate(k, [&](std::size_t i) { return misplaced[i]; });
  for (double& density : misplaced) density *= even_misplaced > 0.0 ? typical_misplaced / even_misplaced : 0.0;

  out.height_sigma_m.assign(profile.size(), kNan);
  noise.added_sigma_m.assign(profile.size(), 0.0);
  noise.misplaced_sigma_m.assign(profile.size(), 0.0);
  noise.slow_sigma_m.assign(profile.size(), 0.0);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const double added_m2 = added_errors.block_m2[b], misplaced_m2 = misplaced_errors.block_m2[b];
    const double gain_m2 = std::pow(errors.scale_sigma * noise.texture_rms_m, 2);
    for (std::size_t i = blocks[b].first; i < blocks[b].last; ++i) {
      if (std::isfinite(profile.height_m[i])) {
        out.height_sigma_m[i] = std::sqrt(height_errors.block_m2[b] + misplaced_m2 + gain_m2);
      }
      noise.slow_sigma_m[i] = std::sqrt(slow_errors.block_m2[b]);
      if (!std::isfinite(profile.texture_m[i])) continue;
      out.texture_sigma_m[i] = std::sqrt(added_m2 + misplaced_m2 + gain_m2);
      noise.added_sigma_m[i] = std::sqrt(added_m2);
      noise.misplaced_sigma_m[i] = std::sqrt(misplaced_m2);
    }
  }

  noise.frequency_cycles_per_mm = k;
  noise.added_psd_m2_mm.resize(k.size());
  noise.misplaced_psd_m2_mm.resize(k.size());
  if (!errors.leaning_m2ps.empty()) noise.carried_psd_m2_mm.resize(k.size());
  for (std::size_t i = 0; i < noise.carried_psd_m2_mm.size(); ++i) noise.carried_psd_m2_mm[i] = 1e-6 * carried[i];
  for (std::size_t i = 0; i < k.size(); ++i) {
    noise.added_psd_m2_mm[i] = 1e-6 * added[i];
    noise.misplaced_psd_m2_mm[i] = 1e-6 * misplaced[i];
  }
  const double information = kFisher * duration_s * meeting_Hz(errors.accel_psd_m2ps3, errors.tracker_psd_m2ps);
  double level = 1.0 / std::sqrt(std::max(information, kLeastInformation));
  if (slow_is_known) {  // it may still be what is known worst
    HeightErrors more_slow = errors;
    more_slow.accel_corner_Hz += errors.accel_corner_sigma_Hz;
    const std::vector<double> more = even_density(more_slow);
    level = std::max(level, integrate(k, [&](std::size_t i) { return more[i]; }) / even_power - 1.0);
  }
  const double relative = std::hypot(added_errors.spread, level);
  const double noise_power = added_power + even_misplaced + measured_power * errors.scale_sigma * errors.scale_sigma;
  noise.place_sigma_m = std::sqrt(drawn.shape_variance_m2);
  const double ends_m2 =
      errors.length_ends_m > 0.0 ? errors.length_ends_m * errors.length_ends_m : 2.0 * place_variance_m2(errors);
  noise.length_stderr_m = std::sqrt(ends_m2 + std::pow(1e-3 * errors.along_scale_sigma * length_mm, 2));
  noise.end_place_sigma_m = 0.5e-3 * errors.stretch_sigma * length_mm;
  noise.stretch_correlation = correlation_under_stretch(k, expected, errors.stretch_sigma, length_mm);
  noise.scale_sigma = errors.scale_sigma;
  noise.along_sigma = noise.length_stderr_m / (1e-3 * length_mm);
  noise.added_rms_m = 1e-3 * std::sqrt(added_power);
  if (errors.accel_own_psd_m2ps3 > 0.0) {
    noise.contact_rms_m = noise.added_rms_m * std::sqrt(std::max(0.0, 1.0 - own_power / even_power));
  }
  noise.stretch_sigma = power_spread(surface_m, drawn.misplaced_m);
  noise.added_rms_stderr_m = 0.5 * relative * noise.added_rms_m;
  noise.noise_rms_m = 1e-3 * std::sqrt(noise_power);
  noise.noise_rms_stderr_m = 0.5 * relative * noise.noise_rms_m;
  noise.typical_texture_rms_m = 1e-3 * std::sqrt(typical_measured);
  noise.typical_added_rms_m = 1e-3 * std::sqrt(typical_added);
  noise.typical_misplaced_rms_m = 1e-3 * std::sqrt(typical_misplaced);
  const double typical_noise = typical_added + typical_misplaced;
  // Where the noise was made as small as what was measured, their difference is rounding.
  noise.snr = most_share < 1.0 ? 0.0 : std::max(0.0, typical_measured - typical_added) / typical_noise;
  const double most = 1.0 + kSure * relative;
  noise.snr_low = std::max(0.0, typical_measured - most * typical_added) / (most * typical_noise);
  // Misplaced heights are as high as before: of how rough it is they tell as much.
  noise.measured_snr_low = std::max(0.0, typical_measured - most * typical_added) / (most * typical_added);
  noise.at_most_m =
      1e-3 * std::sqrt(std::max(0.0, measured_power - added_power * std::max(0.0, 1.0 - kSure * relative)));
  return out;
}

TextureNoise noise_of_sigma(std::span<const double> texture_m, std::span<const double> texture_sigma_m,
                            double spacing_m, double cutoff_cycles_per_mm) {
  constexpr double kRelative = 0.25;  // of the power
  TextureNoise noise;
  const double power_m2 = mean_square(texture_sigma_m);
  if (!(power_m2 > 0.0) || !(cutoff_cycles_per_mm > 0.0)) return noise;
  noise.frequency_cycles_per_mm = frequencies(kBelowCutoff * cutoff_cycles_per_mm, 0.5e-3 / spacing_m);
  const std::vector<double>& k = noise.frequency_cycles_per_mm;
  for (const double at : k) {
    noise.added_psd_m2_mm.push_back(texture_power_gain(at, cutoff_cycles_per_mm) / (at * at * at * at));
  }
  const double sum = integrate(k, [&](std::size_t i) { return noise.added_psd_m2_mm[i]; });
  for (double& density : noise.added_psd_m2_mm) density *= power_m2 / sum;
  noise.misplaced_psd_m2_mm.assign(k.size(), 0.0);
  noise.added_rms_m = noise.noise_rms_m = std::sqrt(power_m2);
  noise.added_rms_stderr_m = noise.noise_rms_stderr_m = 0.5 * kRelative * noise.added_rms_m;
  const double texture_m2 = mean_square(texture_m);
  const double most_m2 = power_m2 * (1.0 + kSure * kRelative);
  noise.texture_rms_m = std::sqrt(texture_m2);
  noise.snr = std::max(0.0, texture_m2 - power_m2) / power_m2;
  noise.snr_low = noise.measured_snr_low = std::max(0.0, texture_m2 - most_m2) / most_m2;
  noise.typical_texture_rms_m = noise.texture_rms_m;
  noise.typical_added_rms_m = noise.added_rms_m;
  noise.typical_misplaced_rms_m = 0.0;
  noise.at_most_m = std::sqrt(std::max(0.0, texture_m2 - power_m2 * (1.0 - kSure * kRelative)));
  return noise;
}

}  // namespace asperity
