#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "asperity/testkit/temp_dir.h"
#include "run_asperity.h"

namespace asperity::cli {
namespace {

using Json = nlohmann::json;

// A plane of 20 × 10 cells of 2 mm, in millimetres.
std::string plane_obj() {
  std::string out;
  for (int j = 0; j <= 10; ++j) {
    for (int i = 0; i <= 20; ++i) out += "v " + std::to_string(2 * i) + " " + std::to_string(2 * j) + " 0\n";
  }
  for (int j = 0; j < 10; ++j) {
    for (int i = 0; i < 20; ++i) {
      const int a = 21 * j + i + 1;
      out += "f " + std::to_string(a) + " " + std::to_string(a + 1) + " " + std::to_string(a + 22) + " " +
             std::to_string(a + 21) + "\n";
    }
  }
  return out;
}

constexpr const char* kTexture =
    R"({"format":"asperity-texture","version":1,"name":"wave","model":"fourier1d",)"
    R"("fourier1d":{"length_mm":10,"omega_rad_per_mm":0.6283185307179586,"a_m":[0,0,0,0.0001],"b_m":[0,0,0,0],"mean_m":0},)"
    R"("extra":{}})";

std::string content_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

class PaintCommands : public testing::Test {
 protected:
  PaintCommands() {
    write_text(path("plane.obj"), plane_obj());
    write_text(path("wave.texture.json"), kTexture);
  }
  std::string path(const std::string& name) const { return (dir_ / name).string(); }
  Outcome paint(const std::string& mesh, const std::string& through) const {
    return run({"paint", mesh, "--through", through, "--texture", path("wave.texture.json"), "--mesh-unit", "mm", "-o",
                path("out"), "--json"});
  }

  testkit::TempDir dir_;
};

TEST_F(PaintCommands, PointsAreInTheMeshsUnit) {
  const Outcome outcome = paint(path("plane.obj"), "5,7,0; 35,7,1");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json result = Json::parse(outcome.out);
  EXPECT_NEAR(result.at("path_length_m").get<double>(), 0.03, 1e-12);
  EXPECT_NEAR(result.at("pick_distance_m").at(1).get<double>(), 1e-3, 1e-12);
  EXPECT_NEAR(result.at("warp").at("stretch_max").get<double>(), 1.0, 1e-6);
}

TEST_F(PaintCommands, APaintedSceneIsPaintedOnAndExported) {
  ASSERT_EQ(paint(path("plane.obj"), "5,7,0;35,7,0").code, 0);
  const Outcome again = paint(path("out/scene.json"), "20,2,0;20,18,0");
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(Json::parse(again.out).at("texture").at("index"), 2);
  EXPECT_GT(Json::parse(again.out).at("painted_over").get<int>(), 0);
  for (const std::string format : {"obj", "gltf", "usda", "png", "wav", "ahap", "haps", "hjif", "hmpg", "x3p", "stl"}) {
    const Outcome outcome = run({"export", path("out"), "--to", format, "--speed", "50mm/s"});
    EXPECT_EQ(outcome.code, 0) << format << ": " << outcome.err;
    EXPECT_TRUE(std::filesystem::exists(path("out-" + format))) << format;
  }
  EXPECT_EQ(run({"export", path("out"), "--to", "obj"}).code, 0);  // replaces its own folder
}

// What an invalid measurement became keeps its verdict on the way to other programs.
TEST_F(PaintCommands, AnExportSaysThatItsSourceIsInvalid) {
  std::filesystem::create_directory(path("result"));
  write_text(path("result/texture.json"), kTexture);
  write_text(path("result/result.json"),
             R"({"format":"asperity-result","trustworthy":false,"verdict":"invalid: the tip was in the air"})");
  for (const std::string format : {"hjif", "hmpg", "ahap", "wav", "png"}) {
    const Outcome outcome = run({"export", path("result"), "--to", format, "-o", path("to-" + format)});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.out + outcome.err, testing::HasSubstr("the tip was in the air"));
    const Json about = Json::parse(content_of(path("to-" + format + "/export.json")));
    EXPECT_THAT(about.at("warnings").at(0).get<std::string>(), testing::HasSubstr("the tip was in the air"));
  }
  EXPECT_THAT(content_of(path("to-hjif/texture.hjif")), testing::HasSubstr("the tip was in the air"));
  EXPECT_THAT(content_of(path("to-hmpg/texture.hmpg")), testing::HasSubstr("the tip was in the air"));
}

TEST_F(PaintCommands, AnUnlikelyUnitIsAskedForBeforeAnythingIsDone) {
  const std::vector<std::string> words{"paint",     path("plane.obj"),         "--through", "5,5,0;30,15,0",
                                       "--texture", path("wave.texture.json"), "-o",        path("out")};
  const Outcome outcome = run(words);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, testing::HasSubstr("plane.obj: the mesh is 44.7 m large if its unit is a metre; state its "
                                              "unit: --mesh-unit mm makes it 44.7 mm"));
  EXPECT_FALSE(std::filesystem::exists(path("out")));
  std::vector<std::string> metres = words;
  metres.insert(metres.end(), {"--mesh-unit", "m"});
  EXPECT_EQ(run(metres).code, 0);
  const Outcome scan = run({"register", path("plane.obj"), path("plane.obj"), "-o", path("reg")});
  EXPECT_THAT(scan.err, testing::HasSubstr("state its unit"));
}

TEST_F(PaintCommands, APickOffTheSurfaceIsToldWithItsDistance) {
  const Outcome outcome = paint(path("plane.obj"), "5,5,0;30,15,7");
  EXPECT_EQ(outcome.code, 0);
  const Json json = Json::parse(outcome.out);
  ASSERT_EQ(json["problems"].size(), 1U) << json["problems"];
  EXPECT_EQ(json["problems"][0]["kind"], "pick_off_surface");
  EXPECT_THAT(json["problems"][0]["message"].get<std::string>(),
              testing::HasSubstr("point 2 is 7 mm from the surface"));
}

TEST_F(PaintCommands, RefuseWhatCannotBeMeant) {
  EXPECT_EQ(paint(path("plane.obj"), "5,7;35,7").code, 2);
  EXPECT_EQ(paint(path("plane.obj"), "5,7,0").code, 2);
  EXPECT_EQ(paint(path("none.obj"), "5,7,0;35,7,0").code, 1);
  EXPECT_EQ(run({"export", path("plane.obj"), "--to", "doc"}).code, 2);
  EXPECT_EQ(run({"export", path("plane.obj"), "--to", "png"}).code, 1);  // it has no textures
  // In metres it would be as large as a house.
  const Outcome metres = run({"export", path("plane.obj"), "--to", "stl", "-o", path("metres")});
  EXPECT_EQ(metres.code, 1);
  EXPECT_THAT(metres.err,
              testing::AllOf(testing::HasSubstr("plane.obj: the mesh is"), testing::HasSubstr("--mesh-unit")));
  EXPECT_FALSE(std::filesystem::exists(path("metres")));
  EXPECT_EQ(run({"export", path("plane.obj"), "--mesh-unit", "mm", "--to", "stl", "-o", path("metres")}).code, 0);
  std::filesystem::create_directory(path("strange"));
  write_text(path("strange/mine.txt"), "kept\n");
  EXPECT_EQ(run({"export", path("wave.texture.json"), "--to", "wav", "-o", path("strange")}).code, 1);
  ASSERT_EQ(paint(path("plane.obj"), "5,7,0;35,7,0").code, 0);
  write_text(path("out/mine.txt"), "kept\n");
  const Outcome added = paint(path("plane.obj"), "5,7,0;35,7,0");
  EXPECT_EQ(added.code, 1);
  EXPECT_THAT(added.err, testing::HasSubstr("out: the file mine.txt was not written by asperity; nothing was changed"));
  EXPECT_EQ(content_of(path("out/mine.txt")), "kept\n");
}

// Nothing of an earlier texture is covered without a word.
TEST_F(PaintCommands, ACoveredTextureIsNamed) {
  const Outcome first = paint(path("plane.obj"), "5,7,0;35,7,0");
  ASSERT_EQ(first.code, 0) << first.err;
  EXPECT_EQ(first.err, "");
  EXPECT_TRUE(Json::parse(first.out).at("covered").empty());
  const auto into = [&](const std::string& through, const std::string& extra = "--quiet") {
    return run({"paint", "--into", path("out/scene.json"), "--mesh-unit", "mm", "--through", through, "--texture",
                path("wave.texture.json"), "--json", extra});
  };
  const Outcome across = into("20,2,0;20,18,0");
  ASSERT_EQ(across.code, 0) << across.err;
  const Json json = Json::parse(across.out);
  ASSERT_EQ(json.at("covered").size(), 1U);
  const Json& covered = json.at("covered")[0];
  EXPECT_EQ(covered.at("index"), 1);
  EXPECT_EQ(covered.at("file"), "wave.texture.json");
  EXPECT_EQ(covered.at("triangles"), json.at("painted_over"));
  EXPECT_EQ(covered.at("triangles").get<int>() + covered.at("rendered_still").get<int>(),
            Json::parse(first.out).at("triangles").get<int>());
  EXPECT_THAT(across.err, testing::HasSubstr("paint: texture 2 covers texture 1 (wave.texture.json) on " +
                                             std::to_string(covered.at("triangles").get<int>()) + " triangles"));
  EXPECT_EQ(Json::parse(content_of(path("out/paint.json"))).at("covered"), json.at("covered"));
  // At the very same place: nothing of both is left in view.
  const Outcome same = into("5,7,0;35,7,0");
  ASSERT_EQ(same.code, 0) << same.err;
  EXPECT_THAT(same.err, testing::HasSubstr("no other triangle shows texture 1"));
  const Outcome under = into("5,7,0;35,7,0", "--under");
  ASSERT_EQ(under.code, 0) << under.err;
  EXPECT_TRUE(Json::parse(under.out).at("covered").empty());
  EXPECT_EQ(under.err, "");
}

// What is printed is relative to what was given, and a scene may be moved.
TEST_F(PaintCommands, PathsAreThoseThatWereGiven) {
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(dir_.path());
  const Outcome painted = run({"paint", "plane.obj", "--through", "5,7,0;35,7,0", "--texture", "wave.texture.json",
                               "--mesh-unit", "mm", "-o", "out"});
  const Outcome into = run({"paint", "--into", "out/scene.json", "--mesh-unit", "mm", "--through", "20,2,0;20,18,0",
                            "--texture", "wave.texture.json"});
  const Outcome exported = run({"export", "out/", "--to", "obj"});
  const Outcome as_json = run({"export", "out", "--to", "obj", "--json"});
  std::filesystem::current_path("out");
  const Outcome from_inside = run({"export", ".", "--to", "stl"});
  std::filesystem::current_path(before);
  for (const Outcome* outcome : {&painted, &into, &exported, &as_json, &from_inside}) {
    EXPECT_EQ(outcome->code, 0) << outcome->err;
    EXPECT_THAT(outcome->out + outcome->err, testing::Not(testing::HasSubstr(dir_.path().string())));
  }
  EXPECT_THAT(into.out, testing::HasSubstr("scene in out\n"));
  EXPECT_THAT(exported.out, testing::HasSubstr("in out-obj\n"));
  EXPECT_EQ(Json::parse(as_json.out).at("folder"), "out-obj");
  EXPECT_TRUE(std::filesystem::exists(path("out-stl/textured.stl")));
  for (const auto& entry : std::filesystem::recursive_directory_iterator(path("out"))) {
    if (!entry.is_regular_file()) continue;
    EXPECT_THAT(content_of(entry.path().string()), testing::Not(testing::HasSubstr(dir_.path().string())))
        << entry.path().string();
  }
  std::filesystem::create_directory(path("elsewhere"));
  std::filesystem::rename(path("out"), path("elsewhere/moved"));
  EXPECT_EQ(run({"export", path("elsewhere/moved"), "--to", "gltf"}).code, 0);
}

TEST_F(PaintCommands, AnExportNamesWhatThereIsAndWhatItCanBecome) {
  std::filesystem::create_directory(path("result"));
  write_text(path("result/texture.json"), kTexture);
  write_text(path("result/profile.csv"), "s_m,height_m\n0,0\n0.001,1e-6\n0.002,0\n");
  const Outcome stl = run({"export", path("result"), "--to", "stl"});
  EXPECT_EQ(stl.code, 1);
  EXPECT_THAT(stl.err, testing::HasSubstr("result: stl needs a mesh, and there is none, only texture.json (fourier1d) "
                                          "and profile.csv. It can be exported to png, wav, ahap, haps, hjif, hmpg, "
                                          "x3p, sdf, sdf-binary, gsf"));
  EXPECT_FALSE(std::filesystem::exists(path("result-stl")));
  const Outcome png = run({"export", path("plane.obj"), "--to", "png"});
  EXPECT_EQ(png.code, 1);
  EXPECT_THAT(png.err, testing::HasSubstr("plane.obj: png needs a texture, and there is none, only a mesh "
                                          "(plane.obj). It can be exported to obj, gltf, usda, stl"));
  const Outcome sdf = run({"export", path("wave.texture.json"), "--to", "sdf"});
  EXPECT_EQ(sdf.code, 1);
  EXPECT_THAT(sdf.err, testing::HasSubstr("sdf needs a profile.csv or an areal map, and there is none, only "
                                          "wave.texture.json (fourier1d)"));
}

}  // namespace
}  // namespace asperity::cli
