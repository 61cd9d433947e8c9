#include "asperity/texture/synthesize_stroke.h"

#include <cmath>
#include <cstddef>
#include <string>
#include <type_traits>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/texture/convert_rate.h"
#include "asperity/texture/evaluate_autoregressive.h"
#include "asperity/texture/evaluate_decaying_sinusoids.h"
#include "asperity/texture/evaluate_height.h"
#include "asperity/texture/evaluate_stochastic.h"

namespace asperity {
namespace {

constexpr double kMostSamples = 268435456.0;  // 2^28

std::size_t samples_of(const StrokeConfig& c) {
  const auto check = [](const char* what, double value, double low, double high) {
    if (!(value >= low && value <= high)) {
      throw Error(std::string("stroke: ") + what + " " + number_text(value) + " is not within " + number_text(low) +
                  " and " + number_text(high));
    }
  };
  check("speed_mps", c.speed_mps, 0.0, 10.0);
  check("force_N", c.force_N, 0.0, 100.0);
  check("rate_Hz", c.rate_Hz, 1.0, 1e6);
  check("duration_s", c.duration_s, 0.0, 3600.0);
  check("start_m", c.start_m, -1e3, 1e3);
  check("y_m", c.y_m, -1e3, 1e3);
  const double count = std::round(c.duration_s * c.rate_Hz);
  if (count > kMostSamples) throw Error("stroke: " + number_text(count) + " samples, more than 2^28");
  return static_cast<std::size_t>(count);
}

std::vector<double> stroke_heights(const TextureModel& model, const StrokeConfig& c, std::vector<double> x) {
  const double step_m = c.speed_mps / c.rate_Hz;
  const auto slope = [&](double samples) {
    return evaluate_height(model, c.start_m + samples * step_m, c.y_m).slope_x;
  };
  double last = slope(-0.5);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double next = slope(static_cast<double>(i) + 0.5);
    x[i] = c.speed_mps * c.rate_Hz * (next - last);
    last = next;
  }
  return x;
}

std::vector<double> stroke(const AutoregressiveTexture& texture, const StrokeConfig& c, std::vector<double> x) {
  const auto converted = convert_rate(texture, {.rate_Hz = c.rate_Hz});
  SeriesState state = start_series(static_cast<std::uint64_t>(c.seed));
  for (double& v : x) v = next_acceleration_mps2(converted, state, c.speed_mps, c.force_N, 1.0 / c.rate_Hz);
  return x;
}

std::vector<double> stroke(const DecayingSinusoids& texture, const StrokeConfig& c, std::vector<double> x) {
  SeriesState state = start_series(static_cast<std::uint64_t>(c.seed));
  if (!(texture.pitch_m > 0.0)) start_tap(texture, state, c.speed_mps, c.force_N);
  for (double& v : x) v = next_acceleration_mps2(texture, state, c.speed_mps, c.force_N, 1.0 / c.rate_Hz);
  return x;
}

std::vector<double> stroke(const StochasticTexture& texture, const StrokeConfig& c, std::vector<double> x) {
  StochasticTexture plain = texture;
  plain.lift_sigma = 0.0;
  SeriesState state = start_series(static_cast<std::uint64_t>(c.seed));
  for (double& v : x)
    v = texture.stiffness_N_per_m / texture.mass_kg *
        next_height_m(plain, state, c.speed_mps, c.force_N, 1.0 / c.rate_Hz);
  return x;
}

}  // namespace

std::vector<double> synthesize_stroke(const Texture& texture, const StrokeConfig& config) {
  std::vector<double> x(samples_of(config));
  return std::visit(
      [&](const auto& model) {
        if constexpr (requires { stroke(model, config, x); })
          return stroke(model, config, std::move(x));
        else
          return stroke_heights(texture.model, config, std::move(x));
      },
      texture.model);
}

}  // namespace asperity
