// Textures over one another: order, what is covered, taking out, materials, and the files of all that.
#include "asperity/scene/lay_texture.h"

#include <cmath>
#include <limits>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/scene/covered_triangles.h"
#include "asperity/scene/paint.h"
#include "asperity/scene/read_scene.h"
#include "asperity/scene/scan_materials.h"
#include "asperity/scene/swap_texture.h"
#include "asperity/scene/write_scene.h"
#include "asperity/testkit/shape_meshes.h"
#include "asperity/testkit/temp_dir.h"

namespace asperity {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr std::uint64_t kLimit_bytes = 1 << 20;

SceneObject board() {
  SceneObject object;
  object.mesh_file = "plane.obj";
  object.unit_m = 1e-3;
  const TriangleMesh mesh = testkit::plane_mesh({60.0, 40.0}, 20, 14, 0.2, 6);  // millimetres
  object.mesh.vertices = mesh.vertices_m;
  object.mesh.triangles = mesh.triangles;
  return object;
}

SceneTexture laid(int index, int order, const std::string& scan = {}) {
  SceneTexture out;
  out.index = index;
  out.order = order;
  out.file = "t" + std::to_string(index) + ".texture.json";
  out.texture.model = Fourier1d{10.0, {1e-4}, {0.0}, 0.0};
  if (!scan.empty()) {
    out.origin.emplace();
    out.origin->kind = kScanOrigin;
    out.origin->name = scan;
  }
  return out;
}

std::vector<CoveredTriangle> claims(int texture, std::uint32_t first, std::uint32_t end) {
  std::vector<CoveredTriangle> out;
  for (std::uint32_t t = first; t < end; ++t) {
    out.push_back({t, {texture, {Vector2d(t, 1.0 / 3.0), Vector2d(texture, 0.1), Vector2d(-1.5, t)}}});
  }
  return out;
}

bool same(const std::vector<HapticTriangle>& a, const std::vector<HapticTriangle>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const HapticTriangle& x, const HapticTriangle& y) {
    return x.texture == y.texture && x.xy_mm == y.xy_mm;
  });
}

std::vector<int> textures_of(const SceneObject& object, std::uint32_t from, std::uint32_t to) {
  std::vector<int> out;
  for (std::uint32_t t = from; t < to; ++t) out.push_back(object.mesh.haptic[t].texture);
  return out;
}

TEST(LayTexture, TheGreaterOrderIsRenderedWhateverIsLaidFirst) {
  // An oracle that keeps whole lists: of each triangle the texture of the greatest order, of equals the last laid.
  std::mt19937 random(7);
  for (int run = 0; run < 30; ++run) {
    SceneObject object = board();
    std::vector<std::vector<std::pair<int, int>>> lists(object.mesh.triangles.size());  // order, texture
    for (int index = 1; index <= 6; ++index) {
      const int order = static_cast<int>(random() % 4) - 1;
      put_texture(object, laid(index, order));
      const auto first = static_cast<std::uint32_t>(random() % 200);
      const auto end = first + 50 + static_cast<std::uint32_t>(random() % 200);
      lay_triangles(object, claims(index, first, end));
      for (std::uint32_t t = first; t < end; ++t) lists[t].emplace_back(order, index);
    }
    const int gone = 1 + static_cast<int>(random() % 6);
    EXPECT_TRUE(take_out_texture(object, gone));
    for (std::size_t t = 0; t < lists.size(); ++t) {
      std::erase_if(lists[t], [gone](const auto& one) { return one.second == gone; });
      std::stable_sort(lists[t].begin(), lists[t].end(),
                       [](const auto& a, const auto& b) { return a.first < b.first; });
      EXPECT_EQ(object.mesh.haptic[t].texture, lists[t].empty() ? -1 : lists[t].back().second) << run << ": " << t;
    }
  }
}

TEST(LayTexture, TakenOutGivesBackWhatWasCovered) {
  SceneObject object = board();
  put_texture(object, laid(1, 0));
  lay_triangles(object, claims(1, 10, 200));
  const std::vector<HapticTriangle> before = object.mesh.haptic;
  put_texture(object, laid(2, further_order(object, LayAt::kOver)));
  const LaidTriangles over = lay_triangles(object, claims(2, 100, 300));
  EXPECT_EQ(over.over, 100u);
  EXPECT_EQ(over.under, 0u);
  EXPECT_EQ(object.covered.size(), 100u);
  EXPECT_EQ(object.covered_file, "covered.csv");
  put_texture(object, laid(5, further_order(object, LayAt::kUnder)));
  EXPECT_EQ(object.find_texture(5)->order, -1);
  EXPECT_EQ(lay_triangles(object, claims(5, 0, 400)).under, 290u);
  EXPECT_EQ(textures_of(object, 9, 11), (std::vector<int>{5, 1}));
  EXPECT_TRUE(take_out_texture(object, 2));
  EXPECT_TRUE(take_out_texture(object, 5));
  EXPECT_FALSE(take_out_texture(object, 5));
  EXPECT_TRUE(same(object.mesh.haptic, before));
  EXPECT_TRUE(object.covered.empty());
  EXPECT_TRUE(object.covered_file.empty());
}

TEST(LayTexture, TheSameTextureAgainReplacesItsCoordinates) {
  SceneObject object = board();
  put_texture(object, laid(1, 0));
  put_texture(object, laid(2, 1));
  lay_triangles(object, claims(1, 0, 20));
  lay_triangles(object, claims(2, 10, 30));
  lay_triangles(object, claims(1, 0, 20));
  EXPECT_EQ(object.covered.size(), 10u);
  EXPECT_EQ(textures_of(object, 9, 11), (std::vector<int>{1, 2}));
}

TEST(LayTexture, CoordinatesWithoutATextureHideNone) {
  SceneObject object = board();
  put_texture(object, laid(1, -3));
  lay_triangles(object, claims(1, 0, 20));
  lay_triangles(object, claims(9, 10, 30));
  EXPECT_EQ(textures_of(object, 19, 21), (std::vector<int>{1, 9}));
  EXPECT_EQ(further_order(board(), LayAt::kUnder), 0);
  EXPECT_EQ(free_texture_index(object), 10);
}

// A scene.json with an order beyond the furthest is refused: none may be written.
TEST(LayTexture, NoOrderIsBeyondTheFurthest) {
  SceneObject object = board();
  put_texture(object, laid(1, kFurthestOrder));
  EXPECT_THROW(further_order(object, LayAt::kOver), Error);
  EXPECT_EQ(further_order(object, LayAt::kUnder), kFurthestOrder - 1);
  put_texture(object, laid(1, -kFurthestOrder));
  EXPECT_THROW(further_order(object, LayAt::kUnder), Error);
}

TEST(LayTexture, APaintedStrokeLiesUnderIfItIsToldTo) {
  SceneObject object = board();
  const std::vector<Vector3d> across{{0.01, 0.02, 0.0}, {0.05, 0.02, 0.0}}, up{{0.03, 0.005, 0.0}, {0.03, 0.035, 0.0}};
  paint(object, across, laid(1, 0));
  const std::vector<HapticTriangle> before = object.mesh.haptic;
  const PaintResult under = paint(object, up, laid(2, 0), {}, LayAt::kUnder);
  EXPECT_GT(under.painted_under, 2u);
  EXPECT_EQ(under.painted_over, 0u);
  for (std::size_t t = 0; t < before.size(); ++t) {
    if (before[t].texture == 1) {
      EXPECT_EQ(object.mesh.haptic[t].texture, 1);
    }
  }
  // A stroke with a texture that is there is a further stroke of it, and comes to the top.
  const PaintResult again = paint(object, up, laid(2, 0));
  EXPECT_EQ(again.painted_over, under.painted_under);
  ASSERT_TRUE(object.find_texture(2)->origin);
  EXPECT_EQ(object.find_texture(2)->origin->kind, kPaintedOrigin);
  EXPECT_EQ(object.find_texture(2)->origin->strokes_mesh_m, (std::vector<std::vector<Vector3d>>{up, up}));
  take_out_texture(object, 2);
  EXPECT_TRUE(same(object.mesh.haptic, before));
}

TEST(LayTexture, WhatScansMeasuredIsSpreadWhateverIsPaintedOverThem) {
  SceneObject object = board();
  SceneTexture soft = laid(1, 0, "a"), hard = laid(2, 1, "b");
  soft.texture.stiffness_N_per_m = 300.0;
  hard.texture.stiffness_N_per_m = 900.0;
  put_texture(object, soft);
  lay_triangles(object, claims(1, 0, 100));
  EXPECT_FALSE(is_of_scans(object)) << "it has no map yet";
  set_scan_materials(object, "material.csv");
  const MaterialMap first = object.material;
  EXPECT_EQ(object.material_file, "material.csv");
  put_texture(object, hard);
  lay_triangles(object, claims(2, 50, 150));
  set_scan_materials(object, "material.csv");
  EXPECT_EQ(object.material.vertices[object.mesh.triangles[149][1]].stiffness_N_per_m, 900.0);
  put_texture(object, laid(3, 2));
  lay_triangles(object, claims(3, 0, 560));
  EXPECT_TRUE(is_of_scans(object));
  take_out_texture(object, 2);
  EXPECT_FALSE(is_of_scans(object));
  set_scan_materials(object, "material.csv");
  EXPECT_EQ(format_material_map(object.material), format_material_map(first));
  take_out_texture(object, 1);
  set_scan_materials(object, "material.csv");
  EXPECT_TRUE(object.material_file.empty());
}

TEST(LayTexture, OrderCoveredAndOriginReadBackAsTheyWereWritten) {
  const testkit::TempDir folder;
  Scene scene;
  scene.objects.push_back(board());
  SceneObject& object = scene.objects[0];
  object.mesh_file = "plane.obj";
  put_texture(object, laid(1, -2, "scan ä"));
  TextureOrigin& origin = *object.textures[0].origin;
  origin.checksum = "md5:00112233445566778899aabbccddeeff";
  origin.T_mesh_world = Pose{Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5), {0.1, -0.2, 0.3}};
  origin.placement = 2;
  origin.date = "2026-11-24";
  origin.version = "0.1.0";
  origin.settings["points.smoothing_m"] = 0.003;
  origin.rest["operator"] = {{"name", "Ann"}, {"hand", "left"}};
  lay_triangles(object, claims(1, 3, 40));
  const std::vector<Vector3d> picks{{0.01, 0.02, 0.0}, {0.05, 0.02, 0.0}};
  paint(object, picks, laid(2, 0));
  lay_triangles(object, claims(2, 20, 60));
  write_scene(folder.path() / "scene.json", scene);
  const Scene back = read_scene(folder.path() / "scene.json");
  const std::string text = read_file(folder.path() / "scene.json", kLimit_bytes);
  EXPECT_EQ(format_scene(back), text);
  EXPECT_THAT(text, HasSubstr("\"operator\""));
  EXPECT_EQ(back.objects[0].textures[0].order, -2);
  EXPECT_EQ(back.objects[0].textures[0].origin->T_mesh_world->translation_m, Vector3d(0.1, -0.2, 0.3));
  EXPECT_EQ(back.objects[0].textures[1].origin->strokes_mesh_m, std::vector<std::vector<Vector3d>>{picks});
  ASSERT_EQ(back.objects[0].covered.size(), object.covered.size());
  EXPECT_EQ(format_covered_triangles(back.objects[0].covered), format_covered_triangles(object.covered));
  EXPECT_TRUE(same(back.objects[0].mesh.haptic, object.mesh.haptic));
}

// Each object calls its table of covered triangles the same: in a scene of two, each has its own.
TEST(LayTexture, TwoObjectsOfASceneEachKeepWhatIsCovered) {
  const testkit::TempDir folder;
  Scene scene;
  for (int k = 0; k < 2; ++k) {
    SceneObject& object = scene.objects.emplace_back(board());
    object.mesh_file = k == 0 ? "first.obj" : "second.obj";
    for (int index = 1; index <= 2; ++index) {
      SceneTexture texture = laid(index, index);
      texture.file = std::to_string(k) + "-" + texture.file;
      put_texture(object, std::move(texture));
    }
    lay_triangles(object, claims(1, 0, 20));
    const auto first = static_cast<std::uint32_t>(5 + 7 * k);
    lay_triangles(object, claims(2, first, first + 6));
  }
  write_scene(folder.path() / "scene.json", scene);
  const Scene back = read_scene(folder.path() / "scene.json");
  ASSERT_EQ(back.objects.size(), 2u);
  EXPECT_EQ(back.objects[0].covered_file, "covered.csv");
  EXPECT_NE(back.objects[0].covered_file, back.objects[1].covered_file);
  for (std::size_t k = 0; k < 2; ++k) {
    ASSERT_EQ(back.objects[k].covered.size(), 6u) << k;
    EXPECT_EQ(back.objects[k].covered.front().triangle, 5u + 7u * k);
  }
}

TEST(LayTexture, FaultsInFilesAreNamed) {
  const std::string head = "triangle,texture,x1_mm,y1_mm,x2_mm,y2_mm,x3_mm,y3_mm\n";
  const auto fault = [&](const std::string& rows, const std::string& message) {
    EXPECT_THAT([&] { parse_covered_triangles(head + rows, "covered.csv", 5); },
                ThrowsMessage<Error>(testing::AllOf(HasSubstr("covered.csv:"), HasSubstr(message))))
        << rows;
  };
  fault("5,1,0,0,0,0,0,0\n", "5 is not a triangle of a mesh that has 5");
  fault("-1,1,0,0,0,0,0,0\n", "-1 is not a triangle");
  fault("3,1,0,0,0,0,0,0\n2,1,0,0,0,0,0,0\n", "comes after 3");
  fault("3,1,0,0,0,0,0,0\n3,2,0,0,0,0,0,0\n3,1,0,0,0,0,0,0\n", "twice");
  fault("3,-1,0,0,0,0,0,0\n", "not the index of a texture");
  fault("3,1,0,0,nan,0,0,0\n", "x2_mm");
  EXPECT_TRUE(parse_covered_triangles(head, "covered.csv", 0).empty());
  SceneObject object = board();
  EXPECT_THROW(lay_triangles(object, claims(1, 0, 100000)), Error);
}

TEST(LayTexture, ASwappedTextureSaysWhatItReplaced) {
  Scene scene;
  scene.objects.push_back(board());
  put_texture(scene.objects[0], laid(1, 0, "a"));
  Texture other = laid(2, 0).texture;
  other.name = "wood";
  swap_texture(scene, 1, other, "wood.texture.json");
  const TextureOrigin& origin = *scene.objects[0].textures[0].origin;
  EXPECT_EQ(origin.kind, kSwappedOrigin);
  EXPECT_EQ(origin.name, "wood");
  EXPECT_EQ(origin.rest.at("replaced"), Json("a"));
}

}  // namespace
}  // namespace asperity
