#include "asperity/render/texture_force.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "asperity/base/smoothstep.h"
#include "asperity/texture/series_state.h"

namespace asperity {
namespace {

bool is_finite(const TextureTouch& t) noexcept {
  return std::isfinite(t.x_m + t.y_m + t.z_m + t.contact_N + t.approach_mps + t.stiffness_N_per_m + t.compliance_kc +
                       t.fade + t.dt_s) &&
         t.x_gradient.allFinite() && t.y_gradient.allFinite() && t.normal.allFinite() && t.v_tangential_mps.allFinite();
}

// The forces of a height field H(x, y) on a tip z above the geometric surface. All vanish continuously at z = H.
struct Indentation {
  double height_m = 0.0;
  double depth_m = 0.0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();  // of H over the surface
};

Indentation indentation(const RenderTexture& texture, const TextureTouch& touch) noexcept {
  const HeightAndGradient h = render_height(texture, touch.x_m, touch.y_m);
  Indentation i;
  i.height_m = touch.fade * h.height_m;
  i.depth_m = std::clamp(i.height_m - touch.z_m, 0.0, std::max(i.height_m, 0.0));
  i.gradient = touch.fade * (h.slope_x * touch.x_gradient + h.slope_y * touch.y_gradient);
  return i;
}

double stiffness_N_per_m(const TextureTouch& touch) noexcept { return touch.compliance_kc * touch.stiffness_N_per_m; }

// k_c k_s Δh n, Δh = clamp(H − z, 0, H): seed §6.5 (5), errata 19 and 20.
TextureForce height_force(const RenderTexture& texture, const TextureTouch& touch) noexcept {
  const Indentation i = indentation(texture, touch);
  return {stiffness_N_per_m(touch) * i.depth_m * touch.normal, i.height_m, i.depth_m};
}

// k_c k_s Δh m, m the unit normal of the height field: n − ∇H, normalised (Ho, Basdogan and Srinivasan 1999).
TextureForce normal_perturbation_force(const RenderTexture& texture, const TextureTouch& touch) noexcept {
  const Indentation i = indentation(texture, touch);
  // The gradient lies within the surface, so that (∇H·n) n of the printed formula is zero.
  const Eigen::Vector3d m = touch.normal - i.gradient;
  return {stiffness_N_per_m(touch) * i.depth_m / m.norm() * m, i.height_m, i.depth_m};
}

// −k ∇H within the surface (Minsky 1995), k the load on the place: k_c (k_s d + k_s Δh), in newtons. That is minus the
// gradient of the elastic energy ½ k_s (H − z)² over the surface, times k_c.
TextureForce lateral_gradient_force(const RenderTexture& texture, const TextureTouch& touch) noexcept {
  const Indentation i = indentation(texture, touch);
  const double load_N = touch.compliance_kc * touch.contact_N + stiffness_N_per_m(touch) * i.depth_m;
  return {-load_N * i.gradient, i.height_m, i.depth_m};
}

// Below it the direction of motion is taken back with the speed: at rest there is none.
constexpr double kDirectionSpeed_mps = 1e-3;

// One step of a series. The tangential part opposes the motion while the normal one pushes the tip out, as friction
// does (erratum 19).
TextureForce series_force(const RenderTexture& texture, SeriesState& state, const TextureTouch& touch,
                          bool is_new_contact) noexcept {
  const double speed_mps = touch.v_tangential_mps.norm();
  const SeriesContact contact{speed_mps,
                              std::max(touch.contact_N, 0.0),
                              touch.approach_mps,
                              touch.z_m,
                              touch.stiffness_N_per_m,
                              touch.compliance_kc,
                              touch.fade,
                              touch.dt_s};
  return std::visit(
      [&]<class Model>(const Model& model) -> TextureForce {
        if constexpr (SeriesModel<Model>) {
          using Traits = TextureModelTraits<Model>;
          if constexpr (requires { Traits::start_contact(model, state, contact); }) {
            if (is_new_contact) return Traits::start_contact(model, state, contact), TextureForce{};
          }
          const SeriesContactForce f = Traits::contact_force(model, state, contact);
          const Eigen::Vector3d direction = touch.v_tangential_mps / std::max(speed_mps, kDirectionSpeed_mps);
          return {f.normal_N * touch.normal - f.tangential_N * direction, f.height_m, f.depth_m};
        }
        return {};
      },
      texture.series_of_heights ? *texture.series_of_heights : texture.texture.model);
}

TextureForce force_of(const RenderTexture& texture, TextureState& state, const TextureTouch& touch) noexcept {
  switch (texture.model) {
    case TextureForceModel::kHeight:
      return height_force(texture, touch);
    case TextureForceModel::kNormalPerturbation:
      return normal_perturbation_force(texture, touch);
    case TextureForceModel::kLateralGradient:
      return lateral_gradient_force(texture, touch);
    default:
      return series_force(texture, state.series, touch, touch.contact_N > 0.0 && !state.loaded);
  }
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
    if (state.fading) state.last_force_N += (1.0 - smoothstep(state.fading_s / state.cross_fade_s)) * state.fading_N;
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
