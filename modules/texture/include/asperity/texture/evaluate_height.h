#pragma once

#include <optional>
#include <variant>

#include "asperity/base/nan.h"
#include "asperity/texture/height_and_gradient.h"
#include "asperity/texture/texture.h"

namespace asperity {

// True for the models that are heights over a plane; the others are forces in time.
bool is_height_field(const TextureModel& model) noexcept;

// A height field and its gradient, x_m along the scan path and y_m across it; a model of x alone is the same
// for every y. Without the texture's height offset. nan for a model that is not a height field. Does not allocate.
// Realtime-safe: yes, thread-safe: yes.
HeightAndGradient evaluate_height(const TextureModel& model, double x_m, double y_m) noexcept;

// The lowest and the highest point of a height field, and what must be added for the lowest to lie on the geometric
// surface (erratum 20). Throw Error for a model that is not a height field.
double lowest_height_m(const TextureModel& model);
double highest_height_m(const TextureModel& model);
double height_offset_m(const TextureModel& model);

// The length along x, in metres, after which the model repeats; nullopt for one that does not.
std::optional<double> period_m(const TextureModel& model);
// The same of x and y; never for a model that is not a height field.
HeightPeriods height_periods_m(const TextureModel& model);

// The period of a model of x alone; nullopt for all others.
std::optional<double> line_length_mm(const TextureModel& model);

// Where a height field shows all that it has, in at most `most_cells` cells along each direction of an image or a
// grid; nullopt for a model that is not a height field.
std::optional<HeightWindow> height_window(const TextureModel& model, std::size_t most_cells);

// Where the lines lie along which its roughness is measured; a model of x alone has one line.
MeasuredArea measured_area(const TextureModel& model);

// True for a height field whose places are not those of the surface that it was made from.
bool is_synthetic(const TextureModel& model) noexcept;

// The highest spatial frequency that a texture may hold: its stated band's end, else what its model can represent;
// infinite for a series, which has no heights.
double highest_cycles_per_mm(const Texture& texture);
double highest_cycles_per_mm(const TextureModel& model);

// What a height field is evaluated by on the servo thread; empty tables for a model that needs none.
ServoTables make_servo_tables(const TextureModel& model);

// evaluate_height() by means of its tables: a Fourier series is within 1e-6 of its RMS height and 1e-4 of its RMS slope
// of the exact sum, a product of two likewise; images and splines are the same to rounding. Realtime-safe: yes.
inline HeightAndGradient servo_height(const TextureModel& model, const ServoTables& tables, double x_m,
                                      double y_m) noexcept {
  return std::visit(
      [&]<class Model>(const Model& m) -> HeightAndGradient {
        if constexpr (requires { TextureModelTraits<Model>::servo_height(m, tables, x_m, y_m); })
          return TextureModelTraits<Model>::servo_height(m, tables, x_m, y_m);
        else if constexpr (HeightField<Model>)
          return TextureModelTraits<Model>::height(m, x_m, y_m);
        else
          return {kNan, kNan, kNan};
      },
      model);
}

}  // namespace asperity
