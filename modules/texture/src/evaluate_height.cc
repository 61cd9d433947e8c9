#include "asperity/texture/evaluate_height.h"

#include <limits>
#include <string>
#include <variant>

#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "asperity/texture/evaluate_fourier1d.h"
#include "asperity/texture/evaluate_fourier2d.h"
#include "asperity/texture/evaluate_height_map.h"
#include "asperity/texture/evaluate_spline_grid.h"

namespace asperity {
namespace {

HeightAndGradient height_at(const Fourier1d& f, double x_m, double) noexcept {
  const HeightAndSlope h = evaluate(f, x_m);
  return {h.height_m, h.slope, 0.0};
}

HeightAndGradient height_at(const Fourier2d& f, double x_m, double y_m) noexcept { return evaluate(f, x_m, y_m); }
HeightAndGradient height_at(const HeightMap& map, double x_m, double y_m) noexcept { return evaluate(map, x_m, y_m); }
HeightAndGradient height_at(const ArealTexture& t, double x_m, double y_m) noexcept {
  return evaluate(t.surface, x_m, y_m);
}

double lowest_of(const Fourier1d& f) { return lowest_height_m(f); }
double lowest_of(const Fourier2d& f) { return lowest_height_m(f); }
double lowest_of(const HeightMap& map) { return lowest_height_m(map); }
double lowest_of(const ArealTexture& t) { return lowest_height_m(t.surface); }

std::optional<double> period_of(const Fourier1d& f) { return f.length_mm * 1e-3; }
std::optional<double> period_of(const Fourier2d& f) {
  return 1e-3 * (f.kind == Fourier2dKind::kIsotropic ? f.isotropic.length_mm : f.x.length_mm);
}
std::optional<double> period_of(const HeightMap& map) {
  if (map.border != Border::kPeriodic) return std::nullopt;
  return 1e-3 * map.mm_per_px_x * static_cast<double>(map.columns);
}
std::optional<double> period_of(const ArealTexture& t) {
  if (t.surface.border != Border::kPeriodic) return std::nullopt;
  return t.surface.spacing_x_m * static_cast<double>(t.surface.columns);
}

template <class Model>
concept HeightField = requires(const Model& model) {
  height_at(model, 0.0, 0.0);
};

}  // namespace

bool is_height_field(const TextureModel& model) noexcept {
  return std::visit([]<class Model>(const Model&) { return HeightField<Model>; }, model);
}

HeightAndGradient evaluate_height(const TextureModel& model, double x_m, double y_m) noexcept {
  return std::visit(
      [&]<class Model>(const Model& m) -> HeightAndGradient {
        if constexpr (HeightField<Model>) return height_at(m, x_m, y_m);
        return {kNan, kNan, kNan};
      },
      model);
}

double lowest_height_m(const TextureModel& model) {
  return std::visit(
      [&]<class Model>(const Model& m) -> double {
        if constexpr (HeightField<Model>) return lowest_of(m);
        throw Error("texture: the model " + std::string(kTextureModelNames[model.index()]) + " has no heights");
      },
      model);
}

double lift_m(const TextureModel& model) { return -lowest_height_m(model); }

std::optional<double> period_m(const TextureModel& model) {
  return std::visit(
      []<class Model>(const Model& m) -> std::optional<double> {
        if constexpr (HeightField<Model>) return period_of(m);
        return std::nullopt;
      },
      model);
}

}  // namespace asperity
