#pragma once

#include <Eigen/Core>

#include "asperity/render/render_texture.h"
#include "asperity/render/texture_state.h"

namespace asperity {

// How a textured place is touched, in the scene's world.
struct TextureTouch {
  double x_m = 0.0;  // texture coordinates of the place: along the scan path, and across it
  double y_m = 0.0;
  Eigen::Vector3d x_gradient =
      Eigen::Vector3d::Zero();  // of x and of y over the surface, within its plane (1): a slope
  Eigen::Vector3d y_gradient = Eigen::Vector3d::Zero();  // (hx, hy) of the heights is hx x_gradient + hy y_gradient
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();     // unit, outwards
  double z_m = 0.0;        // the tip's height above the geometric surface; negative inside
  double contact_N = 0.0;  // k_s d, the force of the geometric contact
  Eigen::Vector3d v_tangential_mps = Eigen::Vector3d::Zero();  // of the tip over the surface
  double approach_mps = 0.0;                                   // speed into the surface, for taps
  double stiffness_N_per_m = 0.0;                              // k_s there
  double compliance_kc = 1.0;                                  // k_c there
  double fade = 1.0;  // towards the border of a textured area, 1 well inside (erratum 20)
  double dt_s = 1e-3;
};

// The force of a texture, without friction.
struct TextureForce {
  Eigen::Vector3d force_N = Eigen::Vector3d::Zero();
  double height_m = 0.0;  // H of erratum 19 at the place, with its offset, faded; 0 for a texture without heights
  double depth_m = 0.0;   // Δh, the penetration into the texture
};

// One step of a texture's force by the texture's model of it. A change of texture or of model since the last step
// does not step the force: what is missing fades in over RenderTexture::cross_fade_s. The first touch after a step in
// the air does not fade: there a texture begins with no force of itself. Zero if an input is not finite.
// Realtime-safe: yes.
TextureForce texture_force(const RenderTexture& texture, TextureState& state, const TextureTouch& touch) noexcept;

// One step without a texture under the tip: in the air, or on a surface without one. What a change left over goes on
// fading, so that a texture that is taken away under the tip does not click either; otherwise zero. To be called on
// every step on which texture_force() is not. Realtime-safe: yes.
TextureForce no_texture_force(TextureState& state, bool on_surface, double dt_s) noexcept;

}  // namespace asperity
