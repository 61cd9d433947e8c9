#pragma once

#include "asperity/texture/texture_model_traits.h"

namespace asperity {

// A height along x that rises and falls in straight lines, between 0 and height_m: an example of a new texture model.
struct TriangleWave {
  double length_mm = 1.0;
  double height_m = 1e-5;
};

template <>
struct TextureModelTraits<TriangleWave> {
  static constexpr std::string_view kName = "triangle_wave";
  static void read_block(const BlockInput& input, TriangleWave& t);
  static std::string write_block(const TriangleWave& t, BlockOutput& output);
  static Json describe(const TriangleWave& t);
  static void scale(TriangleWave& t, double factor);
  static void add_to(TextureHash& hash, const TriangleWave& t);

  static HeightAndGradient height(const TriangleWave& t, double x_m, double y_m) noexcept;
  static double lowest_m(const TriangleWave& t);
  static double highest_m(const TriangleWave& t);
  static HeightPeriods periods_m(const TriangleWave& t);
  static HeightWindow window(const TriangleWave& t, std::size_t most_cells);
  static double highest_cycles_per_mm(const TriangleWave& t);
  static double length_mm(const TriangleWave& t);

  struct FitOptions {
    double length_mm = 1.0;

    template <class V>
    void visit(V& v) {
      v.field("triangle_wave.length_mm", length_mm, "of a period", {1e-6, 1e6});
    }
  };
  static void fit(const TextureFitInput& input, const TextureFitOptions& options, FittedTexture& out);
};

}  // namespace asperity
