#include "asperity/texture/evaluate_height.h"

#include <limits>
#include <string>
#include <type_traits>
#include <variant>

#include "asperity/base/error.h"
#include "asperity/base/nan.h"

namespace asperity {
namespace {

template <class Model>
using ModelTraits = TextureModelTraits<Model>;

[[noreturn]] void no_heights(const TextureModel& model) {
  throw Error("texture: the model " + std::string(kTextureModelNames[model.index()]) + " has no heights");
}

}  // namespace

bool is_height_field(const TextureModel& model) noexcept {
  return std::visit([]<class Model>(const Model&) { return HeightField<Model>; }, model);
}

HeightAndGradient evaluate_height(const TextureModel& model, double x_m, double y_m) noexcept {
  return std::visit(
      [&]<class Model>(const Model& m) -> HeightAndGradient {
        if constexpr (HeightField<Model>) return ModelTraits<Model>::height(m, x_m, y_m);
        return {kNan, kNan, kNan};
      },
      model);
}

double lowest_height_m(const TextureModel& model) {
  return std::visit(
      [&]<class Model>(const Model& m) -> double {
        if constexpr (HeightField<Model>) return ModelTraits<Model>::lowest_m(m);
        no_heights(model);
      },
      model);
}

double highest_height_m(const TextureModel& model) {
  return std::visit(
      [&]<class Model>(const Model& m) -> double {
        if constexpr (HeightField<Model>) return ModelTraits<Model>::highest_m(m);
        no_heights(model);
      },
      model);
}

double height_offset_m(const TextureModel& model) { return -lowest_height_m(model); }

HeightPeriods height_periods_m(const TextureModel& model) {
  return std::visit(
      []<class Model>(const Model& m) -> HeightPeriods {
        if constexpr (HeightField<Model>) return ModelTraits<Model>::periods_m(m);
        return {};
      },
      model);
}

std::optional<double> period_m(const TextureModel& model) {
  const double period_m = height_periods_m(model).x_m;
  return period_m == HeightPeriods::kNever ? std::nullopt : std::optional(period_m);
}

std::optional<double> line_length_mm(const TextureModel& model) {
  return std::visit(
      []<class Model>(const Model& m) -> std::optional<double> {
        if constexpr (LineModel<Model>) return ModelTraits<Model>::length_mm(m);
        return std::nullopt;
      },
      model);
}

std::optional<HeightWindow> height_window(const TextureModel& model, std::size_t most_cells) {
  return std::visit(
      [&]<class Model>(const Model& m) -> std::optional<HeightWindow> {
        if constexpr (HeightField<Model>) return ModelTraits<Model>::window(m, most_cells);
        return std::nullopt;
      },
      model);
}

MeasuredArea measured_area(const TextureModel& model) {
  return std::visit(
      [&]<class Model>(const Model& m) -> MeasuredArea {
        if constexpr (requires { ModelTraits<Model>::measured_area(m); }) return ModelTraits<Model>::measured_area(m);
        return {0.0, 0.0, LineModel<Model> ? 0.0 : period_m(model).value_or(0.01)};
      },
      model);
}

bool is_synthetic(const TextureModel& model) noexcept {
  return std::visit(
      []<class Model>(const Model&) {
        if constexpr (requires { ModelTraits<Model>::kIsSynthetic; })
          return ModelTraits<Model>::kIsSynthetic;
        else
          return false;
      },
      model);
}

double highest_cycles_per_mm(const TextureModel& model) {
  return std::visit(
      []<class Model>(const Model& m) -> double {
        if constexpr (HeightField<Model>) return ModelTraits<Model>::highest_cycles_per_mm(m);
        return std::numeric_limits<double>::infinity();
      },
      model);
}

double highest_cycles_per_mm(const Texture& texture) {
  return texture.band_cycles_per_mm ? (*texture.band_cycles_per_mm)[1] : highest_cycles_per_mm(texture.model);
}

ServoTables make_servo_tables(const TextureModel& model) {
  ServoTables tables;
  std::visit(
      [&]<class Model>(const Model& m) {
        if constexpr (requires { ModelTraits<Model>::make_tables(m, tables); })
          ModelTraits<Model>::make_tables(m, tables);
      },
      model);
  return tables;
}

}  // namespace asperity
