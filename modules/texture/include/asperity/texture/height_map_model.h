#pragma once

#include "asperity/texture/height_map.h"
#include "asperity/texture/texture_model_traits.h"

namespace asperity {

struct MakeHeightMapConfig {
  int columns = 256;
  int rows = 256;
  int bits = 16;
  double length_mm = 0.0;
  double width_mm = 0.0;
  double seam_mm = 0.5;
  double range_mm = 0.0;
  Border border = Border::kPeriodic;

  template <class V>
  void visit(V& v) {
    v.field("columns", columns, "pixels along the scan path", {4, 8192});
    v.field("rows", rows, "pixels across it", {4, 8192});
    v.field("bits", bits, "8 or 16", {8, 16});
    v.field("length_mm", length_mm, "along x; 0: the model's period, else 10 mm", {0.0, 1e6});
    v.field("width_mm", width_mm, "along y; 0: pixels as wide as long", {0.0, 1e6});
    v.field("seam_mm", seam_mm, "length over which a tile's continuation is blended into its start", {0.0, 1e6});
    v.field("range_mm", range_mm, "height from black to white; 0: just what the heights need", {0.0, 1e6});
    v.choice("border", border, kBorderNames, "beyond the image");
  }
};

template <>
struct TextureModelTraits<HeightMap> {
  static constexpr std::string_view kName = "heightmap";
  static void read_block(const BlockInput& input, HeightMap& map);
  static std::string write_block(const HeightMap& map, BlockOutput& output);
  static Json describe(const HeightMap& map);
  static void scale(HeightMap& map, double factor);
  static void add_to(TextureHash& hash, const HeightMap& map);
  static void low_pass(HeightMap& map, double cutoff_cycles_per_mm);
  static std::size_t size_bytes(const HeightMap& map);

  static HeightAndGradient height(const HeightMap& map, double x_m, double y_m) noexcept;
  static double lowest_m(const HeightMap& map);
  static double highest_m(const HeightMap& map);
  static HeightPeriods periods_m(const HeightMap& map);
  static HeightWindow window(const HeightMap& map, std::size_t most_cells);
  static double highest_cycles_per_mm(const HeightMap& map);
  static void make_tables(const HeightMap& map, ServoTables& tables);
  static HeightAndGradient servo_height(const HeightMap& map, const ServoTables& tables, double x_m,
                                        double y_m) noexcept;

  struct FitOptions {
    MakeHeightMapConfig heightmap;

    template <class V>
    void visit(V& v) {
      v.group("heightmap", heightmap);
    }
  };
  static void fit(const TextureFitInput& input, const TextureFitOptions& options, FittedTexture& out);
};

// In the header, so that a servo step has no calls but those that it needs.
inline HeightAndGradient TextureModelTraits<HeightMap>::servo_height(const HeightMap& map, const ServoTables& tables,
                                                                     double x_m, double y_m) noexcept {
  return map_height(map, tables.grid, x_m, y_m);
}

}  // namespace asperity
