#include "make_grains.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <variant>
#include <vector>

#include "asperity/texture/evaluate_height.h"
#include "asperity/texture/fit_stochastic.h"
#include "asperity/texture/sample_heights.h"
#include "texture_window.h"

namespace asperity {
namespace {

constexpr double kLiftSigma = 3.0;
// The rate at which the original drew its heights (Siira and Pai 1996).
constexpr double kOriginalRate_Hz = 1000.0;
// What the evaluator lets speed and force multiply σ by at most.
constexpr double kMostScale = 10.0;

// σ and the correlation length of the heights along x, several lines of them (seed §6.5: "variance equal to the
// variation in height of the texture function").
StochasticTexture grains_of(const TextureModel& model) {
  constexpr std::size_t kSamples = 2048;
  constexpr int kLines = 16;
  const TextureWindow window = texture_window(model, 256);
  const double spacing_m = window.length_m / static_cast<double>(kSamples);
  std::vector<double> height_m;
  for (int line = 0; line < kLines; ++line) {
    const double y_m = window.y_m + window.width_m * line / kLines;
    for (const double h : sample_heights(model, {.length_mm = 1e3 * window.length_m,
                                                .spacing_mm = 1e3 * spacing_m,
                                                .x_mm = 1e3 * window.x_m,
                                                .y_mm = 1e3 * y_m}))
      height_m.push_back(h);
    height_m.push_back(std::numeric_limits<double>::quiet_NaN());
    if (std::holds_alternative<Fourier1d>(model)) break;
  }
  StochasticTexture grains;
  grains.grain_m = spacing_m;
  const bool flat =
      std::all_of(height_m.begin(), height_m.end(), [&](double h) { return std::isnan(h) || h == height_m.front(); });
  if (!flat) grains = fit_stochastic(height_m, spacing_m, {.lift_sigma = kLiftSigma}).texture;
  // A height stays under a tip at rest.
  grains.fade_speed_mps = 0.0;
  return grains;
}

}  // namespace

void make_grains(RenderTexture& texture) {
  if (const auto* own = std::get_if<StochasticTexture>(&texture.texture.model)) {
    texture.grains = *own;
    texture.grain_stiffness_N_per_m = own->stiffness_N_per_m;
    if (!(own->grain_m > 0.0)) texture.grains.grain_m = own->reference_speed_mps / kOriginalRate_Hz;
  } else {
    texture.grains = grains_of(texture.texture.model);
  }
  StochasticTexture& grains = texture.grains;
  grains.stiffness_N_per_m = 1.0;
  const bool scaled = grains.speed_exponent != 0.0 || grains.force_exponent != 0.0;
  texture.lift_m = std::max(grains.lift_sigma, 0.0) * grains.sigma_m;
  texture.highest_m = (scaled ? kMostScale : 1.0) * 2.0 * texture.lift_m;
}

}  // namespace asperity
