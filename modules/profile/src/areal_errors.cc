#include "areal_errors.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "areal_gaussian_filter.h"
#include "asperity/base/error.h"
#include "error_by_draws.h"

namespace asperity {

namespace {

constexpr std::size_t kParameters = kArealParameters.size();

bool follows_power(const ArealParameter& p) {
  return p.quantity == ArealQuantity::kHeight || p.quantity == ArealQuantity::kSlope;
}

// A draw's value where it is followed: heights by their squares, directions as they lie about the measured one.
double followed(const ArealParameter& p, double value, double measured) {
  if (p.quantity == ArealQuantity::kAngle) return measured + std::remainder(value - measured, std::numbers::pi);
  return follows_power(p) ? signed_square(value) : value;
}

}  // namespace

std::vector<double> draw_areal_noise(const ArealMap& map, const ArealNoise& noise, Random& random) {
  ArealMap drawn{map.x_spacing_m, map.y_spacing_m, map.columns, map.rows, {}};
  for (const double z : map.height_m) drawn.height_m.push_back(std::isnan(z) ? z : random.normal());
  if (noise.correlation_m > 0.0) {
    // Weights exp(−π x²/(αλ)²) give the correlation exp(−π x²/2(αλ)²).
    constexpr double kAt = 0.2;
    const double alpha = std::sqrt(std::numbers::ln2 / std::numbers::pi);
    const double cutoff_m = noise.correlation_m * std::sqrt(0.5 * std::numbers::pi / -std::log(kAt)) / alpha;
    drawn = gaussian_mean_surface(drawn, cutoff_m);
    double squares = 0.0, count = 0.0;
    for (const double z : drawn.height_m) {
      if (std::isnan(z)) continue;
      squares += z * z;
      count += 1.0;
    }
    // The filter's gain is the same for every draw but for what few cells leave to chance.
    const double gain = std::sqrt(squares / count);
    for (double& z : drawn.height_m) z /= gain;
  }
  for (std::size_t i = 0; i < drawn.height_m.size(); ++i)
    drawn.height_m[i] *= noise.sigma_m.empty() ? noise.rms_m : noise.sigma_m[i];
  return std::move(drawn.height_m);
}

void take_areal_errors(const ArealMap& map, const ArealTextureConfig& config, const ArealNoise& noise,
                       ArealTextureResult& out) {
  if (!noise.sigma_m.empty() && noise.sigma_m.size() != map.height_m.size())
    throw Error("areal roughness: " + std::to_string(noise.sigma_m.size()) + " standard deviations for " +
                std::to_string(map.height_m.size()) + " heights");
  std::array<FollowedValue, kParameters> values;
  Random random(kNoiseSeed);
  const std::size_t draws = noise_draws(map.height_m.size());
  ArealMap heavier = map;
  for (std::size_t j = 0; j < draws; ++j) {
    const std::vector<double> more = draw_areal_noise(map, noise, random);
    for (const bool second : {false, true}) {
      const double factor = second ? std::numbers::sqrt2 : 1.0;
      for (std::size_t i = 0; i < more.size(); ++i) heavier.height_m[i] = map.height_m[i] + factor * more[i];
      const ArealTextureResult r = measure_areal_texture(heavier, config);
      for (std::size_t p = 0; p < kParameters; ++p) {
        const ArealParameter& parameter = kArealParameters[p];
        (second ? values[p].twice : values[p].once).add(followed(parameter, r.*parameter.value, out.*parameter.value));
      }
    }
  }
  for (std::size_t p = 0; p < kParameters; ++p) {
    const ArealParameter& parameter = kArealParameters[p];
    out.standard_error.*parameter.value =
        error_by_draws(out.*parameter.value, values[p], {follows_power(parameter), parameter.hangs_on_extremes},
                       2.0 * noise.rms_sigma, 0.0, 0.0);
  }
}

}  // namespace asperity
