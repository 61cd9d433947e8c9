#include "asperity/texture/areal_model.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "asperity/texture/evaluate_spline_grid.h"
#include "asperity/texture/sample_heights.h"
#include "asperity/texture/texture_fit.h"
#include "low_pass_grid.h"
#include "spline_grid_model.h"

namespace asperity {

using ArealTraits = TextureModelTraits<ArealTexture>;

Json ArealTraits::describe(const ArealTexture& t) {
  std::size_t supported = 0;
  for (const auto flag : t.supported) supported += flag;
  Json out{{"columns", t.surface.columns},
           {"rows", t.surface.rows},
           {"spacing_m", {t.surface.spacing_x_m, t.surface.spacing_y_m}},
           {"supported_part", static_cast<double>(supported) / static_cast<double>(t.supported.size())},
           {"border", kBorderNames.at(static_cast<std::size_t>(t.surface.border))}};
  if (!t.sigma_m.empty() && supported > 0) {
    double square = 0.0;
    for (std::size_t i = 0; i < t.sigma_m.size(); ++i)
      square += t.supported[i] != 0 ? t.sigma_m[i] * t.sigma_m[i] : 0.0;
    out["sigma_rms_m"] = std::sqrt(square / static_cast<double>(supported));
  }
  return out;
}

void ArealTraits::scale(ArealTexture& t, double factor) {
  for (double& c : t.surface.coefficient_m) c *= factor;
  for (double& sigma : t.sigma_m) sigma *= std::abs(factor);
}

void ArealTraits::add_to(TextureHash& hash, const ArealTexture& t) { add_grid_to(hash, t.surface); }

void ArealTraits::low_pass(ArealTexture& t, double cutoff_cycles_per_mm) {
  SplineGrid& grid = t.surface;
  low_pass_grid(grid.coefficient_m, grid.columns, grid.rows, grid.border, cutoff_cycles_per_mm * 1e3 * grid.spacing_x_m,
                cutoff_cycles_per_mm * 1e3 * grid.spacing_y_m);
}

std::size_t ArealTraits::size_bytes(const ArealTexture& t) {
  return t.surface.coefficient_m.size() * (sizeof(double) + 1) + t.sigma_m.size() * sizeof(double);
}

HeightAndGradient ArealTraits::height(const ArealTexture& t, double x_m, double y_m) noexcept {
  return evaluate_height(t.surface, x_m, y_m);
}

double ArealTraits::lowest_m(const ArealTexture& t) { return lowest_height_m(t.surface); }

double ArealTraits::highest_m(const ArealTexture& t) {
  SplineGrid upside_down = t.surface;
  for (double& c : upside_down.coefficient_m) c = -c;
  return -lowest_height_m(upside_down);
}

HeightPeriods ArealTraits::periods_m(const ArealTexture& t) {
  if (t.surface.border != Border::kPeriodic) return {};
  return {t.surface.spacing_x_m * static_cast<double>(t.surface.columns),
          t.surface.spacing_y_m * static_cast<double>(t.surface.rows)};
}

HeightWindow ArealTraits::window(const ArealTexture& t, std::size_t most_cells) {
  const SplineGrid& grid = t.surface;
  HeightWindow out;
  out.columns = std::min(grid.columns, most_cells);
  out.rows = std::min(grid.rows, most_cells);
  out.x_m = grid.origin_x_m;
  out.y_m = grid.origin_y_m;
  out.length_m = static_cast<double>(out.columns) * grid.spacing_x_m;
  out.width_m = static_cast<double>(out.rows) * grid.spacing_y_m;
  return out;
}

double ArealTraits::highest_cycles_per_mm(const ArealTexture& t) {
  return 0.5e-3 / std::min(t.surface.spacing_x_m, t.surface.spacing_y_m);
}

MeasuredArea ArealTraits::measured_area(const ArealTexture& t) {
  const SplineGrid& g = t.surface;
  return {g.origin_x_m + 2.0 * g.spacing_x_m, g.origin_y_m + 2.0 * g.spacing_y_m,
          std::max(0.0, static_cast<double>(g.rows) - 4.0) * g.spacing_y_m};
}

void ArealTraits::make_tables(const ArealTexture& t, ServoTables& tables) { tables.grid = grid_scale(t.surface); }

void ArealTraits::fit(const TextureFitInput& input, const TextureFitOptions& options, FittedTexture& out) {
  const auto samples = input.read_areal_samples(input.files);
  ArealFit fit = fit_areal(samples, options.of<ArealTexture>().areal, input.observer);
  out.report["samples"] = samples.size();
  out.report["rms_height_m"] = fit.rms_height_m;
  out.report["rms_error_m"] = fit.rms_error_m;
  out.report["supported_part"] = fit.supported_part;
  out.report["relative_residual"] = fit.relative_residual;
  out.add_problems(fit.problems);
  const SplineGrid& grid = fit.texture.surface;
  const double spacing_m = std::max(grid.spacing_x_m, grid.spacing_y_m);
  const double length_m = static_cast<double>(grid.columns - 4) * grid.spacing_x_m;
  const double step_m = std::min(0.25 * grid.spacing_x_m, length_m / 64.0);
  out.texture.model = std::move(fit.texture);
  out.texture.roughness = input.roughness(sample_lines(out.texture.model, length_m, step_m), step_m);
  out.texture.band_cycles_per_mm = {0.0, 0.5e-3 / spacing_m};
}

}  // namespace asperity
