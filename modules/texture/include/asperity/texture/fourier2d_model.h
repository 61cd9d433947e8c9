#pragma once

#include "asperity/texture/fit_fourier2d.h"
#include "asperity/texture/fourier2d.h"
#include "asperity/texture/texture_model_traits.h"

namespace asperity {

template <>
struct TextureModelTraits<Fourier2d> {
  static constexpr std::string_view kName = "fourier2d";
  static void read_block(const BlockInput& input, Fourier2d& t);
  static std::string write_block(const Fourier2d& t, BlockOutput& output);
  static Json describe(const Fourier2d& t);
  static void scale(Fourier2d& t, double factor);
  static void add_to(TextureHash& hash, const Fourier2d& t);
  static void low_pass(Fourier2d& t, double cutoff_cycles_per_mm);
  static bool reseed(Fourier2d& t, std::int64_t seed);

  static constexpr bool kIsSynthetic = true;
  static HeightAndGradient height(const Fourier2d& t, double x_m, double y_m) noexcept;
  static double lowest_m(const Fourier2d& t);
  static double highest_m(const Fourier2d& t);
  static HeightPeriods periods_m(const Fourier2d& t);
  static HeightWindow window(const Fourier2d& t, std::size_t most_cells);
  static double highest_cycles_per_mm(const Fourier2d& t);
  static void make_tables(const Fourier2d& t, ServoTables& tables);
  static HeightAndGradient servo_height(const Fourier2d& t, const ServoTables& tables, double x_m, double y_m) noexcept;

  struct FitOptions {
    FitFourier2dConfig fourier2d;

    template <class V>
    void visit(V& v) {
      v.group("fourier2d", fourier2d);
    }
  };
  static void fit(const TextureFitInput& input, const TextureFitOptions& options, FittedTexture& out);
};

// In the header, so that a servo step has no calls but those that it needs.
inline HeightAndGradient TextureModelTraits<Fourier2d>::servo_height(const Fourier2d& t, const ServoTables& tables,
                                                                     double x_m, double y_m) noexcept {
  if (!tables.x_table.cells.empty()) {
    const HeightAndSlope x = table_height(tables.x_table, x_m);
    const HeightAndSlope y = table_height(tables.y_table, y_m);
    return {t.offset_m + t.scale_per_m * (x.height_m * y.height_m), t.scale_per_m * (x.slope * y.height_m),
            t.scale_per_m * (x.height_m * y.slope)};
  }
  if (t.kind == Fourier2dKind::kIsotropic) return spline_height(t.grid, tables.grid, x_m, y_m);
  return height(t, x_m, y_m);
}

}  // namespace asperity
