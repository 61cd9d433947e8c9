#include "asperity/texture/convert_rate.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/texture/autoregressive_filter.h"
#include "asperity/texture/series_state.h"

namespace asperity {
namespace {

constexpr int kFrequencies = 4096;
constexpr double kFloor = 1e-4;

// r_m at the new rate: the integral of the one-sided density times cos(2π f m / rate), by the midpoint rule.
std::vector<double> resampled_autocovariance(const AutoregressiveModel& model, double old_Hz, double new_Hz,
                                             int order) {
  std::vector<double> a(model.ar_lsf_rad.size());
  std::vector<double> b(model.ma_lsf_rad.size());
  lsf_to_ar(model.ar_lsf_rad, a);
  lsf_to_ar(model.ma_lsf_rad, b);
  std::vector<double> r(static_cast<std::size_t>(order) + 1, 0.0);
  const auto add = [&](double f_Hz, double power) {
    // cos mθ by Chebyshev's recursion.
    const double c = std::cos(2.0 * std::numbers::pi * f_Hz / new_Hz);
    double last = c;
    double now = 1.0;
    for (double& sum : r) {
      sum += power * now;
      const double next = 2.0 * c * now - last;
      last = now;
      now = next;
    }
  };
  const double kept_Hz = 0.5 * std::min(old_Hz, new_Hz);
  const double step_Hz = kept_Hz / kFrequencies;
  double power = 0.0;
  for (int i = 0; i < kFrequencies; ++i) {
    const double f_Hz = (i + 0.5) * step_Hz;
    const double omega_rad = 2.0 * std::numbers::pi * f_Hz / old_Hz;
    const double p = power_density(a, b, model.gain, model.variance, omega_rad) * 2.0 / old_Hz * step_Hz;
    power += p;
    add(f_Hz, p);
  }
  const double empty_Hz = 0.5 * new_Hz - kept_Hz;
  const double floor = kFloor * power / kFrequencies * (empty_Hz / kept_Hz);
  for (int i = 0; i < kFrequencies && empty_Hz > 0.0; ++i) add(kept_Hz + (i + 0.5) * empty_Hz / kFrequencies, floor);
  return r;
}

}  // namespace

AutoregressiveTexture convert_rate(const AutoregressiveTexture& texture, const ConvertRateConfig& config) {
  if (!(config.rate_Hz >= 1.0 && config.rate_Hz <= 1e6))
    throw Error("texture: the rate " + number_text(config.rate_Hz) + " Hz is not within 1 and 1e6");
  if (texture.models.empty() || (texture.models.size() > 1 && texture.edges.empty()))
    throw Error("texture: the rate of a texture that was not prepared");
  if (config.rate_Hz == texture.rate_Hz && config.order == 0) return texture;
  const double ratio = std::max(1.0, config.rate_Hz / texture.rate_Hz);
  const int own = static_cast<int>(texture.models.front().ar_lsf_rad.size() + texture.models.front().ma_lsf_rad.size());
  const int order = config.order > 0 ? std::min(config.order, kMaxSeriesOrder)
                                     : std::clamp(static_cast<int>(std::min(own * ratio, 32.0)), 1, kMaxSeriesOrder);
  AutoregressiveTexture converted = texture;
  converted.rate_Hz = config.rate_Hz;
  for (auto& model : converted.models) {
    AutoregressiveModel next{model.speed_mps, model.force_N, {}, {}, 1.0, 0.0};
    if (model.variance > 0.0 && model.gain != 0.0) {
      const auto filter = levinson(resampled_autocovariance(model, texture.rate_Hz, config.rate_Hz, order));
      next.ar_lsf_rad = reflection_to_lsf(filter.k);
      next.variance = filter.variance;
    } else {
      next.ar_lsf_rad = reflection_to_lsf(std::vector<double>(static_cast<std::size_t>(order), 0.0));
    }
    model = std::move(next);
  }
  prepare_autoregressive(converted, "texture");
  return converted;
}

}  // namespace asperity
