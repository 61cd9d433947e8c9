#include "height_forces.h"

#include <algorithm>
#include <cmath>

namespace asperity {
namespace {

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

}  // namespace

TextureForce height_force(const RenderTexture& texture, const TextureTouch& touch) noexcept {
  const Indentation i = indentation(texture, touch);
  return {stiffness_N_per_m(touch) * i.depth_m * touch.normal, i.height_m, i.depth_m};
}

TextureForce normal_perturbation_force(const RenderTexture& texture, const TextureTouch& touch) noexcept {
  const Indentation i = indentation(texture, touch);
  // The gradient lies within the surface, so that (∇H·n) n of the printed formula is zero.
  const Eigen::Vector3d m = touch.normal - i.gradient;
  return {stiffness_N_per_m(touch) * i.depth_m / m.norm() * m, i.height_m, i.depth_m};
}

TextureForce lateral_gradient_force(const RenderTexture& texture, const TextureTouch& touch) noexcept {
  const Indentation i = indentation(texture, touch);
  const double load_N = touch.compliance_kc * touch.contact_N + stiffness_N_per_m(touch) * i.depth_m;
  return {-load_N * i.gradient, i.height_m, i.depth_m};
}

}  // namespace asperity
