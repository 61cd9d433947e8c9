#include "series_forces.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "asperity/texture/evaluate_autoregressive.h"
#include "asperity/texture/evaluate_decaying_sinusoids.h"
#include "asperity/texture/evaluate_stochastic.h"

namespace asperity {
namespace {

// Below it the direction of motion is taken back with the speed: at rest there is none.
constexpr double kDirectionSpeed_mps = 1e-3;
// Under less load a ringing tool lets go of the surface.
constexpr double kRingingLoad_N = 0.05;

Eigen::Vector3d direction(const Eigen::Vector3d& v_mps) noexcept {
  const double speed_mps = v_mps.norm();
  return v_mps / std::max(speed_mps, kDirectionSpeed_mps);
}

double smooth_step(double x) noexcept {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

// The tangential part is friction's (erratum 19): where it is positive it is against the motion.
Eigen::Vector3d along(const TextureTouch& touch, double normal_N, double tangential_N) noexcept {
  return normal_N * touch.normal - tangential_N * direction(touch.v_tangential_mps);
}

}  // namespace

TextureForce stochastic_force(const RenderTexture& texture, SeriesState& series, const TextureTouch& touch) noexcept {
  const double load_N = std::max(touch.contact_N, 0.0);
  // The grains' stiffness is 1 N/m: their force is their height.
  const SeriesForce grain = next_force(texture.grains, series, touch.v_tangential_mps.norm(), load_N, touch.dt_s);
  const double height_m = touch.fade * grain.normal_N;
  const double stiffness_N_per_m =
      touch.compliance_kc *
      (texture.grain_stiffness_N_per_m >= 0.0 ? texture.grain_stiffness_N_per_m : touch.stiffness_N_per_m);
  const double depth_m = std::clamp(height_m - touch.z_m, 0.0, std::max(height_m, 0.0));
  // How much of the grain is pressed in: the tangential part comes and goes with the normal one.
  const double pressed = touch.z_m <= 0.0 ? 1.0 : height_m > 0.0 ? depth_m / height_m : 0.0;
  double normal_N = stiffness_N_per_m * depth_m;
  double tangential_N = pressed * stiffness_N_per_m * touch.fade * grain.tangential_N;
  if (!(texture.grains.lift_sigma > 0.0)) {
    // Heights of both signs: a hole takes away load that is there and no more.
    if (height_m < 0.0) normal_N = std::max(stiffness_N_per_m * height_m, -load_N);
    tangential_N = std::clamp(tangential_N, -load_N, load_N);
  }
  return {along(touch, normal_N, tangential_N), std::max(height_m, 0.0), depth_m};
}

TextureForce autoregressive_force(const RenderTexture& texture, SeriesState& series,
                                  const TextureTouch& touch) noexcept {
  const auto* model = std::get_if<AutoregressiveTexture>(&texture.texture.model);
  if (model == nullptr) return {};
  const double load_N = std::max(touch.contact_N, 0.0);
  const double force_N = touch.fade * touch.compliance_kc * model->mass_kg *
                         next_acceleration_mps2(*model, series, touch.v_tangential_mps.norm(), load_N, touch.dt_s);
  const double carried_N = std::clamp(force_N, -load_N, load_N);
  return {along(touch, carried_N, model->tangential_ratio * carried_N), 0.0, 0.0};
}

TextureForce ringing_force(const RenderTexture& texture, SeriesState& series, const TextureTouch& touch,
                           bool new_contact) noexcept {
  const auto* model = std::get_if<DecayingSinusoids>(&texture.texture.model);
  if (model == nullptr) return {};
  const double load_N = std::max(touch.contact_N, 0.0);
  const double acceleration_mps2 =
      next_acceleration_mps2(*model, series, touch.v_tangential_mps.norm(), load_N, touch.dt_s);
  if (new_contact) {
    // The air has no part in the ringing: a new contact begins at rest, its force at zero.
    series.ringing = {};
    start_tap(*model, series, touch.approach_mps, load_N);
    return {};
  }
  const double carried = smooth_step(load_N / kRingingLoad_N);
  const double force_N =
      std::max(carried * touch.fade * touch.compliance_kc * model->mass_kg * acceleration_mps2, -load_N);
  return {along(touch, force_N, model->tangential_ratio * force_N), 0.0, 0.0};
}

}  // namespace asperity
