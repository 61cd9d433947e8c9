#include "asperity/render/reconstruction_filter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/texture/evaluate_height.h"

namespace asperity {
namespace {

constexpr double kRateOverHighest = 4.0;
constexpr double kStepsAWave = 4.0;
constexpr double kNoisyStiffness_N_per_m = 450.0;

void check(const char* what, double value) {
  if (!(value > 0.0) || !std::isfinite(value))
    throw Error(std::string("render: ") + what + " of " + number_text(value) + " is not a positive number");
}

void check_known(const char* what, double value) {
  if (!std::isnan(value)) check(what, value);
}

// The largest slope and change of slope over all of the texture, along rows, seen at two points a cell; at 4096 points
// a side where there are more than 2048 cells.
void measure(const RenderTexture& texture, TextureFit& fit) {
  const HeightWindow window = height_window(texture.texture.model, std::numeric_limits<std::size_t>::max()).value();
  const bool line = line_length_mm(texture.texture.model).has_value();
  const std::size_t columns = line ? 16384 : std::clamp<std::size_t>(2 * window.columns, 512, 4096);
  const std::size_t rows = line ? 1 : std::clamp<std::size_t>(2 * window.rows, 512, 4096);
  const double step_x_m = window.length_m / static_cast<double>(columns);
  const double step_y_m = window.width_m / static_cast<double>(rows);
  const auto at = [&](std::size_t c, std::size_t r) {
    return render_height(texture, window.x_m + step_x_m * static_cast<double>(c),
                         window.y_m + step_y_m * static_cast<double>(r));
  };
  for (std::size_t r = 0; r < rows; ++r) {
    HeightAndGradient here = at(0, r);
    for (std::size_t c = 0; c < columns; ++c) {
      const HeightAndGradient next = at(c + 1, r);
      fit.steepest = std::max(fit.steepest, std::hypot(next.slope_x, next.slope_y));
      const double turn = std::hypot(next.slope_x - here.slope_x, next.slope_y - here.slope_y);
      fit.most_curved_per_m = std::max(fit.most_curved_per_m, turn / step_x_m);
      here = next;
    }
  }
}

// With s the slope, c the curvature, H the height and D the depth of the whole contact:
//   height               ∂(k (H − z) n) = k (∇H, −1): √(1 + s²)
//   normal perturbation  that times m, and the depth times ∂m, which is at most c: √(1 + s²) + H c
//   lateral gradient     ∂(−k (H − z) ∇H) = −k (∇H∇Hᵀ + (H − z) ∂∇H, −∇H), beside the flat wall's k: 1 + s + s² + D c
double loop_gain(const RenderTexture& texture, const TextureFit& fit, double depth_m) {
  const double s = fit.steepest;
  switch (texture.model) {
    case TextureForceModel::kHeight:
      return std::sqrt(1.0 + s * s);
    case TextureForceModel::kNormalPerturbation:
      return std::sqrt(1.0 + s * s) + texture.highest_m * fit.most_curved_per_m;
    case TextureForceModel::kLateralGradient:
      return 1.0 + s + s * s + depth_m * fit.most_curved_per_m;
    default:
      return 1.0;
  }
}

std::string rounded(double value) { return number_text(std::round(100.0 * value) / 100.0); }

}  // namespace

double reconstruction_cutoff_cycles_per_mm(const TextureDevice& device) {
  check("a rate", device.rate_Hz);
  check("a speed", device.highest_speed_mps);
  check_known("a bandwidth", device.bandwidth_Hz);
  check_known("a resolution", device.position_resolution_m);
  // fmin takes the other where one is nan.
  const double highest_Hz = std::fmin(device.bandwidth_Hz, device.rate_Hz / kRateOverHighest);
  const double by_time = 1e-3 * highest_Hz / device.highest_speed_mps;
  return std::fmin(by_time, 1e-3 / (kStepsAWave * device.position_resolution_m));
}

TextureFit fit_texture_to_device(const RenderTexture& texture, double stiffness_N_per_m, double compliance_kc,
                                 const TextureDevice& device) {
  check("a stiffness", stiffness_N_per_m);
  const double cutoff = reconstruction_cutoff_cycles_per_mm(device);
  TextureFit fit;
  const bool heights = is_height_field(texture.texture.model) && !is_series(texture.model);
  if (heights) measure(texture, fit);
  const double most_N = std::isfinite(device.max_force_N) ? device.max_force_N : 0.0;
  fit.loop_gain = loop_gain(texture, fit, texture.highest_m + most_N / stiffness_N_per_m);
  fit.highest_stiffness_N_per_m = 2.0 * device.damping_N_s_per_m * device.rate_Hz / fit.loop_gain;
  const double own_N_per_m =
      compliance_kc * (texture.own_stiffness_N_per_m >= 0.0 ? texture.own_stiffness_N_per_m : stiffness_N_per_m);
  fit.most_force_N = own_N_per_m * texture.highest_m;

  if (own_N_per_m > kNoisyStiffness_N_per_m && texture.highest_m > 0.0) {
    fit.problems.push_back({"texture_stiffness",
                            "the texture's stiffness k_c k_s is " + rounded(1e-3 * own_N_per_m) +
                                " N/mm; above 0.45 N/mm what is felt may be the loop's own noise (Choi and Tan)",
                            1});
  }
  if (fit.highest_stiffness_N_per_m < stiffness_N_per_m) {
    fit.problems.push_back({"texture_damping",
                            "the device's damping bears a stiffness of " +
                                rounded(1e-3 * fit.highest_stiffness_N_per_m) +
                                " N/mm under this texture, which makes the loop " + rounded(fit.loop_gain) +
                                " times as stiff as a flat wall; it is " + rounded(1e-3 * stiffness_N_per_m) + " N/mm",
                            1});
  }
  if (fit.most_force_N > device.max_force_N) {
    fit.problems.push_back({"texture_force",
                            "the texture alone gives up to " + rounded(fit.most_force_N) + " N; the device has " +
                                rounded(device.max_force_N) + " N",
                            1});
  }
  if (line_length_mm(texture.texture.model)) {
    const double finest = highest_cycles_per_mm(texture.texture.model);
    if (finest > cutoff) {
      fit.problems.push_back({"texture_bandwidth",
                              "the texture has waves of " + rounded(finest) + " cycles/mm; at " +
                                  rounded(1e3 * device.highest_speed_mps) + " mm/s the device renders " +
                                  rounded(cutoff),
                              1});
    }
  }
  return fit;
}

}  // namespace asperity
