#include <variant>

#include "asperity/render/render_texture.h"
#include "asperity/texture/evaluate_height.h"
#include "field_height.h"

namespace asperity {
namespace {

HeightAndGradient product_height(const RenderTexture& texture, const Fourier2d& f, double x_m, double y_m) noexcept {
  const HeightAndSlope x = table_height(texture.x_table, x_m);
  const HeightAndSlope y = table_height(texture.y_table, y_m);
  return {f.offset_m + f.scale_per_m * (x.height_m * y.height_m), f.scale_per_m * (x.slope * y.height_m),
          f.scale_per_m * (x.height_m * y.slope)};
}

HeightAndGradient field_height(const RenderTexture& texture, double x_m, double y_m) noexcept {
  const TextureModel& model = texture.texture.model;
  if (!texture.x_table.cells.empty()) {
    if (const auto* product = std::get_if<Fourier2d>(&model)) return product_height(texture, *product, x_m, y_m);
    const HeightAndSlope h = table_height(texture.x_table, x_m);
    return {h.height_m, h.slope, 0.0};
  }
  if (const auto* map = std::get_if<HeightMap>(&model)) return map_height(*map, texture.grid, x_m, y_m);
  if (const auto* areal = std::get_if<ArealTexture>(&model))
    return spline_height(areal->surface, texture.grid, x_m, y_m);
  if (const auto* f = std::get_if<Fourier2d>(&model); f != nullptr && f->kind == Fourier2dKind::kIsotropic)
    return spline_height(f->grid, texture.grid, x_m, y_m);
  return evaluate_height(model, x_m, y_m);
}

}  // namespace

HeightAndGradient render_height(const RenderTexture& texture, double x_m, double y_m) noexcept {
  HeightAndGradient h = field_height(texture, x_m, y_m);
  h.height_m += texture.lift_m;
  if (!(h.height_m > 0.0)) return {};
  return h;
}

}  // namespace asperity
