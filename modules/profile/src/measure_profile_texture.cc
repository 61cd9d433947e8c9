#include "asperity/profile/measure_profile_texture.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "asperity/base/nan.h"
#include "error_by_draws.h"
#include "follow_noise.h"

namespace asperity {
namespace {

constexpr std::size_t kOfProfile = kProfileParameters.size();

ProfileTexture measure(std::span<const double> height_m, double spacing_m, const RoughnessConfig& config,
                       const MaterialRatioConfig& material) {
  const FilteredProfiles z = filter_profile(height_m, spacing_m, config);
  const auto of = [&](const std::vector<double>& profile, int sections) {
    return measure_profile_parameters(profile, spacing_m, sections, config, material);
  };
  ProfileTexture out;
  out.P = of(z.primary_m, 1);
  if (!(config.lambda_c_mm > 0.0)) return out;
  out.R = of(z.roughness_m, config.sections);
  if (z.waviness_m.size() >= 2) out.W = of(z.waviness_m, 1);
  return out;
}

// Heights and slopes grow evenly with the noise's power by their squares.
bool follows_square(const ProfileParameter& p) {
  return p.quantity == ProfileQuantity::kHeight || p.quantity == ProfileQuantity::kSlope ||
         p.quantity == ProfileQuantity::kCurvature;
}

double along_power(const ProfileParameter& p, double value) { return follows_square(p) ? signed_square(value) : value; }

struct FollowedProfile {
  std::array<FollowedValue, kOfProfile> values;

  void add(const ProfileParameters& of, bool second) {
    for (std::size_t p = 0; p < kOfProfile; ++p) {
      const ProfileParameter& parameter = kProfileParameters[p];
      (second ? values[p].twice : values[p].once).add(along_power(parameter, of.*parameter.value));
    }
  }
};

// The standard errors of `out` from its values with the noise once and twice more.
void take_errors(const FollowedProfile& followed, const TextureNoise& noise, ProfileParametersResult& out) {
  const double relative = 2.0 * noise.added_rms_stderr_m / noise.added_rms_m;  // of the power
  for (std::size_t i = 0; i < kOfProfile; ++i) {
    const ProfileParameter& p = kProfileParameters[i];
    out.standard_error.*p.value =
        error_by_draws(out.*p.value, followed.values[i], {follows_square(p), p.hangs_on_extremes}, relative,
                       noise.scale_sigma, p.quantity == ProfileQuantity::kAlong ? noise.along_sigma : 0.0);
    // A number of peaks is known to no less than one: draws that all count the same do not show that it is exact.
    if (p.value == &ProfileParameters::pd_per_m || p.value == &ProfileParameters::vd_per_m)
      out.standard_error.*p.value = std::hypot(out.standard_error.*p.value, 1.0 / (std::sqrt(12.0) * out.length_m));
  }
}

}  // namespace

ProfileTexture measure_profile_texture(std::span<const double> height_m, double spacing_m,
                                       const RoughnessConfig& config, const MaterialRatioConfig& material,
                                       const TextureNoise& noise) {
  ProfileTexture out = measure(height_m, spacing_m, config, material);
  if (!(noise.added_rms_m > 0.0)) return out;
  FollowedProfile P, R, W;
  Random random(kNoiseSeed);
  std::vector<double> heavier(height_m.size());
  const std::size_t draws = noise_draws(height_m.size());
  for (std::size_t j = 0; j < draws; ++j) {
    const std::vector<double> more =
        draw_shaped_noise(noise, noise.added_psd_m2_mm, noise.added_sigma_m, height_m.size(), spacing_m, random);
    for (const bool second : {false, true}) {
      const double factor = second ? std::sqrt(2.0) : 1.0;
      for (std::size_t i = 0; i < heavier.size(); ++i) heavier[i] = height_m[i] + factor * more[i];
      const ProfileTexture with_noise = measure(heavier, spacing_m, config, material);
      P.add(with_noise.P, second);
      if (with_noise.R) R.add(*with_noise.R, second);
      if (with_noise.W) W.add(*with_noise.W, second);
    }
  }
  take_errors(P, noise, out.P);
  if (out.R) take_errors(R, noise, *out.R);
  if (out.W) take_errors(W, noise, *out.W);
  return out;
}

}  // namespace asperity
