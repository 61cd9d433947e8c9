#include "asperity/render/texture_force.h"

#include <algorithm>
#include <cmath>

#include "asperity/texture/series_state.h"
#include "height_forces.h"
#include "left_of_fade.h"
#include "series_forces.h"

namespace asperity {
namespace {

bool is_finite(const TextureTouch& t) noexcept {
  return std::isfinite(t.x_m + t.y_m + t.z_m + t.contact_N + t.approach_mps + t.stiffness_N_per_m + t.compliance_kc +
                       t.fade + t.dt_s) &&
         t.x_gradient.allFinite() && t.y_gradient.allFinite() && t.normal.allFinite() && t.v_tangential_mps.allFinite();
}

TextureForce force_of(const RenderTexture& texture, TextureState& state, const TextureTouch& touch) noexcept {
  switch (texture.model) {
    case TextureForceModel::kHeight:
      return height_force(texture, touch);
    case TextureForceModel::kNormalPerturbation:
      return normal_perturbation_force(texture, touch);
    case TextureForceModel::kLateralGradient:
      return lateral_gradient_force(texture, touch);
    case TextureForceModel::kStochastic:
      return stochastic_force(texture, state.series, touch);
    case TextureForceModel::kAutoregressive:
      return autoregressive_force(texture, state.series, touch);
    case TextureForceModel::kDecayingSinusoids:
      return ringing_force(texture, state.series, touch, touch.contact_N > 0.0 && !state.loaded);
  }
  return {};
}

// At a change the force stays what it was; the difference to what it should be begins to fade.
void begin_fade(TextureState& state, const Eigen::Vector3d& wanted_N) noexcept {
  state.fading = state.cross_fade_s > 0.0;
  state.fading_N = state.last_force_N - wanted_N;
  state.fading_s = 0.0;
}

// The force with what the last change leaves over `dt_s` after the step before.
Eigen::Vector3d faded(TextureState& state, const Eigen::Vector3d& wanted_N, double dt_s) noexcept {
  state.last_force_N = wanted_N;
  if (state.fading) {
    state.fading_s += std::max(dt_s, 0.0);
    state.fading = state.fading_s < state.cross_fade_s;
    if (state.fading) state.last_force_N += left_of_fade(state.fading_s / state.cross_fade_s) * state.fading_N;
  }
  return state.last_force_N;
}

}  // namespace

TextureForce texture_force(const RenderTexture& texture, TextureState& state, const TextureTouch& touch) noexcept {
  if (!is_finite(touch)) {
    state = TextureState{};
    return {};
  }
  if (state.series_id != texture.id) {
    state.series = start_series(texture.seed);
    state.series_id = texture.id;
  }
  TextureForce force = force_of(texture, state, touch);
  if (!force.force_N.allFinite()) {
    state = TextureState{};
    return {};
  }
  state.cross_fade_s = texture.cross_fade_s;
  if (state.texture_id != texture.id && state.on_surface) begin_fade(state, force.force_N);
  state.texture_id = texture.id;
  state.on_surface = true;
  state.loaded = touch.contact_N > 0.0;
  force.force_N = faded(state, force.force_N, touch.dt_s);
  return force;
}

TextureForce no_texture_force(TextureState& state, bool on_surface, double dt_s) noexcept {
  if (!std::isfinite(dt_s)) dt_s = 0.0;
  // A tip that leaves the surface has left the texture's force behind: only what was fading already goes on.
  if (state.texture_id != 0 && on_surface) begin_fade(state, Eigen::Vector3d::Zero());
  state.texture_id = 0;
  state.on_surface = on_surface;
  state.loaded = false;
  TextureForce force;
  force.force_N = faded(state, force.force_N, dt_s);
  return force;
}

}  // namespace asperity
