#include "asperity/profile/measure_roughness_under_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "asperity/base/nan.h"
#include "asperity/profile/filter_profile.h"
#include "follow_noise.h"
#include "root_of_power.h"
#include "shape_without_noise.h"

namespace asperity {

namespace {

constexpr std::size_t kPlaceDraws = 8;
constexpr double kLeastSnr = 1.0;  // of added noise: below it the crossings that RSm counts would be the noise's
constexpr std::size_t kParameters = kRoughnessParameters.size();

struct Followed {
  std::array<Spread, kParameters> once, twice;  // lengths squared
};

double along_power(const RoughnessParameter& p, double value) {
  return p.is_length && p.name != "RSm" ? signed_square(value) : value;
}

Followed follow_noise(std::span<const double> height_m, double spacing_m, const TextureNoise& noise,
                      const RoughnessConfig& config) {
  Followed out;
  Random random(kNoiseSeed);
  const std::size_t draws = noise_draws(height_m.size());
  std::vector<double> heavier(height_m.size());
  for (std::size_t j = 0; j < draws; ++j) {
    const std::vector<double> more =
        draw_shaped_noise(noise, noise.added_psd_m2_mm, noise.added_sigma_m, height_m.size(), spacing_m, random);
    for (const double power : {1.0, 2.0}) {
      for (std::size_t i = 0; i < heavier.size(); ++i) heavier[i] = height_m[i] + std::sqrt(power) * more[i];
      const RoughnessResult r = measure_roughness(heavier, spacing_m, config);
      for (std::size_t p = 0; p < kParameters; ++p) {
        const double value = r.*kRoughnessParameters[p].value;
        (power < 1.5 ? out.once : out.twice)[p].add(along_power(kRoughnessParameters[p], value));
      }
    }
  }
  return out;
}

// Whether a parameter hangs on single heights: on where they are highest and lowest, or on high powers of them.
bool hangs_on_extremes(const RoughnessParameter& p) {
  return p.value != &RoughnessParameters::Ra_m && p.value != &RoughnessParameters::Rq_m &&
         p.value != &RoughnessParameters::RSm_m;
}

bool is_mean_of_powers(const RoughnessParameter& p) {
  return p.value == &RoughnessParameters::Ra_m || p.value == &RoughnessParameters::Rq_m;
}

// What heights at a wrong place can do to each parameter: the spread over draws of noise of their spectrum, and half of
// the mean change. To Ra and Rq they do what they do to the power (stretch_sigma).
std::array<double, kParameters> doubt_by_place(std::span<const double> height_m, double spacing_m,
                                               const TextureNoise& noise, const RoughnessConfig& config,
                                               const RoughnessParameters& measured) {
  Random random(kNoiseSeed, 1);
  std::array<Spread, kParameters> spread;
  std::vector<double> heavier(height_m.size());
  for (std::size_t j = 0; j < kPlaceDraws; ++j) {
    const std::vector<double> more = draw_shaped_noise(noise, noise.misplaced_psd_m2_mm, noise.misplaced_sigma_m,
                                                       height_m.size(), spacing_m, random);
    for (std::size_t i = 0; i < heavier.size(); ++i) heavier[i] = height_m[i] + more[i];
    const RoughnessResult r = measure_roughness(heavier, spacing_m, config);
    for (std::size_t p = 0; p < kParameters; ++p) spread[p].add(r.*kRoughnessParameters[p].value);
  }
  std::array<double, kParameters> out{};
  for (std::size_t p = 0; p < kParameters; ++p) {
    const RoughnessParameter& parameter = kRoughnessParameters[p];
    if (is_mean_of_powers(parameter)) continue;
    const double change = 0.5 * (spread[p].mean() - measured.*parameter.value);
    const double doubt = std::hypot(spread[p].deviation(), change);
    out[p] = std::isfinite(doubt) ? doubt : 0.0;
  }
  return out;
}

// Elements lower than a tenth of Rz do not count: what one standard error of Rz, each way, changes RSm by, RMS.
double doubt_by_threshold(std::span<const double> height_m, double spacing_m, const RoughnessConfig& config,
                          const RoughnessParameters& measured, double Rz_m, double Rz_stderr_m) {
  double square = 0.0;
  for (const double sign : {-1.0, 1.0}) {
    RoughnessConfig other = config;
    other.element_height *= std::max(0.0, Rz_m + sign * Rz_stderr_m) / measured.Rz_m;
    const double change = measure_roughness(height_m, spacing_m, other).RSm_m - measured.RSm_m;
    if (!std::isfinite(change)) return kNan;  // within its error no element is left
    square += 0.5 * change * change;
  }
  return std::sqrt(square);
}

// The heights that the parameters are of, and what of the noise is in them: both after the filters.
struct Filtered {
  std::vector<double> height_m;
  std::vector<double> sigma_m;  // at each of them, as far as it changes along the profile; may be empty
  double noise_m2 = 0.0;
};

std::vector<double> roughness_profile(std::span<const double> height_m, double spacing_m,
                                      const RoughnessConfig& config) {
  return filter_profile(height_m, spacing_m, config).roughness_m;
}

// The filters' share of the noise is the mean square of filtered draws over that of the draws.
Filtered filter_both(std::span<const double> height_m, double spacing_m, const TextureNoise& noise,
                     const RoughnessConfig& config) {
  Filtered out;
  out.noise_m2 = noise.added_rms_m * noise.added_rms_m;
  if (!(config.lambda_s_mm > 0.0) && !(config.lambda_c_mm > 0.0)) {
    out.height_m.assign(height_m.begin(), height_m.end());
    out.sigma_m = noise.added_sigma_m;
    return out;
  }
  out.height_m = roughness_profile(height_m, spacing_m, config);
  Random random(kNoiseSeed, 3);
  const auto mean_square = [](const std::vector<double>& x) {
    double sum = 0.0, count = 0.0;
    for (const double value : x) {
      if (!std::isfinite(value)) continue;
      sum += value * value, count += 1.0;
    }
    return count > 0.0 ? sum / count : 0.0;
  };
  double before = 0.0, after = 0.0;
  const std::size_t draws = noise_draws(height_m.size());
  for (std::size_t j = 0; j < draws; ++j) {
    const std::vector<double> drawn =
        draw_shaped_noise(noise, noise.added_psd_m2_mm, noise.added_sigma_m, height_m.size(), spacing_m, random);
    before += mean_square(drawn);
    after += mean_square(roughness_profile(drawn, spacing_m, config));
  }
  const double share = before > 0.0 ? after / before : 0.0;
  out.noise_m2 *= share;
  if (noise.added_sigma_m.size() == height_m.size()) {
    const std::size_t first = (height_m.size() - std::min(height_m.size(), out.height_m.size())) / 2;
    for (std::size_t i = 0; i < out.height_m.size(); ++i)
      out.sigma_m.push_back(std::sqrt(share) * noise.added_sigma_m[first + i]);
  }
  return out;
}

}  // namespace

RoughnessResult measure_roughness_under_noise(std::span<const double> height_m, double spacing_m,
                                              const TextureNoise& noise, const RoughnessConfig& config) {
  RoughnessResult out = measure_roughness(height_m, spacing_m, config);
  if (!(noise.added_rms_m > 0.0)) return out;
  const RoughnessParameters measured = out;
  const Followed followed = follow_noise(height_m, spacing_m, noise, config);
  const std::array<double, kParameters> place = doubt_by_place(height_m, spacing_m, noise, config, measured);
  const double relative = 2.0 * noise.added_rms_stderr_m / noise.added_rms_m;  // of the power
  const double stretch = 0.5 * noise.stretch_sigma;

  // Heights at a wrong place cross the mean line as often as others: only added noise makes crossings of its own.
  const bool stands_out = noise.measured_snr_low >= kLeastSnr;
  const double contact = noise.contact_rms_m / std::numbers::sqrt3 / measured.Rq_m;
  Random random(kNoiseSeed, 2);
  const Filtered filtered = filter_both(height_m, spacing_m, noise, config);
  const double noise_m2 = filtered.noise_m2;
  const auto draw = [&] {
    std::vector<double> drawn =
        draw_shaped_noise(noise, noise.added_psd_m2_mm, noise.added_sigma_m, height_m.size(), spacing_m, random);
    const bool filters = config.lambda_s_mm > 0.0 || config.lambda_c_mm > 0.0;
    return filters ? roughness_profile(drawn, spacing_m, config) : drawn;
  };
  const Shape shape =
      shape_without_noise(filtered.height_m, measured.Rq_m * measured.Rq_m, measured.Rsk, measured.Rku,
                          {noise_m2, relative * noise_m2, filtered.sigma_m, draw}, noise_draws(height_m.size()));
  for (std::size_t p = 0; p < kParameters; ++p) {
    const RoughnessParameter& parameter = kRoughnessParameters[p];
    double& value = out.*parameter.value;
    double& error = out.standard_error.*parameter.value;
    const double before = value, none = along_power(parameter, before);
    const double once = followed.once[p].mean(), twice = followed.twice[p].mean();
    const bool is_rq = parameter.value == &RoughnessParameters::Rq_m;
    const bool is_height = parameter.is_length && parameter.value != &RoughnessParameters::RSm_m;
    const double line = is_rq ? none - noise_m2 : 2.0 * none - once;
    const double parabola = is_rq ? line : 3.0 * none - 3.0 * once + twice;
    // Of what noise adds to extremes the extrapolation finds about half: its curve is steepest where it cannot look.
    const double doubt = 0.5 * (hangs_on_extremes(parameter) ? parabola - none : parabola - line);
    const double known = relative * (parabola - none);
    const double spread = followed.once[p].deviation();
    if (const ShapeParameter* without = parameter.value == &RoughnessParameters::Rsk   ? &shape.skewness
                                        : parameter.value == &RoughnessParameters::Rku ? &shape.kurtosis
                                                                                       : nullptr) {
      // What misplaced heights do is measured beside the noise's power too.
      const double share = 1.0 - noise_m2 / (measured.Rq_m * measured.Rq_m);
      value = without->value;
      error = std::isfinite(value) ? std::hypot(without->standard_error, place[p] / share) : kNan;
      continue;
    }
    if (!is_height) {
      value = stands_out ? parabola : kNan;
      const double scale = parameter.is_length ? noise.along_sigma * value : 0.0;
      error = std::isfinite(value) ? std::hypot(std::hypot(spread, doubt), std::hypot(known, scale, place[p])) : kNan;
      continue;
    }
    // Of squares: relative errors of the height count twice.
    const double height = std::hypot(noise.scale_sigma, contact, hangs_on_extremes(parameter) ? 0.0 : stretch);
    const double error_m2 =
        std::hypot(std::hypot(spread, doubt), std::hypot(known, 2.0 * height * none), 2.0 * place[p] * before);
    const double sign = none < 0.0 ? -1.0 : 1.0;  // of levels below the mean line
    const Root root = root_of_power(sign * parabola, error_m2);
    value = sign * root.value;
    error = root.standard_error;
  }
  if (std::isfinite(out.standard_error.RSm_m) && std::isfinite(out.standard_error.Rz_m)) {
    out.standard_error.RSm_m =
        std::hypot(out.standard_error.RSm_m,
                   doubt_by_threshold(height_m, spacing_m, config, measured, out.Rz_m, out.standard_error.Rz_m));
  }
  if (!std::isfinite(out.Rq_m)) {
    static_cast<RoughnessParameters&>(out) = RoughnessParameters::unknown();
    out.standard_error = RoughnessParameters::unknown();
  }
  return out;
}

}  // namespace asperity
