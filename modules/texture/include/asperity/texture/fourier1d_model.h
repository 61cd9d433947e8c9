#pragma once

#include "asperity/texture/fit_fourier1d.h"
#include "asperity/texture/fit_fourier1d_samples.h"
#include "asperity/texture/fourier1d.h"
#include "asperity/texture/texture_model_traits.h"

namespace asperity {

template <>
struct TextureModelTraits<Fourier1d> {
  static constexpr std::string_view kName = "fourier1d";
  static void read_block(const BlockInput& input, Fourier1d& f);
  static std::string write_block(const Fourier1d& f, BlockOutput& output);
  static Json describe(const Fourier1d& f);
  static void scale(Fourier1d& f, double factor);
  static void add_to(TextureHash& hash, const Fourier1d& f);
  static void low_pass(Fourier1d& f, double cutoff_cycles_per_mm);

  static HeightAndGradient height(const Fourier1d& f, double x_m, double y_m) noexcept;
  static double lowest_m(const Fourier1d& f);
  static double highest_m(const Fourier1d& f);
  static HeightPeriods periods_m(const Fourier1d& f);
  static HeightWindow window(const Fourier1d& f, std::size_t most_cells);
  static double highest_cycles_per_mm(const Fourier1d& f);
  static double length_mm(const Fourier1d& f);
  static void make_tables(const Fourier1d& f, ServoTables& tables);
  static HeightAndGradient servo_height(const Fourier1d& f, const ServoTables& tables, double x_m, double y_m) noexcept;

  struct FitOptions {
    FitFourier1dConfig fourier1d;
    FitFourier1dPathConfig path;

    template <class V>
    void visit(V& v) {
      v.group("fourier1d", fourier1d);
      v.group("path", path);
    }
  };
  static void fit(const TextureFitInput& input, const TextureFitOptions& options, FittedTexture& out);
};

// In the header, so that a servo step has no calls but those that it needs.
inline HeightAndGradient TextureModelTraits<Fourier1d>::servo_height(const Fourier1d& f, const ServoTables& tables,
                                                                     double x_m, double y_m) noexcept {
  if (tables.x_table.cells.empty()) return height(f, x_m, y_m);
  const HeightAndSlope h = table_height(tables.x_table, x_m);
  return {h.height_m, h.slope, 0.0};
}

// A profile or several as a series, as `texture fit` makes it: of the best window, or of the whole path.
Fourier1d fit_series(const TextureFitInput& input, const std::vector<std::string>& files,
                     const TextureFitOptions& options, FittedTexture& out);

}  // namespace asperity
