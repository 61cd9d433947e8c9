// The meshes for engines, each read back by the rules that its format states, not by what wrote it.
#include <algorithm>
#include <map>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "asperity/geometry/read_gltf.h"
#include "asperity/geometry/read_mtl.h"
#include "asperity/geometry/read_obj.h"
#include "asperity/image/png_image.h"
#include "asperity/scene/export_scene.h"
#include "painted_scene.h"

namespace asperity {
namespace {

using Eigen::Vector3d;
using nlohmann::json;
using testing::HasSubstr;

TEST(ExportGltf, HasTheHapticMaterialAsTheExtensionStates) {
  const std::string glb = exported(painted_scene(), ExportFormat::kGltf).at("plate.glb");
  std::uint32_t length = 0;
  for (int i = 3; i >= 0; --i) length = length << 8 | static_cast<unsigned char>(glb[12 + static_cast<std::size_t>(i)]);
  const json gltf = json::parse(glb.substr(20, length));
  EXPECT_EQ(gltf.at("extensionsUsed"), json::array({"MPEG_haptic_material"}));
  const json& materials = gltf.at("extensions").at("MPEG_haptic_material").at("materials");
  ASSERT_EQ(materials.size(), 1u);
  const json& material = materials[0];
  const auto item = [&](const char* key) {
    const json& one = material.at(key).at(0);
    EXPECT_THAT(one.at("type").get<std::string>(), testing::AnyOf("High_Resolution", "Low_Resolution"));
    EXPECT_LT(one.at("texture").at("index").get<std::size_t>(), gltf.at("textures").size());
    return one.at("extras").at("asperity");
  };
  EXPECT_EQ(item("stiffness").at("white"), 400.0);
  EXPECT_EQ(item("stiffness").at("unit"), "N/m");
  EXPECT_EQ(item("friction").at("white"), 0.3);
  EXPECT_NEAR(item("vibrotactileTexture").at("black").get<double>(), -1e-4, 1e-9);
  EXPECT_NEAR(item("vibrotactileTexture").at("white").get<double>(), 1e-4, 1e-9);
  int used = 0;
  for (const json& mesh : gltf.at("meshes"))
    if (mesh.contains("extensions"))
      used += mesh.at("extensions").at("MPEG_haptic_material").at("hapticMaterialIndex") == 0 ? 1 : 0;
  EXPECT_EQ(used, 1);
}

TEST(ExportGltf, KeepsVertexColours) {
  Scene scene = painted_scene();
  for (const Vector3d& vertex : scene.objects[0].mesh.vertices)
    scene.objects[0].mesh.vertex_colours.emplace_back(vertex.x() / 0.03, 0.5, 2.0);
  const std::string glb = exported(scene, ExportFormat::kGltf).at("plate.glb");
  EXPECT_THAT(glb, HasSubstr("COLOR_0"));
}

// The heights and normals of the MTL lie where the h lines put them: each corner's texture coordinates are its haptic
// coordinates over the size of the image, v upwards.
TEST(ExportObj, HasMapsOnTheHapticCoordinates) {
  const Scene scene = painted_scene();
  const auto files = exported(scene, ExportFormat::kObj);
  const MaterialLibrary library = parse_mtl(files.at("plate.mtl"), "plate.mtl");
  ASSERT_EQ(library.materials.size(), 2u);
  EXPECT_EQ(library.materials[0].name, "untextured");
  EXPECT_EQ(library.materials[1].normal_map, "cosine.normal.png");
  EXPECT_EQ(library.materials[1].displacement_map, "cosine.height.png");
  EXPECT_EQ(parse_png(files.at("cosine.height.png"), "heights").bits, 16);
  EXPECT_THAT(files.at("plate.mtl"), testing::AllOf(HasSubstr("stiffness 400 N/m"), HasSubstr("friction 0.3")));
  const MeshFile mesh = parse_obj(files.at("plate.obj"), "plate.obj");
  EXPECT_EQ(mesh.vertices.size(), scene.objects[0].mesh.vertices.size());
  const Eigen::Vector2d size_mm = make_texture_maps(scene.objects[0].textures[0].texture).size_mm;
  EXPECT_NEAR(size_mm.x(), 10.0, 1e-12);
  int textured = 0;
  auto part = mesh.parts.begin();
  std::int32_t material = -1;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (; part != mesh.parts.end() && part->first_triangle <= t; ++part) material = part->material;
    ASSERT_GE(material, 0);
    const std::string& name = mesh.materials[static_cast<std::size_t>(material)].name;
    EXPECT_EQ(name, mesh.haptic[t].texture == 1 ? "cosine" : "untextured");
    if (mesh.haptic[t].texture != 1) continue;
    ++textured;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d& uv = mesh.texture_coordinates.at(mesh.texture_corners[t][k]);
      EXPECT_NEAR(uv.x() * size_mm.x(), mesh.haptic[t].xy_mm[k].x(), 1e-9);
      EXPECT_NEAR((1.0 - uv.y()) * size_mm.y(), mesh.haptic[t].xy_mm[k].y(), 1e-9);
    }
  }
  EXPECT_GT(textured, 10);
}

// Between @ and @ ends at the next @; between three it does not (the grammar of USDA's asset paths).
TEST(ExportUsda, AnAtSignStaysInTheFilesName) {
  Scene scene = painted_scene();
  scene.objects[0].textures[0].file = "me@home.texture.json";
  const auto files = exported(scene, ExportFormat::kUsda);
  ASSERT_TRUE(files.contains("me@home.height.png"));
  EXPECT_THAT(files.at("plate.usda"), HasSubstr("asset inputs:file = @@@me@home.height.png@@@\n"));
  scene.objects[0].textures[0].file = "a@@@b.texture.json";
  EXPECT_THAT(exported(scene, ExportFormat::kUsda).at("plate.usda"),
              HasSubstr("asset inputs:file = @@@a\\@@@b.height.png@@@\n"));
}

TEST(ExportUsda, StatesUnitsDisplacementAndFriction) {
  Scene scene = painted_scene();
  scene.objects[0].unit_m = 1.0;
  scene.static_friction_ratio = 1.5;
  const std::string usda = exported(scene, ExportFormat::kUsda).at("plate.usda");
  EXPECT_TRUE(usda.starts_with("#usda 1.0\n"));
  for (const char* part : {"metersPerUnit = 1\n", "physics:dynamicFriction = 0.3\n", "physics:staticFriction = 0.45",
                           "asperity:stiffness_N_per_m = 400\n",
                           "inputs:displacement.connect = </plate/Materials/cosine/height.outputs:r>",
                           "asset inputs:file = @cosine.height.png@", "float4 inputs:scale = (0.0002, 1, 1, 1)",
                           "float4 inputs:bias = (-0.0001, 0, 0, 0)", "string inputs:varname = \"haptic\""})
    EXPECT_THAT(usda, HasSubstr(part));
  // As many brackets open as close.
  for (const char* pair : {"()", "[]", "{}"})
    EXPECT_EQ(std::count(usda.begin(), usda.end(), pair[0]), std::count(usda.begin(), usda.end(), pair[1])) << pair;
}

}  // namespace
}  // namespace asperity
