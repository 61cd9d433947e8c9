#pragma once

#include "asperity/texture/texture_model_traits.h"

namespace asperity {

// Ridges across the scan path: h = height · (1 − cos(2π x / pitch)) / 2. Plain data.
struct Ridges {
  double pitch_m = 2e-3;
  double height_m = 0.1e-3;
};

struct FitRidgesConfig {
  double pitch_mm = 2.0;

  template <class V>
  void visit(V& v) {
    v.field("pitch_mm", pitch_mm, "of the ridges", {1e-3, 1e3});
  }
};

template <>
struct TextureModelTraits<Ridges> {
  static constexpr std::string_view kName = "ridges";
  static void read_block(const BlockInput& input, Ridges& r);
  static std::string write_block(const Ridges& r, BlockOutput& output);
  static NamedValues describe(const Ridges& r);
  static void scale(Ridges& r, double factor) { r.height_m *= factor; }
  static void add_to(TextureHash& hash, const Ridges& r);

  static HeightAndGradient height(const Ridges& r, double x_m, double y_m) noexcept;
  static double lowest_m(const Ridges&) { return 0.0; }
  static double highest_m(const Ridges& r) { return r.height_m; }
  static HeightPeriods periods_m(const Ridges& r) { return {r.pitch_m, 0.0}; }
  static HeightWindow window(const Ridges& r, std::size_t most_cells);
  static double highest_cycles_per_mm(const Ridges& r) { return 1e-3 / r.pitch_m; }
  static double length_mm(const Ridges& r) { return 1e3 * r.pitch_m; }

  struct FitOptions {
    FitRidgesConfig ridges;

    template <class V>
    void visit(V& v) {
      v.group("ridges", ridges);
    }
  };
  static void fit(const TextureFitInput& input, const TextureFitOptions& options, FittedTexture& out);
};

}  // namespace asperity
