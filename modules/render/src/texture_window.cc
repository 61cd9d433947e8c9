#include "texture_window.h"

#include <algorithm>
#include <variant>

#include "asperity/texture/evaluate_height.h"

namespace asperity {
namespace {

std::size_t cells_of(const Fourier1d& f) { return 4 * std::max<std::size_t>(f.a_m.size(), 1); }

}  // namespace

TextureWindow texture_window(const TextureModel& model, std::size_t most_cells) {
  TextureWindow out;
  if (const auto period = period_m(model)) out.length_m = out.width_m = *period;
  if (const auto* f = std::get_if<Fourier1d>(&model)) {
    out.columns = cells_of(*f);
  } else if (const auto* product = std::get_if<Fourier2d>(&model); product != nullptr) {
    if (product->kind != Fourier2dKind::kIsotropic) {
      out.width_m = 1e-3 * product->y.length_mm;
      out.columns = cells_of(product->x);
      out.rows = cells_of(product->y);
    } else {
      out.columns = product->grid.columns;
      out.rows = product->grid.rows;
    }
  } else if (const auto* map = std::get_if<HeightMap>(&model)) {
    out.columns = std::min(map->columns, most_cells);
    out.rows = std::min(map->rows, most_cells);
    out.length_m = static_cast<double>(out.columns) * 1e-3 * map->mm_per_px_x;
    out.width_m = static_cast<double>(out.rows) * 1e-3 * map->mm_per_px_y;
  } else if (const auto* areal = std::get_if<ArealTexture>(&model)) {
    const SplineGrid& grid = areal->surface;
    out.columns = std::min(grid.columns, most_cells);
    out.rows = std::min(grid.rows, most_cells);
    out.x_m = grid.origin_x_m;
    out.y_m = grid.origin_y_m;
    out.length_m = static_cast<double>(out.columns) * grid.spacing_x_m;
    out.width_m = static_cast<double>(out.rows) * grid.spacing_y_m;
  }
  return out;
}

}  // namespace asperity
