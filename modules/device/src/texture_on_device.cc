#include "asperity/device/texture_on_device.h"

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

// The largest slope and change of slope over all of the texture, along rows, seen at two points a cell; at 4096 points
// a side where there are more than 2048 cells.
void measure_slopes(const RenderTexture& texture, TextureOnDevice& fit) {
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
double loop_gain(const RenderTexture& texture, const TextureOnDevice& fit, double depth_m) {
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

TextureOnDevice check_texture_on_device(const RenderTexture& texture, double stiffness_N_per_m, double compliance_kc,
                                        const DeviceCaps& caps) {
  if (!(stiffness_N_per_m > 0.0) || !std::isfinite(stiffness_N_per_m))
    throw Error("render: a stiffness of " + number_text(stiffness_N_per_m) + " is not a positive number");
  TextureOnDevice fit;
  const bool heights = is_height_field(texture.texture.model) && !is_series(texture.model);
  if (heights) measure_slopes(texture, fit);
  const double most_N = std::isfinite(caps.force_N) ? caps.force_N : 0.0;
  fit.loop_gain = loop_gain(texture, fit, texture.highest_m + most_N / stiffness_N_per_m);
  fit.highest_stiffness_N_per_m = caps.stiffness_N_per_m / fit.loop_gain;
  const double own_N_per_m =
      compliance_kc * (texture.own_stiffness_N_per_m >= 0.0 ? texture.own_stiffness_N_per_m : stiffness_N_per_m);
  fit.most_force_N = own_N_per_m * texture.highest_m;

  if (own_N_per_m > caps.texture_stiffness_N_per_m && texture.highest_m > 0.0) {
    fit.problems.push_back({"texture_stiffness",
                            "the texture's stiffness k_c k_s is " + rounded(1e-3 * own_N_per_m) + " N/mm, above " +
                                rounded(1e-3 * caps.texture_stiffness_N_per_m) +
                                " N/mm: " + caps.texture_stiffness_reason,
                            1});
  }
  if (fit.highest_stiffness_N_per_m < stiffness_N_per_m) {
    fit.problems.push_back({"texture_loop_gain",
                            "the texture makes the loop " + rounded(fit.loop_gain) +
                                " times as stiff as a flat wall, so that the device renders at most " +
                                rounded(1e-3 * fit.highest_stiffness_N_per_m) + " N/mm under it; it is " +
                                rounded(1e-3 * stiffness_N_per_m) + " N/mm",
                            1});
  }
  if (fit.most_force_N > caps.force_N) {
    fit.problems.push_back({"texture_force",
                            "the texture alone gives up to " + rounded(fit.most_force_N) + " N; the device has " +
                                rounded(caps.force_N) + " N",
                            1});
  }
  if (heights && highest_cycles_per_mm(texture.texture) > caps.texture_cycles_per_mm) {
    fit.problems.push_back({"texture_bandwidth",
                            "the texture may hold waves of " + rounded(highest_cycles_per_mm(texture.texture)) +
                                " cycles/mm; " + caps.texture_bandwidth_reason,
                            1});
  }
  return fit;
}

}  // namespace asperity
