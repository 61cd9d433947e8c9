#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "asperity/base/error.h"
#include "asperity/geometry/mesh_adjacency.h"
#include "asperity/image/png_image.h"
#include "asperity/scene/displace_mesh.h"
#include "asperity/scene/export_scene.h"
#include "asperity/scene/format_wav.h"
#include "asperity/scene/format_x3p.h"
#include "asperity/scene/paint.h"
#include "asperity/scene/texture_maps.h"
#include "asperity/testkit/shape_meshes.h"
#include "asperity/texture/fit_areal.h"
#include "asperity/texture/fit_fourier2d.h"

namespace asperity {
namespace {

using Eigen::Vector3d;

// h = 0.1 mm cos(2π x / 2.5 mm) over a sample of 10 mm.
Texture cosine() {
  Texture texture;
  texture.name = "cosine";
  texture.model = Fourier1d{10.0, {0.0, 0.0, 0.0, 1e-4}, {0.0, 0.0, 0.0, 0.0}, 0.0};
  return texture;
}

std::uint32_t number_at(const std::string& data, std::size_t at, int bytes) {
  std::uint32_t out = 0;
  for (int i = 0; i < bytes; ++i)
    out |= static_cast<std::uint32_t>(static_cast<unsigned char>(data[at + static_cast<std::size_t>(i)])) << (8 * i);
  return out;
}

TEST(TextureMaps, AreTheTexturesHeightsAndSlopes) {
  const TextureMaps maps = make_texture_maps(cosine());
  EXPECT_NEAR(maps.size_mm.x(), 10.0, 1e-12);
  const DeepGrayImage image = parse_png(maps.height_png, "heights");
  EXPECT_EQ(image.bits, 16);
  ASSERT_EQ(static_cast<std::size_t>(image.width), maps.heights.columns);
  const double range_m = maps.heights.high_m - maps.heights.low_m;
  for (int c = 0; c < image.width; ++c) {
    const double x_mm = 10.0 * c / image.width;
    const double height_m = maps.heights.low_m + image.at(c, 0) / 65535.0 * range_m;
    EXPECT_NEAR(height_m, 1e-4 * std::cos(2.0 * M_PI * x_mm / 2.5), range_m / 65535.0);
  }
  EXPECT_EQ(maps.normal_png.substr(1, 3), "PNG");
  EXPECT_EQ(static_cast<unsigned char>(maps.normal_png[24]), 16);  // bits
  EXPECT_EQ(static_cast<unsigned char>(maps.normal_png[25]), 2);   // RGB
  EXPECT_EQ(maps.normal_png, make_texture_maps(cosine()).normal_png);
}

TEST(DisplaceMesh, RaisesTheTextureOffAPlaneAndNothingElse) {
  SceneObject object;
  object.mesh_file = "plate.obj";
  const TriangleMesh plate = testkit::box_mesh({0.03, 0.02, 0.005}, 10);
  object.mesh.vertices = plate.vertices_m;
  object.mesh.triangles = plate.triangles;
  SceneTexture texture{1, "cosine.texture.json", cosine()};
  const std::vector<Vector3d> picks{{0.004, 0.01, 0.005}, {0.026, 0.01, 0.005}};
  HapticCoordinatesConfig coordinates;
  coordinates.extension_mm = 0.1;
  coordinates.rings = 2;
  paint(object, picks, texture, coordinates);
  const MeshFile relief = displace_mesh(object, {});

  // Closed as before: every edge has two triangles, and the volume grew by the relief alone.
  const TriangleMesh out = to_metres(relief, 1.0);
  const MeshAdjacency adjacency = make_adjacency(out);
  double volume_m3 = 0.0;
  for (const Triangle& tri : out.triangles)
    volume_m3 += out.vertices_m[tri[0]].dot(out.vertices_m[tri[1]].cross(out.vertices_m[tri[2]])) / 6.0;
  for (std::uint32_t e = 0; e < adjacency.edge_vertices.size(); ++e)
    ASSERT_EQ(adjacency.triangles_of_edge(e).size(), 2u);
  EXPECT_GT(volume_m3, 0.03 * 0.02 * 0.005);
  EXPECT_LT(volume_m3, 0.03 * 0.02 * (0.005 + 2e-4));
  double top_m = 0.0;
  for (const Vector3d& p : relief.vertices) {
    EXPECT_GE(p.z(), -1e-15);
    top_m = std::max(top_m, p.z());
    // In the middle of the stroke, away from the fade: the cosine, its lowest point on the plane.
    if (p.z() > 0.0049 && std::abs(p.y() - 0.01) < 0.001 && std::abs(p.x() - 0.015) < 0.006) {
      EXPECT_NEAR(p.z() - 0.005, 1e-4 * (1.0 + std::cos(2.0 * M_PI * (p.x() - 0.004) / 2.5e-3)), 1e-9);
    }
  }
  EXPECT_NEAR(top_m, 0.0052, 2e-6);
}

TEST(DisplaceMesh, RefusesWhatWouldFillTheMemory) {
  SceneObject object;
  object.mesh_file = "plate.obj";
  object.mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  object.mesh.triangles = {{0, 1, 2}};
  object.mesh.haptic.resize(1);
  object.mesh.haptic[0].texture = 1;
  object.textures.push_back({1, "cosine.texture.json", cosine()});
  EXPECT_THROW(displace_mesh(object, {}), Error);  // a metre in steps of 0.2 mm
}

TEST(FormatWav, HasTheHeaderOfItsSamples) {
  const std::vector<double> samples{0.0, 1.0, -1.0, 0.5, 3.0};
  const std::string wav = format_wav(samples, 8000.0, 1.0);
  ASSERT_EQ(wav.size(), 44u + 10u);
  EXPECT_EQ(wav.substr(0, 4) + wav.substr(8, 8) + wav.substr(36, 4), "RIFFWAVEfmt data");
  EXPECT_EQ(number_at(wav, 4, 4), 36u + 10u);
  EXPECT_EQ(number_at(wav, 24, 4), 8000u);
  EXPECT_EQ(number_at(wav, 40, 4), 10u);
  const auto sample = [&](std::size_t i) { return static_cast<std::int16_t>(number_at(wav, 44 + 2 * i, 2)); };
  EXPECT_EQ(sample(1), 32767);
  EXPECT_EQ(sample(2), -32767);
  EXPECT_EQ(sample(3), 16384);
  EXPECT_EQ(sample(4), 32767);  // clipped
  EXPECT_THROW(format_wav(samples, 8000.0, 0.0), Error);
  EXPECT_THROW(format_wav(std::vector<double>{std::nan("")}, 8000.0, 1.0), Error);
}

// Members of a zip by its central directory.
std::map<std::string, std::string> unzip(const std::string& zip) {
  std::map<std::string, std::string> out;
  const std::size_t end = zip.size() - 22;
  EXPECT_EQ(zip.substr(end, 4), "PK\x05\x06");
  std::size_t at = number_at(zip, end + 16, 4);
  for (std::uint32_t i = 0; i < number_at(zip, end + 10, 2); ++i) {
    EXPECT_EQ(zip.substr(at, 4), "PK\x01\x02");
    const std::uint32_t size = number_at(zip, at + 24, 4);
    const std::uint32_t name_size = number_at(zip, at + 28, 2);
    const std::size_t local = number_at(zip, at + 42, 4);
    const std::string name = zip.substr(at + 46, name_size);
    out[name] = zip.substr(local + 30 + name_size, size);
    at += 46 + name_size;
  }
  return out;
}

TEST(FormatX3p, HoldsHeightsAndTheirSums) {
  const X3pGrid grid{3, 2, 1e-5, 2e-5, {1e-6, -2e-6, 0.0, 4e-6, 5e-6, -6e-6}};
  const auto members = unzip(format_x3p(grid));
  ASSERT_EQ(members.size(), 3u);
  const std::string& data = members.at("bindata/data.bin");
  ASSERT_EQ(data.size(), 48u);
  for (std::size_t i = 0; i < 6; ++i) {
    double value;
    std::memcpy(&value, data.data() + 8 * i, 8);
    EXPECT_EQ(value, grid.height_m[i]);
  }
  const std::string& xml = members.at("main.xml");
  EXPECT_THAT(xml, testing::HasSubstr("<FeatureType>SUR</FeatureType>"));
  EXPECT_THAT(xml, testing::HasSubstr("<Increment>1e-05</Increment>"));
  EXPECT_THAT(xml, testing::HasSubstr("<SizeX>3</SizeX>"));
  EXPECT_THAT(members.at("md5checksum.hex"), testing::MatchesRegex("[0-9a-f]* \\*main.xml\n"));
}

TEST(FormatX3p, SumsAreThoseOfMd5) {
  // head -c 8 /dev/zero | md5sum
  const auto members = unzip(format_x3p({1, 1, 1e-5, 0.0, {0.0}}));
  EXPECT_THAT(members.at("main.xml"), testing::HasSubstr("7dea362b3fac8e00956a4952a3d4f474"));
  EXPECT_THAT(members.at("main.xml"), testing::HasSubstr("<FeatureType>PRF</FeatureType>"));
}

TEST(FormatX3p, HoldsItsNoteAsAComment) {
  const auto members = unzip(format_x3p({1, 1, 1e-5, 0.0, {0.0}, "measured -- half -->"}));
  EXPECT_THAT(members.at("main.xml"), testing::HasSubstr("<!-- measured -_ half -_> -->"));
}

TEST(FormatX3p, RefusesWhatIsNoGrid) {
  EXPECT_THROW(format_x3p({2, 2, 1e-5, 1e-5, {0.0}}), Error);
  EXPECT_THROW(format_x3p({1, 1, 0.0, 1e-5, {0.0}}), Error);
  EXPECT_THROW(format_x3p({1, 1, 1e-5, 1e-5, {std::numeric_limits<double>::infinity()}}), Error);
  EXPECT_NO_THROW(format_x3p({2, 1, 1e-5, 1e-5, {std::nan(""), 0.0}})) << "a missing height";
}

Scene painted_scene() {
  Scene scene;
  SceneObject object;
  object.mesh_file = "plate.obj";
  const TriangleMesh plate = testkit::plane_mesh({0.03, 0.02}, 15, 10);
  object.mesh.vertices = plate.vertices_m;
  object.mesh.triangles = plate.triangles;
  const std::vector<Vector3d> picks{{0.006, 0.011, 0.0}, {0.024, 0.011, 0.0}};
  paint(object, picks, {1, "cosine.texture.json", cosine()});
  scene.objects.push_back(object);
  return scene;
}

std::vector<std::string> names_of(const ExportResult& result) {
  std::vector<std::string> out;
  for (const ExportedFile& file : result.files) out.push_back(file.name);
  return out;
}

TEST(ExportScene, NamesFilesAfterMeshesAndTextures) {
  const Scene scene = painted_scene();
  using testing::ElementsAre;
  EXPECT_THAT(names_of(export_scene(scene, ExportFormat::kObj)),
              ElementsAre("cosine.height.png", "cosine.normal.png", "cosine.images.json", "plate.mtl", "plate.obj"));
  EXPECT_THAT(names_of(export_scene(scene, ExportFormat::kUsda)),
              ElementsAre("cosine.height.png", "cosine.normal.png", "cosine.images.json", "plate.usda"));
  EXPECT_THAT(names_of(export_scene(scene, ExportFormat::kAhap)), ElementsAre("cosine.ahap"));
  EXPECT_THAT(names_of(export_scene(scene, ExportFormat::kHaps)), ElementsAre("cosine.haps"));
  EXPECT_THAT(names_of(export_scene(scene, ExportFormat::kHjif)), ElementsAre("cosine.hjif"));
  const ExportResult gltf = export_scene(scene, ExportFormat::kGltf);
  EXPECT_THAT(names_of(gltf), ElementsAre("plate.glb"));
  EXPECT_EQ(gltf.files[0].content.substr(0, 4), "glTF");
  EXPECT_THAT(names_of(export_scene(scene, ExportFormat::kStl)), ElementsAre("plate.stl"));
  EXPECT_THAT(names_of(export_scene(scene, ExportFormat::kPng)),
              ElementsAre("cosine.height.png", "cosine.normal.png", "cosine.images.json"));
  EXPECT_THAT(names_of(export_scene(scene, ExportFormat::kWav)), ElementsAre("cosine.wav", "cosine.sound.json"));
  EXPECT_THAT(names_of(export_scene(scene, ExportFormat::kX3p)), ElementsAre("cosine.x3p"));
}

// An areal surface of 3 mm x 2 mm in a file of 10 mm: what was measured, and what the border made.
TEST(ExportScene, X3pSaysWhatWasMeasured) {
  Scene scene = painted_scene();
  std::vector<ArealSample> samples;
  for (int r = 0; r <= 20; ++r)
    for (int c = 0; c <= 30; ++c) samples.push_back({1e-4 * c, 1e-4 * r, 1e-6 * std::sin(0.3 * c + 0.2 * r)});
  scene.objects[0].textures[0].texture.model = fit_areal(samples).texture;
  auto members = unzip(export_scene(scene, ExportFormat::kX3p).files.front().content);
  EXPECT_THAT(members.at("main.xml"),
              testing::HasSubstr("points 0.1 mm apart. Measured: x 0 to 3 mm, y 0 to 2 mm from the first point of this "
                                 "file. The surface beyond was continued (border: mirror), not measured."));
  const Fourier1d profile{10.0, {0.0, 0.0, 0.0, 1e-4}, {0.0, 0.0, 0.0, 0.0}, 0.0};
  scene.objects[0].textures[0].texture.model = fit_fourier2d(profile, profile).texture;
  members = unzip(export_scene(scene, ExportFormat::kX3p).files.front().content);
  EXPECT_THAT(members.at("main.xml"),
              testing::HasSubstr("random phases (seed 0). No height was measured where it is."));
}

TEST(ExportScene, TwoTexturesOfOneNameDoNotShareAFile) {
  Scene scene = painted_scene();
  scene.objects[0].textures.push_back({2, "below/cosine.texture.json", cosine()});
  EXPECT_THAT(names_of(export_scene(scene, ExportFormat::kX3p)), testing::ElementsAre("cosine.x3p", "cosine-2.x3p"));
}

TEST(ExportScene, SoundsAtTheSpeedOverThePitch) {
  ExportConfig config;
  config.stroke.speed_mps = 0.05;  // 2.5 mm at 50 mm/s: 20 Hz
  config.stroke.duration_s = 1.0;
  const std::string wav = export_scene(painted_scene(), ExportFormat::kWav, config).files[0].content;
  int crossings = 0;
  int highest = 0;
  int last = 0;
  for (std::size_t at = 44; at + 1 < wav.size(); at += 2) {
    const int sample = static_cast<std::int16_t>(number_at(wav, at, 2));
    if (last < 0 && sample > 0) ++crossings;
    if (sample != 0) last = sample;
    highest = std::max(highest, std::abs(sample));
  }
  EXPECT_NEAR(crossings, 20, 1);
  EXPECT_NEAR(highest, 0.9 * 32767, 1.0);
}

TEST(ExportScene, ReportsHowFarItIsAndCanBeStopped) {
  Scene scene = painted_scene();
  scene.objects[0].textures.push_back({2, "other.texture.json", cosine()});
  for (const ExportFormat format : {ExportFormat::kGltf, ExportFormat::kObj, ExportFormat::kUsda, ExportFormat::kPng}) {
    std::vector<double> fractions;
    export_scene(scene, format, {},
                 {[&](std::string_view stage, double fraction) {
                    EXPECT_EQ(stage, "exporting");
                    fractions.push_back(fraction);
                  },
                  {}});
    EXPECT_GT(fractions.size(), 100U);
    EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
    EXPECT_EQ(fractions.front(), 0.0);
    EXPECT_GT(fractions.back(), 0.9);
    EXPECT_LE(fractions.back(), 1.0);
    int asked = 0;
    EXPECT_THROW(export_scene(scene, format, {}, {{}, [&] { return ++asked > 20; }}), Cancelled);
  }
}

TEST(ExportScene, WithNothingToWriteIsAnError) {
  Scene scene = painted_scene();
  scene.objects[0].textures.clear();
  EXPECT_THROW(export_scene(scene, ExportFormat::kPng), Error);
}

TEST(ExportScene, AnObjBringsItsMaterials) {
  Scene scene;
  SceneObject object;
  object.mesh_file = "m.obj";
  object.mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  object.mesh.triangles = {{0, 1, 2}};
  object.mesh.materials.emplace_back().name = "wood";
  object.mesh.material_libraries = {"elsewhere.mtl"};
  scene.objects.push_back(object);
  const ExportResult result = export_scene(scene, ExportFormat::kObj);
  ASSERT_EQ(result.files.size(), 2u);
  EXPECT_EQ(result.files[0].name, "m.mtl");
  EXPECT_EQ(result.files[0].content, "newmtl wood\n");
  EXPECT_TRUE(result.files[1].content.starts_with("mtllib m.mtl\n"));
}

}  // namespace
}  // namespace asperity
