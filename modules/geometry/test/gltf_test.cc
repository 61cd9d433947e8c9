#include "asperity/geometry/read_gltf.h"

#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <Eigen/Geometry>

#include "asperity/base/output.h"
#include "asperity/geometry/read_mesh.h"
#include "asperity/geometry/read_obj.h"
#include "asperity/geometry/write_gltf.h"
#include "asperity/testkit/temp_dir.h"
#include "mesh_format_rig.h"

namespace asperity {
namespace {

using test::append_value;
using test::message_of;
using test::pyramid;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

GltfExport example() {
  GltfExport scene;
  scene.mesh = pyramid();
  scene.mesh.materials.resize(1);
  scene.mesh.materials[0] = {"clay", Eigen::Vector3d(0.5, 0.25, 0.125), "colour.png", "", "", ""};
  scene.mesh.parts = {{0, -1, -1, 0, 0}};
  scene.mesh.haptic.resize(6);
  for (std::size_t i = 2; i < 6; ++i) {
    scene.mesh.haptic[i].texture = 7;
    scene.mesh.haptic[i].xy_mm = {Eigen::Vector2d(0, 0), Eigen::Vector2d(12.5, -3), Eigen::Vector2d(double(i), 1)};
  }
  scene.unit_m = 0.001;
  GltfTexture texture;
  texture.index = 7;
  texture.name = "grooves";
  texture.size_mm = {10, 20};
  texture.normal_map = GltfImage{"normals", "\x89PNG normal", ""};
  texture.height_map = GltfImage{"heights", "", "heights.png"};
  texture.height_range_m = 0.0025;
  texture.friction = 0.4;
  scene.textures.push_back(texture);
  return scene;
}

TEST(Gltf, LongReadIsStopped) {
  std::string text = format_gltf(example(), GltfForm::kJson);
  std::string many = "{\"many\":[0";
  for (int i = 0; i < 10000; ++i) many += ",0";
  text.replace(text.find('{'), 1, many + "],");
  std::size_t asked = 0;
  Observer observer;
  EXPECT_EQ(parse_gltf(text, "t.gltf", {}, {}, observer).triangles.size(), 6u);
  observer.cancelled = [&asked] { return ++asked > 1; };
  observer.progress = [](std::string_view stage, double) { FAIL() << stage; };
  EXPECT_THROW(parse_gltf(text, "t.gltf", {}, {}, observer), Cancelled);
  EXPECT_EQ(asked, 2u);
}

// Geometry and haptic coordinates come back but for float32: 2^-24 of each number.
TEST(Gltf, ReadsBackWhatItWrote) {
  const GltfExport scene = example();
  for (const GltfForm form : {GltfForm::kJson, GltfForm::kBinary}) {
    const std::string bytes = format_gltf(scene, form);
    const MeshFile mesh = parse_gltf(bytes, "t.glb");
    ASSERT_EQ(mesh.triangles.size(), 6u);
    ASSERT_EQ(mesh.vertices.size(), 5u);
    ASSERT_EQ(mesh.haptic.size(), 6u);
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_EQ(mesh.haptic[i].texture, scene.mesh.haptic[i].texture);
      for (std::size_t k = 0; k < 3; ++k) {
        const Eigen::Vector3d expected = scene.mesh.vertices[scene.mesh.triangles[i][k]] * 0.001;
        EXPECT_LE((mesh.vertices[mesh.triangles[i][k]] - expected).cwiseAbs().maxCoeff(), 0x1p-24 * 0.001);
        if (scene.mesh.haptic[i].texture < 0) continue;
        EXPECT_LE((mesh.haptic[i].xy_mm[k] - scene.mesh.haptic[i].xy_mm[k]).cwiseAbs().maxCoeff(), 0x1p-23 * 12.5);
      }
    }
    EXPECT_THAT(mesh.texture_coordinates, IsEmpty());
    EXPECT_EQ(mesh.materials.at(0).base_colour_map, "colour.png");
    EXPECT_EQ(mesh.materials.at(0).base_colour, Eigen::Vector3d(0.5, 0.25, 0.125));
    EXPECT_EQ(format_gltf(scene, form), bytes);
  }
  const std::string json = format_gltf(scene, GltfForm::kJson);
  EXPECT_THAT(json, HasSubstr("\"vibrotactileTexture\""));
  EXPECT_THAT(json, HasSubstr("\"hapticMaterialIndex\": 0"));
  EXPECT_THAT(json, HasSubstr("\"height_range_m\": 0.0025"));
  EXPECT_THAT(json, HasSubstr("\"heights.png\""));
}

TEST(Gltf, TextureCoordinatesAndNormalsAreOfCorners) {
  GltfExport scene;
  scene.mesh = parse_obj(
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0.25\nvt 1 1\nvt 0.5 0.75\nvn 0 0 2\nf 1/1/1 2/2/1 3/3/1\nf "
      "1/4/1 3/3/1 4/2/1\n",
      "square");
  const MeshFile mesh = parse_gltf(format_gltf(scene, GltfForm::kBinary), "t.glb");
  ASSERT_EQ(mesh.vertices.size(), 4u);  // the corner at the origin has two texture coordinates, one place
  ASSERT_EQ(mesh.texture_corners.size(), 2u);
  EXPECT_EQ(mesh.texture_coordinates.at(mesh.texture_corners[0][0]), Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(mesh.texture_coordinates.at(mesh.texture_corners[1][0]), Eigen::Vector3d(0.5, 0.75, 0));
  EXPECT_EQ(mesh.normals.at(mesh.normal_corners[1][2]), Eigen::Vector3d(0, 0, 1));
}

namespace fs = std::filesystem;

// One triangle strip of four corners in a buffer beside the file, placed twice, once mirrored.
class GltfFolder : public testing::Test {
 protected:
  GltfFolder() {
    fs::create_directories(folder_ / "in" / "side");
    for (const float value : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 1.f, 1.f, 0.f})
      append_value(data_, value, false);
    for (const unsigned char i : {0, 1, 2, 3}) append_value(data_, i, false);
  }

  static std::string document(const std::string& uri, const std::string& mode, const std::string& nodes,
                              const std::string& more = "") {
    return R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":)" + nodes +
           R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"mode":)" + mode +
           R"(}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},{"bufferView":1,"componentType":5121,"count":4,"type":"SCALAR"}],
             "bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":4}],"buffers":[{"byteLength":52,"uri":")" +
           uri + "\"}]" + more + "}";
  }
  std::string read(const std::string& text) {
    write_file(folder_ / "in" / "t.gltf", text);
    return message_of([&] { mesh_ = read_mesh(folder_ / "in" / "t.gltf"); });
  }

  testkit::TempDir folder_;
  std::string data_;
  MeshFile mesh_;
};

TEST_F(GltfFolder, NodesStripsFansAndMirrors) {
  write_file(folder_ / "in" / "side" / "a b.bin", data_);
  const std::string nodes =
      R"([{"translation":[10,0,0],"children":[1,2]},{"mesh":0,"name":"plain"},{"mesh":0,"scale":[-2,1,1],"rotation":[0,0,0,1]}])";
  ASSERT_EQ(read(document("side/a%20b.bin", "5", nodes)), "no error");
  EXPECT_THAT(mesh_.objects, ElementsAre("plain"));
  ASSERT_EQ(mesh_.triangles.size(), 4u);
  ASSERT_EQ(mesh_.vertices.size(), 6u);  // the two share an edge
  const auto at = [&](std::size_t t, std::size_t k) { return mesh_.vertices[mesh_.triangles[t][k]]; };
  for (std::size_t t = 0; t < 4; ++t) {  // the mirrored square still faces up
    EXPECT_GT((at(t, 1) - at(t, 0)).cross(at(t, 2) - at(t, 0)).z(), 0.0) << t;
  }
  EXPECT_EQ(at(2, 0), Eigen::Vector3d(10, 0, 0));
  ASSERT_EQ(read(document("side/a%20b.bin", "6", R"([{"mesh":0}])")), "no error");
  EXPECT_THAT(mesh_.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
}

TEST_F(GltfFolder, HostileFilesAreRefused) {
  write_file(folder_ / "in" / "d.bin", data_);
  write_file(folder_ / "secret.bin", data_);
  fs::create_symlink(folder_ / "secret.bin", folder_ / "in" / "link.bin");
  const std::string node = R"([{"mesh":0}])";
  EXPECT_EQ(read(document("d.bin", "5", node)), "no error");
  EXPECT_THAT(read(document("../secret.bin", "5", node)), HasSubstr("outside the mesh's folder"));
  EXPECT_THAT(read(document("link.bin", "5", node)), HasSubstr("outside the mesh's folder"));
  EXPECT_THAT(read(document((folder_ / "secret.bin").string(), "5", node)), HasSubstr("outside the mesh's folder"));
  EXPECT_THAT(read(document("d.bin", "4", node)), HasSubstr("4 corners are not triangles"));
  EXPECT_THAT(read(document("d.bin", "0", node)), HasSubstr("holds no triangles"));
  EXPECT_THAT(read(document("d.bin", "5", R"([{"children":[0],"mesh":0}])")), HasSubstr("its own ancestor"));
  EXPECT_THAT(read(document("d.bin", "5", R"([{"mesh":3}])")), HasSubstr("mesh 3 does not exist"));
  EXPECT_THAT(read(document("d.bin", "5", node, R"(,"extensionsRequired":["KHR_draco_mesh_compression"])")),
              HasSubstr("KHR_draco_mesh_compression"));
  const auto spoilt = [&](const std::string& from, const std::string& to) {
    std::string text = document("d.bin", "5", node);
    text.replace(text.find(from), from.size(), to);
    return read(text);
  };
  EXPECT_THAT(spoilt("\"count\":4", "\"count\":5"), HasSubstr("leaves its buffer"));
  EXPECT_THAT(spoilt("\"count\":4", "\"count\":18446744073709551615"), HasSubstr("leaves its buffer"));
  EXPECT_THAT(spoilt("\"byteOffset\":48", "\"byteOffset\":49"), HasSubstr("leaves its buffer"));
  EXPECT_THAT(spoilt("\"bufferView\":1", "\"bufferView\":2"), HasSubstr("buffer"));
  EXPECT_THAT(spoilt("\"version\":\"2.0\"", "\"version\":\"1.0\""), HasSubstr("is glTF of version '1.0'"));
  data_[48] = 9;
  write_file(folder_ / "in" / "d.bin", data_);
  EXPECT_THAT(read(document("d.bin", "5", node)), HasSubstr("index 9 of 4 vertices"));
  EXPECT_THAT(read(std::string(10000, '[')), HasSubstr("deep"));
  const std::string glb = format_gltf(example(), GltfForm::kBinary);
  EXPECT_THAT(message_of([&] { parse_gltf(glb.substr(0, glb.size() - 1), "t.glb"); }), HasSubstr("is cut"));
}

}  // namespace
}  // namespace asperity
