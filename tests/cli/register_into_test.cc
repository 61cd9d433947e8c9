// Scans and painted textures added to a scene that is there, taken out of it and put in again.
#include <algorithm>
#include <csignal>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "asperity/geometry/pose.h"
#include "asperity/scene/read_scene.h"
#include "asperity/testkit/temp_dir.h"
#include "pebble.h"
#include "run_asperity.h"
#include "wait_until_begun.h"

namespace asperity::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using Words = std::vector<std::string>;

constexpr const char* kWave =
    R"({"format":"asperity-texture","version":1,"name":"wave","model":"fourier1d",)"
    R"("fourier1d":{"length_mm":10,"omega_rad_per_mm":0.6283185307179586,"a_m":[0,0,0,0.0001],"b_m":[0,0,0,0],"mean_m":0},)"
    R"("extra":{}})";

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

json json_of(const fs::path& file) { return json::parse(text_of(file)); }

// Two recordings that cross on a pebble, and the poses from which they are registered. Made once for all tests.
class RegisterInto : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    shared_ = new testkit::TempDir();
    write_text(*shared_ / "pebble.obj", pebble_obj());
    simulate("a", "sandpaper", through({{0.0, -0.4}, {0.9, 0.7}, {1.8, -0.3}}), 2);
    simulate("b", "sine", through({{1.6, 0.5}, {0.9, -0.2}, {0.2, 0.6}}), 4);
    ASSERT_EQ(add(Words{at("a"), at("pebble.obj"), "--mesh-unit", "mm", "-o", at("first")}, "a"), 0);
    ASSERT_EQ(add(Words{at("b"), at("pebble.obj"), "--mesh-unit", "mm", "-o", at("alone")}, "b"), 0);
  }
  static void TearDownTestSuite() {
    delete shared_;
    shared_ = nullptr;
  }
  static std::string at(const std::string& name) { return (*shared_ / name).string(); }
  std::string own(const std::string& name) const { return (dir_ / name).string(); }

  static void simulate(const std::string& name, const std::string& surface, const std::string& points, int seed) {
    const Outcome outcome =
        run({"simulate", "--surface", surface, "--probe", "open", "--speed", "40mm/s", "--seed", std::to_string(seed),
             "--mesh", at("pebble.obj"), "--mesh-unit", "mm", "--through=" + points, "-o", at(name)});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }
  // Registers from the true pose of the recording `guess`; 3 (invalid) is an outcome too.
  static int add(Words words, const std::string& guess, Outcome* outcome = nullptr) {
    const json truth = json_of(fs::path(at(guess)) / "recording.json").at("extra").at("T_mesh_world");
    std::string numbers;
    for (const json& number : truth) numbers += (numbers.empty() ? "" : ",") + number.dump();
    words.insert(words.begin(), "register");
    words.insert(words.end(), {"--guess=" + numbers});
    if (std::find(words.begin(), words.end(), "--into") != words.end()) words.push_back("--keep-invalid");
    const Outcome done = run(words);
    if (outcome != nullptr) *outcome = done;
    return done.code == 3 ? 0 : done.code;
  }
  // A copy of the first scene, to be changed.
  std::string copy(const std::string& name = "scene") const {
    fs::copy(at("first"), own(name), fs::copy_options::recursive);
    return own(name) + "/scene.json";
  }

  static testkit::TempDir* shared_;
  const testkit::TempDir dir_;
};
testkit::TempDir* RegisterInto::shared_ = nullptr;

std::vector<std::string> files_of(const fs::path& folder) {
  std::vector<std::string> out;
  for (const auto& [name, text] : contents(folder)) out.push_back(name);
  return out;
}

TEST_F(RegisterInto, ASecondScanIsTheOneThatItWouldBeAlone) {
  const std::string scene = copy();
  Outcome outcome;
  ASSERT_EQ(add({at("b"), "--into", scene}, "b", &outcome), 0);
  EXPECT_THAT(outcome.err, HasSubstr("register: what was added covers texture 1 (scan1.texture.json) on "));
  const fs::path folder = own("scene"), first = at("first"), alone = at("alone");
  EXPECT_EQ(text_of(folder / "scan1.texture.json"), text_of(first / "scan1.texture.json"));
  EXPECT_EQ(text_of(folder / "scan2.texture.json"), text_of(alone / "scan1.texture.json"));
  EXPECT_EQ(text_of(folder / "profile.csv"), text_of(first / "profile.csv"));
  EXPECT_EQ(text_of(folder / "b" / "profile.csv"), text_of(alone / "profile.csv"));

  // Both have the triangles that they have alone; where they cross, the second is on top and the first is kept.
  const Scene both = read_scene(scene), one = read_scene(first / "scene.json"), two = read_scene(alone / "scene.json");
  const SceneObject& object = both.objects.front();
  std::map<std::uint32_t, HapticTriangle> covered;
  for (const CoveredTriangle& each : object.covered) covered[each.triangle] = each.haptic;
  std::size_t crossing = 0;
  for (std::uint32_t t = 0; t < object.mesh.haptic.size(); ++t) {
    const HapticTriangle &a = one.objects[0].mesh.haptic[t], &b = two.objects[0].mesh.haptic[t],
                         &now = object.mesh.haptic[t];
    if (b.texture >= 0) {
      EXPECT_EQ(now.texture, 2);
      EXPECT_EQ(now.xy_mm, b.xy_mm);
    } else {
      EXPECT_EQ(now.texture, a.texture);
      EXPECT_EQ(now.xy_mm, a.xy_mm);
    }
    if (a.texture >= 0 && b.texture >= 0) {
      ++crossing;
      ASSERT_TRUE(covered.contains(t));
      EXPECT_EQ(covered[t].xy_mm, a.xy_mm);
    }
  }
  EXPECT_GT(crossing, 10u);
  EXPECT_EQ(covered.size(), crossing);

  const json registration = json_of(folder / "registration.json");
  ASSERT_EQ(registration.at("scans").size(), 2u);
  EXPECT_EQ(registration.at("scans")[0].at("name"), "a");
  EXPECT_EQ(registration.at("scans")[0].at("T_mesh_world"),
            json_of(first / "registration.json").at("scans")[0].at("T_mesh_world"));
  EXPECT_EQ(registration.at("registered"), json::array({"b"}));
  const json source = json_of(scene).at("textures")[1].at("source");
  EXPECT_EQ(source.at("kind"), "scan");
  EXPECT_EQ(source.at("name"), "b");
  EXPECT_THAT(source.at("checksum").get<std::string>(), ::testing::MatchesRegex("md5:[0-9a-f]{32}"));
  EXPECT_FALSE(source.contains("date"));

  // Taken out again: the first scene's files, byte for byte.
  const Outcome removed = run({"register", "--remove", "b", "--into", scene});
  ASSERT_EQ(removed.code, 0) << removed.err;
  for (const auto& [name, text] : contents(first)) {
    if (name != "registration.json") {
      EXPECT_EQ(text_of(folder / name), text) << name;
    }
  }
  EXPECT_EQ(files_of(folder), files_of(first));
  EXPECT_EQ(json_of(folder / "registration.json").at("scans").size(), 1u);
  // And it is still ours: another registration may replace it.
  EXPECT_EQ(add({at("a"), at("pebble.obj"), "--mesh-unit", "mm", "-o", own("scene")}, "a"), 0);
}

TEST_F(RegisterInto, TheSameNameAgainReplacesTheScan) {
  const std::string scene = copy();
  ASSERT_EQ(add({at("b"), "--into", scene, "--date", "2026-11-24"}, "b"), 0);
  const std::vector<std::pair<std::string, std::string>> before = contents(own("scene"));
  // The same input gives the same bytes, index and order kept.
  ASSERT_EQ(add({at("b"), "--into", scene, "--date", "2026-11-24"}, "b"), 0);
  EXPECT_EQ(contents(own("scene")), before);
  EXPECT_EQ(json_of(scene).at("textures")[1].at("source").at("date"), "2026-11-24");
  // The first again, by a coarser series: its index and place under the second stay.
  ASSERT_EQ(add({at("a"), "--into", scene, "--set", "texture.coefficients_per_mm=2"}, "a"), 0);
  const json after = json_of(scene);
  ASSERT_EQ(after.at("textures").size(), 2u);
  EXPECT_EQ(after.at("textures")[0].at("index"), 1);
  EXPECT_EQ(after.at("textures")[0].at("source").at("settings").at("texture.coefficients_per_mm"), 2);
  const fs::path folder = own("scene");
  EXPECT_NE(text_of(folder / "scan1.texture.json"), text_of(fs::path(at("first")) / "scan1.texture.json"));
  for (const auto& [name, text] : before) {
    if (name == "textured.obj" || name == "scan2.texture.json" || name == "b/profile.csv") {
      EXPECT_EQ(text_of(folder / name), text) << name;
    }
  }
  // What was measured of it was beside the scene, and is in its folder now.
  EXPECT_THAT(files_of(folder), Contains("a/profile.csv"));
  EXPECT_THAT(files_of(folder), Not(Contains("profile.csv")));
}

TEST_F(RegisterInto, UnderLeavesWhatIsRenderedAsItWas) {
  const std::string scene = copy();
  Outcome outcome;
  ASSERT_EQ(add({at("b"), "--into", scene, "--under"}, "b", &outcome), 0);
  EXPECT_THAT(outcome.err, Not(HasSubstr("covers texture")));
  const Scene both = read_scene(scene), one = read_scene(fs::path(at("first")) / "scene.json");
  for (std::size_t t = 0; t < one.objects[0].mesh.haptic.size(); ++t) {
    if (one.objects[0].mesh.haptic[t].texture == 1) {
      EXPECT_EQ(both.objects[0].mesh.haptic[t].texture, 1);
    }
  }
  EXPECT_EQ(json_of(scene).at("textures")[1].at("order"), -1);
  EXPECT_FALSE(both.objects[0].covered.empty());
}

TEST_F(RegisterInto, PaintingAndScansStayWhenTheOtherIsAdded) {
  const std::string scene = copy();
  write_text(dir_ / "wave.texture.json", kWave);
  const std::string points = through({{0.3, 0.5}, {1.2, 0.4}});
  const auto paint_into = [&](const std::string& into) {
    return run({"paint", "--into", into, "--through=" + points, "--texture", own("wave.texture.json")});
  };
  const Outcome painted = paint_into(scene);
  ASSERT_EQ(painted.code, 0) << painted.err;
  const fs::path folder = own("scene"), first = at("first");
  EXPECT_EQ(text_of(folder / "scan1.texture.json"), text_of(first / "scan1.texture.json"));
  EXPECT_EQ(text_of(folder / "profile.csv"), text_of(first / "profile.csv"));
  EXPECT_EQ(json_of(folder / "registration.json").at("scans").size(), 1u);
  EXPECT_EQ(json_of(scene).at("textures")[1].at("source").at("strokes_mesh_m")[0].size(), 2u);
  // A scan added to that, and taken out: the painted scene again.
  const std::string obj = text_of(folder / "textured.obj"), material = text_of(folder / "material.csv");
  ASSERT_EQ(add({at("b"), "--into", scene}, "b"), 0);
  EXPECT_EQ(json_of(scene).at("textures").size(), 3u);
  ASSERT_EQ(run({"register", "--remove", "b", "--into", scene}).code, 0);
  EXPECT_EQ(text_of(folder / "textured.obj"), obj);
  EXPECT_EQ(text_of(folder / "material.csv"), material);
  EXPECT_EQ(json_of(scene).at("textures").size(), 2u);

  // A painted mesh without any scan takes one.
  ASSERT_EQ(run({"paint", at("pebble.obj"), "--mesh-unit", "mm", "--through=" + through({{0.3, 0.5}, {1.2, 0.4}}, 1e3),
                 "--texture", own("wave.texture.json"), "-o", own("painted")})
                .code,
            0);
  ASSERT_EQ(add({at("a"), "--into", own("painted") + "/scene.json"}, "a"), 0);
  const json scans = json_of(fs::path(own("painted")) / "registration.json").at("scans");
  ASSERT_EQ(scans.size(), 1u);
  EXPECT_EQ(scans[0].at("texture"), 2);
  EXPECT_TRUE(fs::exists(fs::path(own("painted")) / "a" / "profile.csv"));
}

TEST_F(RegisterInto, AnInvalidPoseLeavesTheSceneAsItWas) {
  const std::string scene = copy();
  const std::vector<std::pair<std::string, std::string>> before = contents(own("scene"));
  // A straight path of 10 mm fits anywhere.
  std::string points = "px_m,py_m,pz_m\n";
  for (int i = 0; i < 60; ++i) points += std::to_string(0.01 * i / 60.0) + ",0,0\n";
  write_text(dir_ / "line.csv", points);
  write_text(dir_ / "wave.texture.json", kWave);
  const Words words{"register", own("line.csv"), "--into", scene, "--texture", own("wave.texture.json")};
  const Outcome invalid = run(words);
  EXPECT_EQ(invalid.code, 3) << invalid.err;
  EXPECT_THAT(invalid.err,
              HasSubstr("scene.json: unchanged, because the pose is invalid; --keep-invalid adds the scan"));
  EXPECT_THAT(invalid.out, Not(HasSubstr("results in")));
  EXPECT_EQ(contents(own("scene")), before);
  Words kept = words;
  kept.push_back("--keep-invalid");
  EXPECT_EQ(run(kept).code, 3);
  EXPECT_EQ(json_of(scene).at("textures").size(), 2u);
  EXPECT_EQ(run({"register", at("b"), at("pebble.obj"), "-o", own("out"), "--keep-invalid"}).code, 2);
}

TEST_F(RegisterInto, StrangersFilesAreKeptAndNamed) {
  const std::string scene = copy();
  write_text(dir_ / "scene" / "notes.txt", "mine");
  fs::create_directories(dir_ / "scene" / "b");
  write_text(dir_ / "scene" / "b" / "photo.txt", "mine too");
  Outcome outcome;
  ASSERT_EQ(add({at("b"), "--into", scene}, "b", &outcome), 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("notes.txt is not a file of asperity; it was kept"));
  EXPECT_EQ(text_of(dir_ / "scene" / "notes.txt"), "mine");
  EXPECT_EQ(text_of(dir_ / "scene" / "b" / "photo.txt"), "mine too");
  ASSERT_EQ(run({"register", "--remove", "b", "--into", scene}).code, 0);
  EXPECT_EQ(text_of(dir_ / "scene" / "notes.txt"), "mine");
  EXPECT_FALSE(fs::exists(dir_ / "scene" / "b" / "profile.csv"));
}

TEST_F(RegisterInto, WhatDoesNotFitIsRefusedAndNothingIsChanged) {
  const std::string scene = copy();
  const std::vector<std::pair<std::string, std::string>> before = contents(own("scene"));
  const auto refused = [&](const Words& words, int code, const std::string& message) {
    Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, code) << message << ": " << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(message));
    EXPECT_EQ(contents(own("scene")), before);
  };
  std::string other = pebble_obj();
  other.replace(other.find("v "), 2, "v 1");
  write_text(dir_ / "other.obj", other);
  refused({"register", at("b"), own("other.obj"), "--into", scene}, 1, "other.obj: is not the mesh of");
  refused({"register", at("b"), "--into", scene, "--mesh-unit", "cm"}, 2, "--mesh-unit");
  refused({"register", "--remove", "c", "--into", scene}, 1, "no scan 'c'; its scans are a");
  refused({"register", "--remove", "a"}, 2, "--into");
  refused({"register", at("b"), "--into", scene, "-o", own("out")}, 2, "--into");
  refused({"register", at("b"), "--into", scene, "--date", "today"}, 2, "today");
  refused({"register", "--into", scene}, 2, "PATH");
  refused({"register", at("b"), "--into", at("pebble.obj")}, 2, "--into");
  refused({"paint", at("pebble.obj"), "--into", scene, "--through=0,0,0;1,0,0", "--texture", "x"}, 2, "--into");
  // A scene that somebody made by hand is not replaced.
  fs::create_directories(dir_ / "hand");
  write_text(dir_ / "hand" / "pebble.obj", pebble_obj());
  write_text(dir_ / "hand" / "scene.json",
             R"({"format":"asperity-scene","version":1,"mesh":"pebble.obj","unit_m":0.001})");
  const std::vector<std::pair<std::string, std::string>> hand = contents(own("hand"));
  Outcome outcome;
  EXPECT_EQ(add({at("b"), "--into", own("hand") + "/scene.json"}, "b", &outcome), 1);
  EXPECT_THAT(outcome.err, HasSubstr("not written by asperity"));
  EXPECT_EQ(contents(own("hand")), hand);
  // Into a folder of its own it is added to.
  EXPECT_EQ(add({at("b"), own("hand") + "/scene.json", "-o", own("added")}, "b", &outcome), 0) << outcome.err;
  EXPECT_EQ(json_of(dir_ / "added" / "scene.json").at("textures").size(), 1u);
}

TEST_F(RegisterInto, InterruptedTheOldSceneIsWhole) {
  const std::string scene = copy();
  const std::vector<std::pair<std::string, std::string>> before = contents(own("scene"));
  const Outcome stopped = run_and_meddle({"register", at("b"), "--into", scene, "--keep-invalid"}, [&](pid_t process) {
    EXPECT_TRUE(wait_until_begun(own("scene")));
    ::kill(process, SIGTERM);
  });
  if (stopped.code != 0 && stopped.code != 3) {
    EXPECT_EQ(contents(own("scene")), before);
  } else {
    EXPECT_EQ(json_of(scene).at("textures").size(), 2u);
  }
  // Nothing half-made is left beside it.
  EXPECT_EQ(std::distance(fs::directory_iterator(dir_.path()), {}), 1);
}

// Coordinates of a mesh that nobody lists were dropped once.
TEST_F(RegisterInto, AMeshKeepsTheCoordinatesThatItHas) {
  Outcome outcome;
  ASSERT_EQ(add({at("b"), at("first") + "/textured.obj", "--mesh-unit", "mm", "-o", own("out")}, "b", &outcome), 0)
      << outcome.err;
  const Scene both = read_scene(dir_ / "out" / "scene.json"), one = read_scene(fs::path(at("first")) / "scene.json");
  std::set<int> textures;
  for (std::size_t t = 0; t < one.objects[0].mesh.haptic.size(); ++t) {
    const HapticTriangle &a = one.objects[0].mesh.haptic[t], &now = both.objects[0].mesh.haptic[t];
    textures.insert(now.texture);
    if (now.texture == 1) {
      EXPECT_EQ(now.xy_mm, a.xy_mm);
    }
  }
  EXPECT_EQ(textures, (std::set<int>{-1, 1, 2}));
}

}  // namespace
}  // namespace asperity::cli
