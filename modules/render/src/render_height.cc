#include "asperity/render/render_texture.h"
#include "asperity/texture/evaluate_height.h"

namespace asperity {

HeightAndGradient render_height(const RenderTexture& texture, double x_m, double y_m) noexcept {
  HeightAndGradient h = servo_height(texture.texture.model, texture.tables, x_m, y_m);
  h.height_m += texture.height_offset_m;
  if (!(h.height_m > 0.0)) return {};
  return h;
}

}  // namespace asperity
