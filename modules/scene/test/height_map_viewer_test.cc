// The viewer's plane: its size, its tiles' places and their coordinates.
#include "asperity/scene/height_map_viewer.h"

#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/scene/write_scene.h"

namespace asperity {
namespace {

Texture tile(std::uint16_t level) {
  Texture texture;
  texture.model = HeightMap{8, 8, 1.25, 1.25, 0.0, 2.5e-3, 8, Border::kMirror, std::vector<std::uint16_t>(64, level)};
  return texture;
}

struct Place {
  int texture = -1;
  Eigen::Vector2d xy_mm = Eigen::Vector2d::Zero();
};

// The texture and its coordinates at a point of the plane, by going through all triangles.
Place at(const Scene& scene, double x_mm, double y_mm) {
  const MeshFile& mesh = scene.objects.front().mesh;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d& v = mesh.vertices[mesh.triangles[i][static_cast<std::size_t>(k)]];
      corners.col(k) << 1e3 * v.x(), 1e3 * v.y(), 1.0;
    }
    const Eigen::Vector3d w = corners.inverse() * Eigen::Vector3d(x_mm, y_mm, 1.0);
    if (w.minCoeff() < 0.0) continue;
    const HapticTriangle& h = mesh.haptic[i];
    return {h.texture, w[0] * h.xy_mm[0] + w[1] * h.xy_mm[1] + w[2] * h.xy_mm[2]};
  }
  return {-2, Eigen::Vector2d::Zero()};
}

TEST(HeightMapViewer, LaysFourTilesAsOneReadsThem) {
  const std::vector<Texture> tiles{tile(1), tile(2), tile(3), tile(4)};
  const Scene scene = make_height_map_viewer(tiles);
  ASSERT_EQ(scene.objects.size(), 1u);
  const SceneObject& object = scene.objects.front();
  EXPECT_EQ(object.textures.size(), 4u);
  EXPECT_EQ(std::get<HeightMap>(object.find_texture(3)->texture.model).level[0], 3);
  EXPECT_EQ(scene.stiffness_N_per_m, 400.0);
  double area_mm2 = 0.0;
  for (const Triangle& t : object.mesh.triangles) {
    const auto& v = object.mesh.vertices;
    const Eigen::Vector3d n = (v[t[1]] - v[t[0]]).cross(v[t[2]] - v[t[0]]);
    EXPECT_GT(n.z(), 0.0) << "its outside is up";
    area_mm2 += 0.5e6 * n.z();
  }
  EXPECT_NEAR(area_mm2, 26.0 * 26.0, 1e-9);
  // Two tiles of 10 mm a side with 2 mm about them: 2 to 12 and 14 to 24.
  EXPECT_EQ(at(scene, 7.0, 19.0).texture, 1);
  EXPECT_EQ(at(scene, 19.0, 19.0).texture, 2);
  EXPECT_EQ(at(scene, 7.0, 7.0).texture, 3);
  EXPECT_EQ(at(scene, 19.0, 7.0).texture, 4);
  for (const auto& [x_mm, y_mm] : {std::pair{1.0, 7.0}, {13.0, 7.0}, {7.0, 13.0}, {25.0, 25.0}})
    EXPECT_EQ(at(scene, x_mm, y_mm).texture, -1);
  EXPECT_EQ(at(scene, 27.0, 1.0).texture, -2);
}

TEST(HeightMapViewer, ShowsAnImageUpright) {
  const Scene scene = make_height_map_viewer(std::vector<Texture>{tile(1)});
  // x along the rows, y from the top: 3 mm from the left and 1 mm from the top of the tile.
  EXPECT_NEAR((at(scene, 2.0 + 3.0, 12.0 - 1.0).xy_mm - Eigen::Vector2d(3.0, 1.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((at(scene, 2.0 + 9.0, 12.0 - 9.5).xy_mm - Eigen::Vector2d(9.0, 9.5)).norm(), 0.0, 1e-12);
}

TEST(HeightMapViewer, LeavesPlacesBareThatNoTextureIsFor) {
  HeightMapViewerConfig config;
  config.columns = 3;
  config.gap_mm = 0.0;
  const std::vector<Texture> tiles(5, tile(1));
  const Scene scene = make_height_map_viewer(tiles, config);
  EXPECT_EQ(scene.objects.front().mesh.triangles.size(), 12u);
  EXPECT_EQ(at(scene, 25.0, 15.0).texture, 3);
  EXPECT_EQ(at(scene, 15.0, 5.0).texture, 5);
  EXPECT_EQ(at(scene, 25.0, 5.0).texture, -1);
}

TEST(HeightMapViewer, IsASceneLikeAnyOther) {
  const auto files = format_scene_files("viewer.scene.json", make_height_map_viewer(std::vector<Texture>(4, tile(9))));
  std::set<std::string> names;
  for (const SceneFile& file : files) names.insert(file.name);
  EXPECT_TRUE(names.count("tiles.obj") == 1 && names.count("tile4.texture.json") == 1);
}

TEST(HeightMapViewer, RefusesWhatItCannotLay) {
  EXPECT_THROW(make_height_map_viewer({}), Error);
  EXPECT_THROW(make_height_map_viewer(std::vector<Texture>(kMostViewerTiles + 1, tile(1))), Error);
  HeightMapViewerConfig config;
  config.tile_mm = 0.0;
  EXPECT_THROW(make_height_map_viewer(std::vector<Texture>{tile(1)}, config), Error);
  config.tile_mm = std::nan("");
  EXPECT_THROW(make_height_map_viewer(std::vector<Texture>{tile(1)}, config), Error);
}

TEST(HeightMapViewer, ItsStrokeGoesOverAllTilesOfARow) {
  HeightMapViewerConfig config;
  config.columns = 3;
  const std::vector<Texture> tiles(5, tile(1));
  const Scene scene = make_height_map_viewer(tiles, config);
  const auto [from_m, to_m] = viewer_stroke_m(tiles.size(), config);
  std::set<int> met;
  for (int i = 0; i <= 1000; ++i) {
    const Eigen::Vector3d p_m = from_m + i / 1000.0 * (to_m - from_m);
    met.insert(at(scene, 1e3 * p_m.x(), 1e3 * p_m.y()).texture);
  }
  EXPECT_EQ(met, (std::set<int>{-1, 1, 2, 3}));
  EXPECT_NEAR((to_m - from_m).x(), 34e-3, 1e-12) << "three tiles and the two gaps between them";
  EXPECT_EQ((to_m - from_m).y(), 0.0);
  config.columns = 1;
  const auto [top_m, bottom_m] = viewer_stroke_m(2, config);
  EXPECT_EQ(top_m.x(), 7e-3);
  EXPECT_EQ(top_m.x(), bottom_m.x());
  EXPECT_NEAR((top_m - bottom_m).y(), 22e-3, 1e-12);
  EXPECT_THROW(viewer_stroke_m(0, config), Error);
}

}  // namespace
}  // namespace asperity
