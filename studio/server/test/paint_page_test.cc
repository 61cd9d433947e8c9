#include "paint/paint_page.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "asperity/json/parse_json.h"
#include "asperity/scene/read_scene.h"
#include "asperity/texture/texture_file.h"
#include "page_rig.h"
#include "read_block.h"

namespace asperity::studio {
namespace {

// A flat plate of 40 mm by 20 mm in millimetres, one quad a millimetre.
void write_plate(const std::filesystem::path& file) {
  std::ofstream out(file);
  for (int y = 0; y <= 20; ++y) {
    for (int x = 0; x <= 40; ++x) out << "v " << x << ' ' << y << " 0\n";
  }
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 40; ++x) {
      const int a = 41 * y + x + 1;
      out << "f " << a << ' ' << a + 1 << ' ' << a + 42 << ' ' << a + 41 << '\n';
    }
  }
}

void write_wave(const std::filesystem::path& file) {
  Texture texture;
  texture.name = "wave";
  Fourier1d wave;
  wave.length_mm = 2.0;
  wave.a_m = {0.0};
  wave.b_m = {1e-5};
  texture.model = wave;
  write_texture(file, texture);
}

class PaintPageTest : public ::testing::Test, protected PageRig<> {
 protected:
  PaintPageTest() {
    write_plate(folder / "plate.obj");
    write_wave(folder / "wave.texture.json");
    open(make_paint_page(shared));
    document.edit("/paint/object", "plate.obj", "open");
    document.edit("/paint/unit_m", 0.001, "unit");
    document.edit("/paint/half_width_mm", 3.0, "width");
  }

  void add_stroke(const char* picks) {
    Json stroke;
    stroke["texture"] = "wave.texture.json";
    stroke["index"] = 1;
    stroke["picks_m"] = parse_json(picks);
    document.edit("/paint/strokes/-", stroke, "stroke");
  }
};

TEST_F(PaintPageTest, ShowsCoordinatesThatKeepLengthsOnAPlane) {
  add_stroke("[[0.005,0.01,0],[0.035,0.01,0]]");
  const FakeHub::Answer answer = call("paint.show");
  ASSERT_EQ(answer.error, "");
  const Json head = ReadBlock(answer.block).head;
  EXPECT_EQ(head["strokes"].size(), 1U);
  EXPECT_NEAR(head["strokes"][0]["path_length_m"].get<double>(), 0.030, 1e-9);
  EXPECT_EQ(head["textures"][0]["name"], "wave");
  const auto texture = ReadBlock(answer.block).array<std::int32_t>("texture");
  const auto stretch = ReadBlock(answer.block).array<float>("stretch");
  ASSERT_EQ(texture.size(), 1600U);
  std::size_t painted = 0;
  for (std::size_t t = 0; t < texture.size(); ++t) {
    if (texture[t] < 0) continue;
    ++painted;
    EXPECT_NEAR(std::abs(stretch[t]), 1.0, 1e-3) << t;  // a plane is laid out without stretching it
  }
  EXPECT_EQ(painted, head["strokes"][0]["triangles"].get<std::size_t>());
  EXPECT_GT(painted, 2U * 30U * 5U);  // about 30 mm by 6 mm
}

TEST_F(PaintPageTest, WritesWhatIsReadAsAScene) {
  add_stroke("[[0.005,0.01,0],[0.035,0.01,0]]");
  const FakeHub::Answer answer = call("paint.write", Json{{"name", "painted"}});
  ASSERT_EQ(answer.error, "");
  EXPECT_EQ(answer.result["scene"], "painted/scene.json");
  const Scene scene = read_scene(folder / "painted/scene.json");
  EXPECT_EQ(scene.objects.front().textures.front().texture.name, "wave");
  EXPECT_EQ(scene.objects.front().unit_m, 0.001);
  EXPECT_TRUE(std::filesystem::exists(folder / "painted/paint.json"));
  EXPECT_THAT(call("paint.write", Json{{"name", "painted"}}).error, ::testing::HasSubstr("exists already"));
  EXPECT_EQ(call("paint.write", Json{{"name", "painted"}, {"replace", true}}).error, "");
  const FakeHub::Answer exported =
      call("paint.export", Json{{"source", "painted/scene.json"}, {"format", "gltf"}, {"name", "painted-gltf"}});
  ASSERT_EQ(exported.error, "");
  EXPECT_FALSE(exported.result["files"].empty());
}

TEST_F(PaintPageTest, AStrokeThatCannotBePaintedSaysWhyAndTheOthersStay) {
  add_stroke("[[0.005,0.01,0],[0.035,0.01,0]]");
  add_stroke("[[0.005,0.01,0]]");
  const Json head = ReadBlock(call("paint.show").block).head;
  EXPECT_TRUE(head["strokes"][0].contains("path_length_m"));
  EXPECT_THAT(head["strokes"][1]["fault"].get<std::string>(), ::testing::HasSubstr("at least two"));
  EXPECT_THAT(call("paint.write", Json{{"name", "painted"}}).error, ::testing::HasSubstr("at least two"));
  EXPECT_FALSE(std::filesystem::exists(folder / "painted"));
}

TEST_F(PaintPageTest, RefusesNonsenseAndStrangersFolders) {
  for (const char* value :
       {"7", "\"x\"", "[1]", "[{}]", R"([{"texture":1,"index":1,"picks_m":[]}])",
        R"([{"texture":"w","index":-1,"picks_m":[]}])", R"([{"texture":"w","index":1,"picks_m":[[1,2]]}])",
        R"([{"texture":"w","index":1,"picks_m":[[1,2,"x"]]}])"}) {
    EXPECT_THROW(document.edit("/paint/strokes", parse_json(value), "x"), Error) << value;
  }
  add_stroke("[[0.005,0.01,0],[0.035,0.01,0]]");
  std::filesystem::create_directory(folder / "mine");
  std::ofstream(folder / "mine/notes.txt") << "do not lose";
  EXPECT_NE(call("paint.write", Json{{"name", "mine"}, {"replace", true}}).error, "");
  EXPECT_TRUE(std::filesystem::exists(folder / "mine/notes.txt"));
  EXPECT_NE(call("paint.write", Json{{"name", "../out"}}).error, "");
  EXPECT_NE(call("paint.texture", Json{{"file", "/etc/passwd"}}).error, "");
  EXPECT_NE(call("paint.export", Json{{"source", "plate.obj"}, {"format", "exe"}, {"name", "x"}}).error, "");
}

TEST_F(PaintPageTest, PreviewsAPath) {
  const FakeHub::Answer answer = call("paint.path", Json{{"picks_m", parse_json("[[0.005,0.005,0],[0.005,0.015,0]]")}});
  ASSERT_EQ(answer.error, "");
  EXPECT_NEAR(ReadBlock(answer.block).head["length_m"].get<double>(), 0.010, 1e-9);
}

TEST_F(PaintPageTest, ShowsATexture) {
  const FakeHub::Answer answer = call("paint.texture", Json{{"file", "wave.texture.json"}});
  ASSERT_EQ(answer.error, "");
  const auto height_m = ReadBlock(answer.block).array<float>("height_m");
  ASSERT_EQ(height_m.size(), 4096U);
  EXPECT_NEAR(*std::max_element(height_m.begin(), height_m.end()), 1e-5, 1e-8);
}

}  // namespace
}  // namespace asperity::studio
