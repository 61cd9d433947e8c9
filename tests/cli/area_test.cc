#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "asperity/testkit/temp_dir.h"
#include "run_asperity.h"

namespace asperity::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

json read_json(const fs::path& file) {
  std::ifstream in(file);
  return json::parse(in);
}

// What `register` leaves of strokes over a plate of 30 x 30 mm, made by hand: heights of known waves, each stroke with
// an offset of its own. `own` gives every stroke waves of its own instead.
class Area : public testing::Test {
 protected:
  static double relief_m(double x_mm, double y_mm, int of) {
    std::mt19937 random(static_cast<unsigned>(of));
    std::uniform_real_distribution<double> part(0.0, 1.0);
    double out = 0.0;
    for (int i = 0; i < 60; ++i) {
      const double f = 0.3 + 0.7 * part(random), angle = 6.283185 * part(random), phase = 6.283185 * part(random);
      out += 5e-6 * std::cos(6.283185 * f * (x_mm * std::cos(angle) + y_mm * std::sin(angle)) + phase);
    }
    return out;
  }

  void SetUp() override {
    std::ostringstream mesh;
    for (int r = 0; r <= 30; ++r)
      for (int c = 0; c <= 30; ++c) mesh << "v " << c << ' ' << r << " 0\n";
    for (int r = 0; r < 30; ++r) {
      for (int c = 0; c < 30; ++c) {
        const int a = 31 * r + c + 1;
        mesh << "f " << a << ' ' << a + 1 << ' ' << a + 32 << "\nf " << a << ' ' << a + 32 << ' ' << a + 31 << '\n';
      }
    }
    mesh_ = mesh.str();
  }

  void write_registered(const std::string& name, bool own) const {
    const fs::path folder = dir_ / name;
    fs::create_directories(folder);
    write_text(folder / "plate.obj", mesh_);
    write_text(folder / "scene.json",
               R"({"format": "asperity-scene", "version": 1, "mesh": "plate.obj", "unit_m": 0.001, "textures": []})");
    json registration{
        {"format", "asperity-registration"}, {"version", 1}, {"trustworthy", true}, {"scans", json::array()}};
    for (int k = 0; k < 16; ++k) {
      const std::string scan = "scan" + std::to_string(k);
      registration["scans"].push_back({{"name", scan}});
      fs::create_directories(folder / scan);
      std::ostringstream path, profile;
      path << "s_m,px_m,py_m,pz_m,triangle\n";
      profile << "s_m,height_m,sigma_m,texture_m,force_N,speed_mps,texture_sigma_m\n";
      const double lane = 10.2 + 1.2 * (k % 8);
      for (int i = 0; i <= 240; ++i) {
        const double s = 0.05 * i, along = 8.0 + s;
        const double x = k < 8 ? along : lane, y = k < 8 ? lane : along;
        const int column = static_cast<int>(x), row = static_cast<int>(y);
        const int triangle = 2 * (30 * row + column) + (x - column < y - row ? 1 : 0);
        path << 1e-3 * s << ',' << 1e-3 * x << ',' << 1e-3 * y << ",0," << triangle << '\n';
        const double height = relief_m(x, y, own ? 100 + k : 1) + 2e-5 * (k % 5);
        profile << 1e-3 * s << ',' << height << ",1e-5,0,0.5,0.02,2e-6\n";
      }
      write_text(folder / scan / "path.csv", path.str());
      write_text(folder / scan / "profile.csv", profile.str());
    }
    write_text(folder / "registration.json", registration.dump());
  }

  std::string path(const std::string& name) const { return (dir_ / name).string(); }

  std::string mesh_;
  const testkit::TempDir dir_;
};

TEST_F(Area, ManyStrokesBecomeOneTexture) {
  write_registered("registered", false);
  const Outcome outcome = run(
      {"area", path("registered"), "-o", path("out"), "--set", "map.shift_mm=0", "--set", "map.held_out=4", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json area = json::parse(outcome.out);
  EXPECT_EQ(area.at("texture"), "area.texture.json");
  EXPECT_TRUE(area.at("trustworthy").get<bool>());
  // A plate is its own plane.
  EXPECT_NEAR(area.at("parametrisation").at("stretch_max").get<double>(), 1.0, 1e-6);
  EXPECT_EQ(area.at("parametrisation").at("flipped"), 0);
  // Strokes left out are predicted from others up to 2.4 mm away, waves go down to 1 mm.
  EXPECT_GT(area.at("map").at("agreement").get<double>(), 0.5);
  // 60 waves of 5 µm: 27 µm RMS.
  EXPECT_NEAR(area.at("map").at("rms_m").get<double>(), 27.4e-6, 7e-6);
  for (const char* file : {"scene.json", "area.json", "area.texture.json", "area.surface.csv", "area.height.png",
                           "area.normal.png", "area.sigma.png", "area.images.json", "plate.obj"})
    EXPECT_TRUE(fs::exists(dir_ / "out" / file)) << file;

  // The scene as it is felt: the texture's height at a triangle's corners is the relief there, up to a constant.
  const json scene = read_json(dir_ / "out" / "scene.json");
  ASSERT_EQ(scene.at("textures").size(), 1u);
  const Outcome info = run({"texture", "info", path("out/area.texture.json"), "--json"});
  ASSERT_EQ(info.code, 0) << info.err;
  EXPECT_THAT(info.out, HasSubstr("sigma_rms_m"));
  // Its roughness has the errors that the map states: with what the errors change it by.
  const Outcome roughness = run({"roughness", path("out/area.texture.json"), "--json"});
  ASSERT_EQ(roughness.code, 0) << roughness.err;
  const json measured = json::parse(roughness.out);
  const double Sq_m = measured.at("roughness").at("Sq_m"), sigma_m = measured.at("noise_rms_m");
  // An estimate between strokes leans towards the mean by what is not known of it: the two squares are the surface's.
  EXPECT_NEAR(std::hypot(Sq_m, sigma_m), area.at("map").at("rms_m").get<double>(), 5e-6);
  EXPECT_GT(measured.at("roughness").at("Sq_stderr_m").get<double>(), 0.02 * sigma_m);
  EXPECT_LT(measured.at("roughness").at("Sq_stderr_m").get<double>(), 2.0 * sigma_m);
  for (const char* to : {"png", "gltf", "obj", "x3p", "stl"}) {
    const Outcome exported = run({"export", path("out"), "--to", to, "-o", path(std::string("as-") + to)});
    EXPECT_EQ(exported.code, 0) << to << ": " << exported.err;
  }
  EXPECT_TRUE(fs::exists(dir_ / "as-png" / "area.sigma.png"));
  // The same again: the same bytes.
  ASSERT_EQ(
      run({"area", path("registered"), "-o", path("again"), "--set", "map.shift_mm=0", "--set", "map.held_out=4"}).code,
      0);
  const auto bytes = [&](const std::string& name) {
    std::ifstream in(dir_ / name, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  EXPECT_EQ(bytes("out/area.surface.csv"), bytes("again/area.surface.csv"));
  EXPECT_EQ(bytes("out/plate.obj"), bytes("again/plate.obj"));
}

// What lay there before is covered, and is there again without the area.
TEST_F(Area, CoversTheTexturesBelowIt) {
  write_registered("registered", false);
  const std::vector<std::string> usual{"--set", "map.shift_mm=0", "--set", "map.held_out=4"};
  const auto area = [&](const std::string& from, const std::string& to) {
    std::vector<std::string> words{"area", path(from), "-o", path(to)};
    words.insert(words.end(), usual.begin(), usual.end());
    return run(words);
  };
  ASSERT_EQ(area("registered", "once").code, 0);
  // The scene with its area as if scans had been added to it.
  fs::copy(dir_ / "registered" / "registration.json", dir_ / "once");
  for (int k = 0; k < 16; ++k) {
    const std::string scan = "scan" + std::to_string(k);
    fs::copy(dir_ / "registered" / scan, dir_ / "once" / scan);
  }
  const Outcome twice = area("once", "twice");
  ASSERT_EQ(twice.code, 0) << twice.err;
  const json scene = read_json(dir_ / "twice" / "scene.json");
  ASSERT_EQ(scene.at("textures").size(), 2U);
  EXPECT_EQ(scene.at("textures")[1].at("order"), 1);
  EXPECT_EQ(scene.at("textures")[1].at("file"), "area-2.texture.json");
  std::ifstream covered(dir_ / "twice" / scene.at("covered").get<std::string>());
  std::size_t rows = 0;
  for (std::string line; std::getline(covered, line); ++rows) {
    if (rows > 0) {
      EXPECT_THAT(line, HasSubstr("," + scene.at("textures")[0].at("index").dump() + ","));
    }
  }
  EXPECT_GT(rows, 100U);
}

// It is replaced as a whole, and has what was measured.
TEST_F(Area, IsNotWrittenIntoTheFolderThatItReads) {
  write_registered("registered", false);
  const Outcome outcome = run({"area", path("registered"), "-o", path("registered") + "/."});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("is REGISTERED itself"));
  EXPECT_TRUE(fs::exists(dir_ / "registered" / "scan0" / "profile.csv"));
}

TEST_F(Area, StrokesOfDifferentSurfacesGiveNone) {
  write_registered("registered", true);
  const Outcome outcome = run({"area", path("registered"), "-o", path("out")});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("the strokes do not agree"));
  EXPECT_TRUE(read_json(dir_ / "out" / "area.json").at("texture").is_null());
  EXPECT_TRUE(read_json(dir_ / "out" / "scene.json").at("textures").empty());
  EXPECT_FALSE(fs::exists(dir_ / "out" / "area.texture.json"));
}

TEST_F(Area, NamesWhatIsNoRegistration) {
  write_registered("registered", false);
  const auto error = [&](const std::string& folder) {
    const Outcome outcome = run({"area", path(folder), "-o", path("out")});
    EXPECT_EQ(outcome.code, 1) << folder;
    EXPECT_FALSE(fs::exists(dir_ / "out"));
    return outcome.err;
  };
  EXPECT_THAT(error("nowhere"), HasSubstr("registration.json"));
  write_text(dir_ / "registered" / "scan3" / "path.csv", "s_m,px_m,py_m,pz_m,triangle\n0,0,0,0,99999\n");
  EXPECT_THAT(error("registered"), HasSubstr("path.csv:2: column 'triangle': 99999 is not a triangle"));
  write_text(dir_ / "registered" / "scan3" / "path.csv", "s_m,px_m,py_m,pz_m,triangle\n0,0,0,0,1\n0,0,0,0,1\n");
  EXPECT_THAT(error("registered"), HasSubstr("does not rise"));
  for (int k = 0; k < 16; ++k) fs::remove(dir_ / "registered" / ("scan" + std::to_string(k)) / "path.csv");
  EXPECT_THAT(error("registered"), HasSubstr("path.csv; register them again"));
  const auto registration = [&](const std::string& text) {
    write_text(dir_ / "registered" / "registration.json", text);
    return error("registered");
  };
  EXPECT_THAT(registration("[]"), HasSubstr("registration.json: is not a registration of asperity"));
  EXPECT_THAT(registration(R"({"format": 3})"), HasSubstr("registration.json: is not a registration of asperity"));
  EXPECT_THAT(registration(R"({"format": "asperity-registration"})"),
              HasSubstr("registration.json: has no list 'scans'"));
  EXPECT_THAT(registration(R"({"format": "asperity-registration", "scans": [{"name": "a"}, {"name": 7}]})"),
              HasSubstr("registration.json: scans[1] has no name"));
}

// A long stroke over smooth ground holds the pose of the rest; it has no texture, which makes the registration invalid.
TEST_F(Area, AStrokeThatOnlyHoldsThePoseIsLeftOut) {
  write_registered("registered", false);
  json registration = read_json(dir_ / "registered" / "registration.json");
  const json below{{"code", "below_noise"}, {"severity", "invalid"}, {"message", "the texture is below its noise"}};
  json placement{{"verdict", "valid"}, {"verdicts", json::array()}, {"scans", json::array({"locator"})}};
  for (int k = 0; k < 16; ++k) placement["scans"].push_back("scan" + std::to_string(k));
  json named = below;
  named["message"] = "locator: the texture is below its noise";
  registration["placements"] = json::array({placement});
  registration["scans"].push_back({{"name", "locator"}, {"verdict", "invalid"}, {"verdicts", json::array({below})}});
  registration["trustworthy"] = false;
  registration["verdicts"] = json::array({named});
  // Its path crosses the patch; its heights are none of the map's.
  fs::copy(dir_ / "registered" / "scan15", dir_ / "registered" / "locator");
  const auto area = [&](const std::vector<std::string>& more = {}) {
    write_text(dir_ / "registered" / "registration.json", registration.dump());
    std::vector<std::string> words{"area", path("registered"), "-o", path("out"), "--set", "map.held_out=4"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  };
  const Outcome automatic = area();
  EXPECT_EQ(automatic.code, 0) << automatic.err;
  EXPECT_THAT(automatic.out, HasSubstr("left out      locator: the texture is below its noise"));
  const json written = read_json(dir_ / "out" / "area.json");
  EXPECT_EQ(written.at("scans").size(), 16U);
  EXPECT_THAT(written.at("problems").dump(), HasSubstr("locator: the texture is below its noise"));
  EXPECT_EQ(area({"--leave-out", "scan3"}).code, 0);
  EXPECT_EQ(read_json(dir_ / "out" / "area.json").at("scans").size(), 15U);
  const Outcome unknown = area({"--leave-out", "scan99"});
  EXPECT_EQ(unknown.code, 1);
  EXPECT_THAT(unknown.err, HasSubstr("has no scan 'scan99' to leave out"));

  // Something else that is invalid stays so: the placement, another scan, the registration as a whole.
  const json good = registration;
  registration["placements"][0]["verdict"] = "invalid";
  EXPECT_EQ(area().code, 3);
  registration = good;
  registration["verdicts"].push_back({{"code", "x"}, {"severity", "invalid"}, {"message", "there are no coordinates"}});
  EXPECT_EQ(area().code, 3);
  registration = good;
  registration["placements"][0]["scans"].erase(0);  // a scan of no placement is not known to have a pose
  EXPECT_EQ(area().code, 3);
}

// A registration that does not say that it can be trusted is not trusted.
TEST_F(Area, WithoutAVerdictOfTheRegistrationThereIsNone) {
  write_registered("registered", false);
  json registration = read_json(dir_ / "registered" / "registration.json");
  registration.erase("trustworthy");
  write_text(dir_ / "registered" / "registration.json", registration.dump());
  const Outcome outcome =
      run({"area", path("registered"), "-o", path("out"), "--set", "map.shift_mm=0", "--set", "map.held_out=4"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("the registration of the strokes is invalid"));
}

}  // namespace
}  // namespace asperity::cli
