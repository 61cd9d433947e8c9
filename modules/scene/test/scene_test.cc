#include <cmath>
#include <ostream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/scene/material_at.h"
#include "asperity/scene/read_scene.h"
#include "asperity/scene/swap_texture.h"
#include "asperity/scene/write_scene.h"
#include "asperity/testkit/temp_dir.h"
#include "asperity/texture/texture_file.h"

namespace asperity {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr std::uint64_t kLimit_bytes = 1 << 20;

Texture sine_texture(double amplitude_m) {
  Texture texture;
  texture.name = "sine";
  texture.model = Fourier1d{2.0, {0.0}, {amplitude_m}, 0.0};
  return texture;
}

// The plane of seed Fig. 33 with a third triangle that has no texture.
Scene plane_scene() {
  SceneObject object;
  object.mesh_file = "plane.obj";
  object.unit_m = 1e-3;
  object.mesh.vertices = {{-40, 0, 40}, {-40, 0, -40}, {40, 0, 40}, {40, 0, -40}, {90, 0, 0}};
  object.mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {2, 4, 3}};
  using Eigen::Vector2d;
  object.mesh.haptic = {{1, {Vector2d(0, 0), Vector2d(0, 50), Vector2d(50, 0)}},
                        {2, {Vector2d(50, 0), Vector2d(0, 50), Vector2d(50, 50)}},
                        {}};
  object.textures = {{1, "a.texture.json", sine_texture(1e-5)}, {2, "deep/b.texture.json", sine_texture(2e-5)}};
  Scene scene;
  scene.objects.push_back(object);
  scene.stiffness_N_per_m = 500.0;
  scene.friction = 0.3;
  scene.static_friction_ratio = 1.25;
  scene.T_mesh_world = Pose{Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5), {0.1, -0.2, 0.3}};
  return scene;
}

TEST(Scene, ReadsBackAsItWasWritten) {
  const testkit::TempDir folder;
  Scene scene = plane_scene();
  scene.objects[0].material_file = "material.csv";
  scene.objects[0].material.vertices.resize(5);
  scene.objects[0].material.vertices[3] = {0.25, 1234.5, std::nan("")};
  scene.objects.push_back(scene.objects[0]);
  scene.objects[1].mesh_file = "other.obj";
  scene.objects[1].textures.clear();
  scene.objects[1].material_file.clear();
  scene.objects[1].T_world_mesh.translation_m = {1.0, 2.0, 3.0};
  write_scene(folder.path() / "scene.json", scene);
  const Scene back = read_scene(folder.path() / "scene.json");

  ASSERT_EQ(back.objects.size(), 2u);
  EXPECT_EQ(back.objects[0].unit_m, 1e-3);
  EXPECT_EQ(back.objects[0].mesh.vertices, scene.objects[0].mesh.vertices);
  ASSERT_EQ(back.objects[0].mesh.haptic.size(), 3u);
  EXPECT_EQ(back.objects[0].mesh.haptic[1].xy_mm, scene.objects[0].mesh.haptic[1].xy_mm);
  ASSERT_EQ(back.objects[0].textures.size(), 2u);
  EXPECT_EQ(std::get<Fourier1d>(back.objects[0].textures[1].texture.model).b_m[0], 2e-5);
  EXPECT_EQ(back.objects[0].material.vertices[3].stiffness_N_per_m, 1234.5);
  EXPECT_TRUE(std::isnan(back.objects[0].material.vertices[2].compliance_kc));
  EXPECT_EQ(back.objects[1].T_world_mesh.translation_m, Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(back.stiffness_N_per_m, 500.0);
  EXPECT_EQ(back.T_mesh_world->translation_m, scene.T_mesh_world->translation_m);
  // The second object has coordinates, but no texture in the scene.
  ASSERT_EQ(back.problems.size(), 2u);
  EXPECT_EQ(back.problems[0].kind, "unlisted_texture");

  const std::string first = read_file(folder.path() / "scene.json", kLimit_bytes);
  EXPECT_EQ(format_scene(back), first);
}

TEST(Scene, AMeshAloneIsASceneWithoutTextures) {
  const testkit::TempDir folder;
  write_file(folder.path() / "m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Scene scene = read_scene(folder.path() / "m.obj");
  ASSERT_EQ(scene.objects.size(), 1u);
  EXPECT_EQ(scene.objects[0].mesh.triangles.size(), 1u);
  EXPECT_TRUE(scene.objects[0].textures.empty());
}

struct Fault {
  const char* text;
  const char* message;
};
void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.message; }
class SceneFault : public testing::TestWithParam<Fault> {};

TEST_P(SceneFault, IsNamed) {
  const testkit::TempDir folder;
  write_file(folder.path() / "m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write_file(folder.path() / "scene.json", GetParam().text);
  EXPECT_THAT([&] { read_scene(folder.path() / "scene.json"); },
              ThrowsMessage<Error>(testing::AllOf(HasSubstr("scene.json"), HasSubstr(GetParam().message))));
}

INSTANTIATE_TEST_SUITE_P(
    Faults, SceneFault,
    testing::Values(
        Fault{"{", ":1:1: not JSON: syntax error"}, Fault{"[]", ":1:1: must be a JSON object, found an array"},
        Fault{R"({"format":"asperity-texture","version":1,"mesh":"m.obj"})",
              R"(:1:11: key 'format': must be "asperity-scene", found "asperity-texture")"},
        Fault{R"({"format":"asperity-scene","version":2,"mesh":"m.obj"})",
              "key 'version': must be 1, the version that this program reads; found 2"},
        Fault{R"({"format":"asperity-scene","version":1})", ":1:1: key 'mesh': is missing"},
        Fault{R"({"format":"asperity-scene","version":1,"mesh":"../m.obj"})", "'../m.obj', which is not a file in"},
        Fault{R"({"format":"asperity-scene","version":1,"mesh":"/etc/passwd"})", "not a file in the scene's folder"},
        Fault{R"({"format":"asperity-scene","version":1,"mesh":"m.obj","unit_m":0})", "key 'unit_m': 0 is outside"},
        Fault{R"({"format":"asperity-scene","version":1,"mesh":"m.obj","colour":0})",
              "key 'colour': is not known here"},
        Fault{R"({"format":"asperity-scene","version":1,"mesh":"m.obj","friction":"much"})",
              "key 'friction': must be a number, found \"much\""},
        Fault{R"({"format":"asperity-scene","version":1,"mesh":"m.obj","textures":[{"index":1}]})",
              "key 'textures[0].file': is missing"},
        Fault{R"({"format":"asperity-scene","version":1,"mesh":"m.obj","textures":[{"index":1.5,"file":"x"}]})",
              "key 'textures[0].index': must be a whole number, found 1.5"},
        Fault{R"({"format":"asperity-scene","version":1,"mesh":"m.obj",
                  "textures":[{"index":1,"file":"x"},{"index":1,"file":"y"}]})",
              "scene.json:2:63: key 'textures[1].index': the index 1 a second time"},
        Fault{R"({"format":"asperity-scene","version":1,"mesh":"m.obj","T_mesh_world":[0,0,0,2,0,0,0]})",
              "not of unit length"},
        Fault{R"({"format":"asperity-scene","version":1,"mesh":"m.obj",
"mesh":"n.obj"})",
              "scene.json:2:1: key 'mesh' appears twice"}));

TEST(Scene, LongReadIsStopped) {
  const testkit::TempDir folder;
  write_scene(folder.path() / "scene.json", plane_scene());
  std::size_t asked = 0;
  Observer observer;
  observer.cancelled = [&asked] {
    ++asked;
    return false;
  };
  read_scene(folder.path() / "scene.json", observer);
  EXPECT_GE(asked, 2u);  // before the mesh, and before each texture
  observer.cancelled = [] { return true; };
  EXPECT_THROW(read_scene(folder.path() / "scene.json", observer), Cancelled);
}

TEST(Scene, NestedTooDeepIsRefused) {
  const testkit::TempDir folder;
  write_file(folder.path() / "scene.json", std::string(100000, '['));
  EXPECT_THAT([&] { read_scene(folder.path() / "scene.json"); },
              ThrowsMessage<Error>(HasSubstr("scene.json:1:33: nested more than 32 deep")));
}

TEST(Scene, NothingIsWrittenWhereANameLeadsOut) {
  const testkit::TempDir folder;
  Scene scene = plane_scene();
  scene.objects[0].textures[1].file = "../b.texture.json";
  EXPECT_THAT([&] { write_scene(folder.path() / "scene.json", scene); },
              ThrowsMessage<Error>(HasSubstr("../b.texture")));
  scene.objects[0].textures[1].file = "a.texture.json";
  EXPECT_THAT([&] { write_scene(folder.path() / "scene.json", scene); }, ThrowsMessage<Error>(HasSubstr("two files")));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(SwapTexture, KeepsMeshAndCoordinates) {
  Scene scene = plane_scene();
  const Scene before = scene;
  swap_texture(scene, 2, sine_texture(5e-5), "c.texture.json");
  EXPECT_EQ(scene.objects[0].textures[1].file, "c.texture.json");
  EXPECT_EQ(std::get<Fourier1d>(scene.objects[0].textures[1].texture.model).b_m[0], 5e-5);
  EXPECT_EQ(scene.objects[0].mesh.haptic[1].xy_mm, before.objects[0].mesh.haptic[1].xy_mm);

  scene.objects[0].textures.pop_back();
  swap_texture(scene, 2, sine_texture(6e-5), "d.texture.json");  // the mesh still has it
  ASSERT_EQ(scene.objects[0].textures.size(), 2u);
  EXPECT_THAT([&] { swap_texture(scene, 3, sine_texture(1e-5), "e.texture.json"); },
              ThrowsMessage<Error>(HasSubstr("texture 3")));
}

TEST(Material, MapThenTextureThenScene) {
  Scene scene = plane_scene();
  SceneObject& object = scene.objects[0];
  object.textures[0].texture.friction = 0.7;
  object.textures[0].texture.stiffness_N_per_m = 900.0;
  object.material.vertices.resize(5);
  object.material.vertices[0].stiffness_N_per_m = 100.0;
  object.material.vertices[2].stiffness_N_per_m = 300.0;
  const Eigen::Vector3d middle(0.25, 0.75, 0.0);  // between the vertices 0 and 2
  const Material mapped = material_at(scene, object, 0, middle);
  EXPECT_DOUBLE_EQ(mapped.stiffness_N_per_m, 250.0);
  EXPECT_EQ(mapped.friction, 0.7);
  EXPECT_TRUE(std::isnan(mapped.compliance_kc));
  object.material.vertices.clear();
  EXPECT_EQ(material_at(scene, object, 0, middle).stiffness_N_per_m, 900.0);
  EXPECT_EQ(material_at(scene, object, 1, middle).stiffness_N_per_m, 500.0);
  EXPECT_EQ(material_at(scene, object, 2, middle).friction, 0.3);
}

TEST(Material, TheRatioOfStickingToSlidingIsReadAndWritten) {
  Scene scene = plane_scene();
  SceneObject& object = scene.objects[0];
  const Eigen::Vector3d middle(0.25, 0.75, 0.0);
  EXPECT_EQ(material_at(scene, object, 0, middle).static_friction_ratio, 1.25);
  object.textures[0].texture.static_friction_ratio = 1.6;
  EXPECT_EQ(material_at(scene, object, 0, middle).static_friction_ratio, 1.6);
  object.material.vertices.resize(5);
  // Without a ratio the file is as it was before there was one.
  object.material.vertices[1].friction = 0.4;
  EXPECT_THAT(format_material_map(object.material), HasSubstr("friction\n1,,,0.4\n"));
  object.material.vertices[0].static_friction_ratio = 2.0;
  object.material.vertices[2].static_friction_ratio = 3.0;
  EXPECT_DOUBLE_EQ(material_at(scene, object, 0, middle).static_friction_ratio, 2.75);
  const MaterialMap back = parse_material_map(format_material_map(object.material), "m.csv", 5);
  EXPECT_EQ(back.vertices[2].static_friction_ratio, 3.0);
  EXPECT_TRUE(std::isnan(back.vertices[1].static_friction_ratio));
  EXPECT_EQ(back.vertices[1].friction, 0.4);
  EXPECT_THAT(
      [] {
        parse_material_map("vertex,compliance_kc,stiffness_N_per_m,friction,static_friction_ratio\n1,,,0.3,0.9\n",
                           "m.csv", 5);
      },
      ThrowsMessage<Error>(HasSubstr("'0.9' is not a ratio from 1")));
}

TEST(Material, SpreadsOverTheVerticesOfItsTexture) {
  const Scene scene = plane_scene();
  const SceneObject& object = scene.objects[0];
  const std::vector<int> textures{1, 2};
  const std::vector<Material> materials{{0.2, 100.0, std::nan("")}, {0.6, std::nan(""), std::nan("")}};
  const MaterialMap map = spread_materials(5, object.mesh.triangles, object.mesh.haptic, textures, materials);
  EXPECT_DOUBLE_EQ(map.vertices[0].compliance_kc, 0.2);
  EXPECT_DOUBLE_EQ(map.vertices[1].compliance_kc, 0.4);  // both textures meet there
  EXPECT_DOUBLE_EQ(map.vertices[3].compliance_kc, 0.6);
  EXPECT_TRUE(std::isnan(map.vertices[4].compliance_kc));
  EXPECT_DOUBLE_EQ(map.vertices[2].stiffness_N_per_m, 100.0);
  EXPECT_TRUE(std::isnan(map.vertices[3].stiffness_N_per_m));

  const MaterialMap back = parse_material_map(format_material_map(map), "m.csv", 5);
  EXPECT_DOUBLE_EQ(back.vertices[1].compliance_kc, 0.4);
  EXPECT_TRUE(std::isnan(back.vertices[4].compliance_kc));
  EXPECT_THAT([] { parse_material_map("vertex,compliance_kc,stiffness_N_per_m,friction\n5,,,\n", "m.csv", 5); },
              ThrowsMessage<Error>(HasSubstr("m.csv:2: column 'vertex'")));
  EXPECT_THAT([] { parse_material_map("vertex,compliance_kc,stiffness_N_per_m,friction\n1,1.5,,\n", "m.csv", 5); },
              ThrowsMessage<Error>(HasSubstr("'1.5' is not within 0 and 1")));
}

TEST(Scene, ALinkDoesNotLeadOut) {
  const testkit::TempDir folder;
  write_file(folder.path() / "secret.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  std::filesystem::create_directory(folder.path() / "in");
  std::filesystem::create_symlink(folder.path() / "secret.obj", folder.path() / "in" / "m.obj");
  std::filesystem::create_directory_symlink(folder.path(), folder.path() / "in" / "deep");
  for (const char* mesh : {"m.obj", "deep/secret.obj"}) {
    write_file(folder.path() / "in" / "scene.json",
               std::string(R"({"format":"asperity-scene","version":1,"mesh":")") + mesh + "\"}");
    EXPECT_THAT([&] { read_scene(folder.path() / "in" / "scene.json"); }, ThrowsMessage<Error>(HasSubstr("leads out")));
  }
}

TEST(Scene, OneImageTakenHundredsOfTimesIsRefused) {
  const testkit::TempDir folder;
  Texture texture;
  HeightMap map{2048, 2048, 0.1, 0.1, 0.0, 1e-3, 16, Border::kPeriodic, {}};
  map.level.assign(2048 * 2048, 7);
  texture.model = map;
  write_texture(folder.path() / "t.texture.json", texture);
  write_file(folder.path() / "m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  std::string scene = R"({"format":"asperity-scene","version":1,"mesh":"m.obj","textures":[)";
  for (int i = 0; i < 10; ++i) {
    scene += (i > 0 ? "," : "") + std::string(R"({"index":)") + std::to_string(i) + R"(,"file":"t.texture.json"})";
  }
  write_file(folder.path() / "scene.json", scene + "]}");
  constexpr std::uint64_t kFive_bytes = 5 * 2 * 2048 * 2048;
  EXPECT_THAT([&] { read_scene(folder.path() / "scene.json", {}, kFive_bytes); },
              ThrowsMessage<Error>(HasSubstr("take more than")));
  EXPECT_EQ(read_scene(folder.path() / "scene.json").objects[0].textures.size(), 10u);
}

TEST(Scene, TexturesDoNotShareTheirImages) {
  const testkit::TempDir folder;
  Scene scene = plane_scene();
  HeightMap map{4, 4, 1.0, 1.0, 0.0, 1e-3, 8, Border::kPeriodic, std::vector<std::uint16_t>(16, 7)};
  for (SceneTexture& texture : scene.objects[0].textures) texture.texture.model = map;
  scene.objects[0].textures[0].file = "t.texture.json";
  scene.objects[0].textures[1].file = "t.json";
  EXPECT_THAT([&] { write_scene(folder.path() / "scene.json", scene); },
              ThrowsMessage<Error>(HasSubstr("two files would be called 't.heights.png'")));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Scene, FindsWhatItWouldReplace) {
  const testkit::TempDir folder;
  const std::vector<SceneFile> files{{"a.txt", "one"}, {"b.txt", "two"}};
  EXPECT_FALSE(find_other_content(folder.path(), files));
  write_file(folder.path() / "a.txt", "one");
  EXPECT_FALSE(find_other_content(folder.path(), files));
  write_file(folder.path() / "b.txt", "owt");
  EXPECT_EQ(find_other_content(folder.path(), files), "b.txt");
}

}  // namespace
}  // namespace asperity
