#include "asperity/scene/height_map_viewer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {
namespace {

void check_length(const char* what, double value, bool zero_too) {
  if (!std::isfinite(value) || !(zero_too ? value >= 0.0 : value > 0.0))
    throw Error(std::string("height-map viewer: ") + what + " of " + number_text(value));
}

// Lines across one axis: gap, tile, gap, …, tile, gap; without the gaps if they have no width.
struct Lines {
  std::vector<double> at_mm;
  std::vector<int> tile;  // of the strip after a line; -1: bare
};

Lines lines(int tiles, const HeightMapViewerConfig& config) {
  Lines result;
  double at_mm = 0.0;
  const auto strip = [&](int tile, double width_mm) {
    if (!(width_mm > 0.0)) return;
    result.at_mm.push_back(at_mm);
    result.tile.push_back(tile);
    at_mm += width_mm;
  };
  for (int k = 0; k < tiles; ++k) {
    strip(-1, config.gap_mm);
    strip(k, config.tile_mm);
  }
  strip(-1, config.gap_mm);
  result.at_mm.push_back(at_mm);
  return result;
}

// Two triangles of a square, their corners lower left, lower right, upper right and upper left.
void add_square(MeshFile& mesh, const std::array<std::uint32_t, 4>& corner, int texture, double side_mm) {
  // The image's first row is the upper side: y runs down the square.
  const std::array<Eigen::Vector2d, 4> xy_mm{Eigen::Vector2d(0.0, side_mm), Eigen::Vector2d(side_mm, side_mm),
                                             Eigen::Vector2d(side_mm, 0.0), Eigen::Vector2d(0.0, 0.0)};
  for (const std::array<std::size_t, 3>& t : {std::array<std::size_t, 3>{0, 1, 2}, {0, 2, 3}}) {
    mesh.triangles.push_back({corner[t[0]], corner[t[1]], corner[t[2]]});
    HapticTriangle haptic;
    haptic.texture = texture;
    if (texture >= 0) haptic.xy_mm = {xy_mm[t[0]], xy_mm[t[1]], xy_mm[t[2]]};
    mesh.haptic.push_back(haptic);
  }
}

// Tiles side by side and one above the other.
struct Grid {
  int columns, rows;
};

Grid grid_of(std::size_t tiles, const HeightMapViewerConfig& config) {
  if (tiles == 0 || tiles > kMostViewerTiles) {
    throw Error("height-map viewer: " + std::to_string(tiles) + " tiles; 1 to " + std::to_string(kMostViewerTiles) +
                " are possible");
  }
  check_length("tiles with a side in mm", config.tile_mm, false);
  check_length("a gap in mm", config.gap_mm, true);
  check_length("a stiffness in N/m", config.stiffness_N_per_m, false);
  check_length("a friction", config.friction, true);
  const int count = static_cast<int>(tiles);
  if (config.columns < 0) throw Error("height-map viewer: " + std::to_string(config.columns) + " columns");
  const int wanted =
      config.columns > 0 ? config.columns : static_cast<int>(std::floor(std::sqrt(static_cast<double>(count))));
  const int columns = std::min(wanted, count);
  return {columns, (count + columns - 1) / columns};
}

}  // namespace

Scene make_height_map_viewer(std::span<const Texture> tiles, const HeightMapViewerConfig& config) {
  const auto [columns, rows] = grid_of(tiles.size(), config);
  const int count = static_cast<int>(tiles.size());
  SceneObject object;
  object.mesh_file = "tiles.obj";
  const Lines x = lines(columns, config);
  const Lines y = lines(rows, config);
  for (const double y_mm : y.at_mm) {
    for (const double x_mm : x.at_mm) object.mesh.vertices.emplace_back(1e-3 * x_mm, 1e-3 * y_mm, 0.0);
  }
  const auto width = static_cast<std::uint32_t>(x.at_mm.size());
  for (std::uint32_t r = 0; r < y.tile.size(); ++r) {
    for (std::uint32_t c = 0; c < x.tile.size(); ++c) {
      const std::uint32_t first = r * width + c;
      const int row_from_top = rows - 1 - y.tile[r];
      const bool bare = x.tile[c] < 0 || y.tile[r] < 0;
      const int tile = bare ? count : row_from_top * columns + x.tile[c];
      add_square(object.mesh, {first, first + 1, first + width + 1, first + width}, tile < count ? tile + 1 : -1,
                 config.tile_mm);
    }
  }
  for (int k = 0; k < count; ++k) {
    object.textures.push_back(
        {k + 1, "tile" + std::to_string(k + 1) + ".texture.json", tiles[static_cast<std::size_t>(k)]});
  }
  Scene scene;
  scene.objects.push_back(std::move(object));
  scene.stiffness_N_per_m = config.stiffness_N_per_m;
  scene.friction = config.friction;
  return scene;
}

std::array<Eigen::Vector3d, 2> viewer_stroke_m(std::size_t tiles, const HeightMapViewerConfig& config) {
  const auto [columns, rows] = grid_of(tiles, config);
  const auto low_mm = [&](int k) { return config.gap_mm + k * (config.tile_mm + config.gap_mm); };
  const auto point_m = [](double x_mm, double y_mm) -> Eigen::Vector3d { return {1e-3 * x_mm, 1e-3 * y_mm, 0.0}; };
  if (columns == 1) {
    const double x_mm = low_mm(0) + 0.5 * config.tile_mm;
    return {point_m(x_mm, low_mm(rows - 1) + config.tile_mm), point_m(x_mm, low_mm(0))};
  }
  const double y_mm = low_mm(rows - 1) + 0.5 * config.tile_mm;
  return {point_m(low_mm(0), y_mm), point_m(low_mm(columns - 1) + config.tile_mm, y_mm)};
}

}  // namespace asperity
