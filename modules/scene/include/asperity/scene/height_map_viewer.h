#pragma once

#include <array>
#include <cstddef>
#include <span>

#include <Eigen/Core>

#include "asperity/scene/scene.h"

namespace asperity {

struct HeightMapViewerConfig {
  double tile_mm = 10.0;
  double gap_mm = 2.0;
  int columns = 0;
  double stiffness_N_per_m = 400.0;
  double friction = 0.0;

  template <class V>
  void visit(V& v) {
    v.field("tile_mm", tile_mm, "side of a tile", {1e-3, 1e4});
    v.field("gap_mm", gap_mm, "of bare plane between tiles and round them", {0.0, 1e4});
    v.field("columns", columns, "tiles side by side; 0: as many as rows, or one more row", {0, 256});
    v.field("stiffness_N_per_m", stiffness_N_per_m, "of plane and tiles", {1e-3, 1e6});
    v.field("friction", friction, "coefficient", {0.0, 10.0});
  }
};

inline constexpr std::size_t kMostViewerTiles = 256;

// The haptic texture viewer (thesis §6.5, Fig. 38): square tiles on a plane, laid row by row from the upper left as
// seen from above (z up, y towards the top row), each with its texture over all of the tile, along x as the image's
// rows and with the image's first row on top. The plane is one mesh in metres, its lower left corner at the origin, its
// haptic coordinates in mm; texture k has index k + 1. To be rendered with TextureForceModel::kNormalPerturbation
// (Basdogan). Throws Error for no tile or more than kMostViewerTiles, and for a config out of range.
Scene make_height_map_viewer(std::span<const Texture> tiles, const HeightMapViewerConfig& config = {});

// The ends of a stroke over the viewer's tiles, on its plane in metres: over the middles of the first row from left to
// right, or of the only column from the top down. Throws Error as make_height_map_viewer does.
std::array<Eigen::Vector3d, 2> viewer_stroke_m(std::size_t tiles, const HeightMapViewerConfig& config = {});

}  // namespace asperity
