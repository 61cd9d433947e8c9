#pragma once

#include "asperity/texture/areal_texture.h"
#include "asperity/texture/fit_areal.h"
#include "asperity/texture/texture_model_traits.h"

namespace asperity {

template <>
struct TextureModelTraits<ArealTexture> {
  static constexpr std::string_view kName = "areal";
  static void read_block(const BlockInput& input, ArealTexture& t);
  static std::string write_block(const ArealTexture& t, BlockOutput& output);
  static Json describe(const ArealTexture& t);
  static void scale(ArealTexture& t, double factor);
  static void add_to(TextureHash& hash, const ArealTexture& t);
  static void low_pass(ArealTexture& t, double cutoff_cycles_per_mm);
  static std::size_t size_bytes(const ArealTexture& t);

  static HeightAndGradient height(const ArealTexture& t, double x_m, double y_m) noexcept;
  static double lowest_m(const ArealTexture& t);
  static double highest_m(const ArealTexture& t);
  static HeightPeriods periods_m(const ArealTexture& t);
  static HeightWindow window(const ArealTexture& t, std::size_t most_cells);
  static double highest_cycles_per_mm(const ArealTexture& t);
  static MeasuredArea measured_area(const ArealTexture& t);
  static void make_tables(const ArealTexture& t, ServoTables& tables);
  static HeightAndGradient servo_height(const ArealTexture& t, const ServoTables& tables, double x_m,
                                        double y_m) noexcept;

  struct FitOptions {
    FitArealConfig areal;

    template <class V>
    void visit(V& v) {
      v.group("areal", areal);
    }
  };
  static void fit(const TextureFitInput& input, const TextureFitOptions& options, FittedTexture& out);
};

// In the header, so that a servo step has no calls but those that it needs.
inline HeightAndGradient TextureModelTraits<ArealTexture>::servo_height(const ArealTexture& t,
                                                                        const ServoTables& tables, double x_m,
                                                                        double y_m) noexcept {
  return spline_height(t.surface, tables.grid, x_m, y_m);
}

}  // namespace asperity
