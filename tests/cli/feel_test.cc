#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "feel_fixture.h"
#include "wait_until_begun.h"

namespace asperity::cli {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;
using Words = std::vector<std::string>;

TEST_F(FeelCommands, AReplayedPathIsFollowedExactly) {
  write_stroke("path.csv", 0.5e-3, 123'456'789'000, 1'000'000);
  const Outcome outcome =
      feel(path("plate.obj"), {"--mesh-unit", "mm", "--replay", path("path.csv"), "--log", path("log.csv"), "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Table given = read_table(path("path.csv")), log = read_table(path("log.csv"));
  EXPECT_THAT(log.columns, ::testing::ElementsAre("t_ns", "px_m", "py_m", "pz_m", "proxy_x_m", "proxy_y_m", "proxy_z_m",
                                                  "fx_N", "fy_N", "fz_N", "contact_N", "texture_N", "friction_N",
                                                  "texture_height_m", "out_x_N", "out_y_N", "out_z_N"));
  ASSERT_EQ(log.rows.size(), given.rows.size());
  for (std::size_t i = 0; i < log.rows.size(); ++i) {
    EXPECT_EQ(log.rows[i][0], given.rows[i][0] - given.rows[0][0]);
    for (std::size_t k = 1; k < 4; ++k) EXPECT_EQ(log.rows[i][k], given.rows[i][k]) << i;
    // A plane: the proxy stays on it, f = k d along z.
    const double z_m = given.rows[i][3];
    constexpr double kSkin_m = 1e-9, kSkin_N = 1e-6;  // the proxy's own, relative to a plate of 60 mm
    EXPECT_NEAR(log.rows[i][6], std::max(z_m, 0.0), kSkin_m) << i;
    EXPECT_NEAR(log.rows[i][9], 1000.0 * std::max(-z_m, 0.0), kSkin_N) << i;
    EXPECT_NEAR(log.rows[i][10], 1000.0 * std::max(-z_m, 0.0), kSkin_N) << i;
    EXPECT_NEAR(log.rows[i][7], 0.0, kSkin_N);
  }
  const Json json = Json::parse(outcome.out);
  EXPECT_EQ(json.at("ticks"), log.rows.size());
  EXPECT_EQ(json.at("device"), "replay");
  EXPECT_NEAR(json.at("force").at("peak_N").get<double>(), 0.5, 1e-6);
  EXPECT_FALSE(json.contains("timing"));
}

TEST_F(FeelCommands, SamplesBetweenTicksAreMetAtTheirTimes) {
  write_stroke("path.csv", 0.5e-3, 0, 2'500'000);  // 400 Hz beside 1 kHz: every second sample is on a tick
  ASSERT_EQ(feel(path("scene"), {"--replay", path("path.csv"), "--log", path("log.csv")}).code, 0);
  const Table given = read_table(path("path.csv")), log = read_table(path("log.csv"));
  ASSERT_EQ(log.rows.size(), 401u);
  for (std::size_t i = 0; i < given.rows.size(); i += 2) {
    for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(log.rows[5 * i / 2][k], given.rows[i][k]);
  }
}

TEST_F(FeelCommands, ATextureIsRenderedByItsFormula) {
  write_stroke("path.csv", 0.5e-3, 0, 1'000'000);
  ASSERT_EQ(feel(path("scene"), {"--replay", path("path.csv"), "--log", path("log.csv")}).code, 0);
  const Table log = read_table(path("log.csv"));
  // Seed §6.5 (5) with erratum 19: pressed in by more than the texture is high, f_t = k_c k_s H, and x begins where
  // the path does, at 5 mm.
  for (std::size_t i = 200; i < log.rows.size(); i += 7) {
    const double height_m = 1e-4 + 1e-4 * std::cos(2.0 * M_PI * (log.rows[i][1] - 5e-3) / 2.5e-3);
    constexpr double kCoordinates_m = 0.3e-6;  // texture coordinates are fitted to the path to a micrometre
    EXPECT_NEAR(log.column("texture_height_m")[i], height_m, kCoordinates_m) << i;
    EXPECT_NEAR(log.column("texture_N")[i], 1000.0 * height_m, 1000.0 * kCoordinates_m) << i;
    EXPECT_NEAR(log.column("fz_N")[i], 0.5 + 1000.0 * height_m, 1000.0 * kCoordinates_m) << i;
  }
}

TEST_F(FeelCommands, TheSameInputGivesTheSameBytes) {
  for (const char* name : {"a.csv", "b.csv"}) {  // 1000 ticks
    const Outcome outcome = feel(path("scene"), {"--friction", "0.4", "--log", path(name), "--duration", "1s"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }
  std::ifstream a(path("a.csv")), b(path("b.csv"));
  const std::string first{std::istreambuf_iterator<char>(a), {}}, second{std::istreambuf_iterator<char>(b), {}};
  EXPECT_EQ(first, second);
  EXPECT_EQ(std::count(first.begin(), first.end(), '\n'), 1001);
  write_stroke("path.csv", 0.5e-3, 0, 3'000'000);
  ASSERT_EQ(feel(path("scene"), {"--replay", path("path.csv"), "--duration", "100ms", "--log", path("c.csv")}).code, 0);
  const Table cut = read_table(path("c.csv"));
  ASSERT_EQ(cut.rows.size(), 100u);
  EXPECT_EQ(cut.rows[96][3], read_table(path("path.csv")).rows[32][3]);
}

TEST_F(FeelCommands, TheModelledHandStrokesTheTexture) {
  const Outcome outcome =
      feel(path("scene"), {"--press", "1N", "--speed", "50mm/s", "--log", path("log.csv"), "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Table log = read_table(path("log.csv"));
  const std::vector<double> x = log.column("px_m"), f = log.column("fz_N");
  // The texture, 12 mm wide, reaches the plate's ends; the stroke keeps 2 mm away from them.
  EXPECT_NEAR(*std::min_element(x.begin(), x.end()), 2e-3, 0.5e-3);
  EXPECT_NEAR(*std::max_element(x.begin(), x.end()), 58e-3, 0.5e-3);
  // The surface bears what the hand presses with, once the soft start is over.
  double sum = 0.0;
  for (std::size_t i = 800; i < f.size(); ++i) sum += f[i];
  EXPECT_NEAR(sum / static_cast<double>(f.size() - 800), 1.0, 0.1);
  EXPECT_GT(Json::parse(outcome.out).at("force").at("peak_texture_N").get<double>(), 0.1);
}

TEST_F(FeelCommands, OnlyALogIsReplacedByALog) {
  write_stroke("path.csv", 0.5e-3, 0, 1'000'000);
  write_text(path("mine.csv"), "my,data\n");
  fs::create_symlink(path("log.csv"), path("link.csv"));
  for (const char* name : {"path.csv", "mine.csv", "scene/scene.json"}) {
    const auto before = contents(dir_.path());
    const Outcome outcome = feel(path("scene"), {"--replay", path("path.csv"), "--log", path(name)});
    EXPECT_EQ(outcome.code, 1) << name;
    EXPECT_THAT(outcome.err, HasSubstr("nothing was changed"));
    EXPECT_EQ(contents(dir_.path()), before);
  }
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(feel(path("scene"), {"--replay", path("path.csv"), "--log", path("log.csv")}).code, 0);
  }
  const Outcome itself = feel(path("scene"), {"--replay", path("log.csv"), "--log", path("log.csv")});
  EXPECT_EQ(itself.code, 1);
  EXPECT_THAT(itself.err, HasSubstr("is read by this command"));
  EXPECT_EQ(feel(path("scene"), {"--replay", path("path.csv"), "--log", path("link.csv")}).code, 1);
  EXPECT_TRUE(fs::is_symlink(path("link.csv")));
  EXPECT_EQ(feel(path("scene"), {"--replay", path("path.csv"), "--log", ""}).code, 2);
  EXPECT_EQ(read_table(path("log.csv")).rows.size(), 401u);
}

TEST_F(FeelCommands, AStrokeGoesBetweenGivenPoints) {
  const Outcome outcome = feel(path("plate.obj"), {"--mesh-unit", "mm", "--from", "0.01,0.004,0", "--to",
                                                   "10mm,16mm,0mm", "--log", path("log.csv")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::vector<double> y = read_table(path("log.csv")).column("py_m");
  EXPECT_NEAR(*std::min_element(y.begin(), y.end()), 4e-3, 0.3e-3);
  EXPECT_NEAR(*std::max_element(y.begin(), y.end()), 16e-3, 0.3e-3);
}

// As `paint` and `register` do: a plate of 60 m is one whose unit nobody stated.
TEST_F(FeelCommands, AnUnlikelyUnitIsAskedFor) {
  write_text(path("plate60.obj"), "v 0 0 0\nv 60 0 0\nv 60 20 0\nv 0 20 0\nf 1 2 3\nf 1 3 4\n");
  const Outcome outcome = feel(path("plate60.obj"), {"--duration", "0.01s"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("plate60.obj: the mesh is 63.2 m large if its unit is a metre; state its unit: "
                                     "--mesh-unit mm makes it 63.2 mm"));
  EXPECT_EQ(feel(path("plate60.obj"), {"--mesh-unit", "mm", "--duration", "0.01s"}).code, 0);
}

TEST_F(FeelCommands, TheHandStaysOnTheFaceOfAShortObject) {
  write_text(
      path("box.obj"),
      "v -30 -20 -10\nv -30 -20 10\nv -30 20 -10\nv -30 20 10\nv 30 -20 -10\nv 30 -20 10\nv 30 20 -10\nv 30 20 10\n"
      "f 1 2 4\nf 1 4 3\nf 5 7 8\nf 5 8 6\nf 1 5 6\nf 1 6 2\nf 3 4 8\nf 3 8 7\nf 1 3 7\nf 1 7 5\nf 2 6 8\nf 2 8 4\n");
  const Outcome outcome = feel(path("box.obj"), {"--mesh-unit", "mm", "--log", path("log.csv"), "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("the stroke is 56.0 mm long"));
  EXPECT_LT(Json::parse(outcome.out).at("force").at("peak_N").get<double>(), 1.1);
  for (const double z_m : read_table(path("log.csv")).column("pz_m")) EXPECT_GT(z_m, 8.5e-3);
}

TEST_F(FeelCommands, APathInTheAirSaysSo) {
  write_stroke("path.csv", -1e-3, 0, 1'000'000);
  const Outcome outcome = feel(path("scene"), {"--replay", path("path.csv"), "--json"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("nothing was touched: the path comes no nearer to a surface than 1 mm"));
  EXPECT_EQ(Json::parse(outcome.out).at("contact").at("ticks"), 0);
}

TEST_F(FeelCommands, TimingIsOptIn) {
  write_stroke("path.csv", 0.5e-3, 0, 1'000'000);
  const Outcome outcome =
      feel(path("scene"), {"--replay", path("path.csv"), "--timing", "--log", path("log.csv"), "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(read_table(path("log.csv")).columns.back(), "step_ns");
  EXPECT_TRUE(Json::parse(outcome.out).at("timing").contains("step_us"));
}

TEST_F(FeelCommands, AnInterruptedRunLeavesNothing) {
  const Outcome outcome = run_and_meddle(
      {"feel", path("scene"), "--realtime", "--duration", "60s", "--log", path("log.csv")}, [&](pid_t process) {
        EXPECT_TRUE(wait_until_begun(path("log.csv")));
        std::this_thread::sleep_for(std::chrono::milliseconds(100));  // into the loop
        ::kill(process, SIGINT);
      });
  EXPECT_EQ(outcome.code, 130);
  EXPECT_FALSE(fs::exists(path("log.csv")));
  for (const auto& entry : fs::directory_iterator(dir_.path())) {
    EXPECT_THAT(entry.path().filename().string(), Not(HasSubstr("tmp")));
  }
}

TEST_F(FeelCommands, HeightMapsAreFeltOnAPlane) {
  std::string pgm = "P5 16 16 255\n";
  for (int row = 0; row < 16; ++row) {
    for (int column = 0; column < 16; ++column) pgm += static_cast<char>(column % 8 < 4 ? 0 : 200);
  }
  for (const char* name : {"a.pgm", "b.pgm", "c.pgm", "d.pgm"}) write_text(path(name), pgm);
  const std::string files = path("a.pgm") + "," + path("b.pgm") + "," + path("c.pgm") + "," + path("d.pgm");
  const Outcome outcome = run({"feel", "--height-maps", files, "--tile", "10mm", "--height-range", "0.5mm", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json json = Json::parse(outcome.out);
  EXPECT_EQ(json.at("scene").size(), 4u);
  EXPECT_EQ(json.at("config").at("render").at("texture").at("model"), "normal-perturbation");
  EXPECT_NEAR(json.at("texture_height").at("highest_m").get<double>(), 0.5e-3 * 200.0 / 255.0, 0.1e-3);
  EXPECT_EQ(run({"feel", path("scene"), "--height-maps", files}).code, 2);
  EXPECT_EQ(run({"feel", "--height-maps", files + ","}).code, 2);
  EXPECT_EQ(run({"feel", "--height-maps", path("a.pgm") + ",," + path("b.pgm")}).code, 2);
  EXPECT_EQ(run({"feel", path("scene"), "--tile", "10mm"}).code, 2);
}

TEST_F(FeelCommands, BlackIsZeroOnEachHeightMap) {
  write_text(path("black.pgm"), "P5 8 8 255\n" + std::string(64, '\0'));
  write_text(path("grey.pgm"), "P5 8 8 255\n" + std::string(64, '\x66'));  // 0.4
  const std::string black = path("black.pgm"), grey = path("grey.pgm");
  const Outcome outcome = run({"feel", "--height-maps", black + "," + grey + "," + black + "," + grey, "--height-range",
                               "0.5mm", "--log", path("log.csv")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Table log = read_table(path("log.csv"));
  const std::vector<double> x = log.column("px_m"), height = log.column("texture_height_m");
  // Tiles of 10 mm from 2 mm and from 14 mm; the texture fades over 1 mm at its border.
  double on_black_m = 0.0, on_grey_m = 0.0;
  std::size_t grey_ticks = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (x[i] > 3.2e-3 && x[i] < 10.8e-3) on_black_m = std::max(on_black_m, height[i]);
    if (!(x[i] > 15.2e-3 && x[i] < 22.8e-3)) continue;
    on_grey_m = std::max(on_grey_m, std::abs(height[i] - 0.2e-3));
    ++grey_ticks;
  }
  EXPECT_LT(on_black_m, 1e-12);
  EXPECT_LT(on_grey_m, 1e-12);
  EXPECT_GT(grey_ticks, 100u);
}

TEST_F(FeelCommands, SettingsAreThoseOfTheOptions) {
  const Outcome outcome =
      run({"feel", "--tip", "0.5mm", "--stiffness", "2000N/m", "--friction", "0.3", "--texture-model",
           "lateral-gradient", "--rate", "2000", "--set", "safety.max_force_N=3", "--print-config", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json json = Json::parse(outcome.out);
  EXPECT_EQ(json.at("render").at("tip_radius_m"), 0.5e-3);
  EXPECT_EQ(json.at("render").at("stiffness_N_per_m"), 2000.0);
  EXPECT_EQ(json.at("render").at("friction"), 0.3);
  EXPECT_EQ(json.at("render").at("texture").at("model"), "lateral-gradient");
  EXPECT_EQ(json.at("servo").at("rate_Hz"), 2000.0);
  EXPECT_EQ(json.at("safety").at("max_force_N"), 3.0);
}

TEST_F(FeelCommands, WhatCannotBeMeantIsRefused) {
  const std::string scene = path("scene");
  const std::vector<Words> usage{
      {"--device", "mouse"}, {"--device", "spoon"}, {"--device", "replay"}, {"--mapped"},
      {"--from", "0,0,0"},   {"--rate", "5"},       {"--duration", "0s"},   {"--texture-model", "velvet"},
      {"--tip", "0.5"},      {"--press", "1kg"},    {"--press", "1"}};
  for (const Words& words : usage) EXPECT_EQ(feel(scene, words).code, 2) << ::testing::PrintToString(words);
  EXPECT_THAT(feel(scene, {"--device", "mouse"}).err, HasSubstr("studio"));
  EXPECT_EQ(run({"feel"}).code, 2);
  write_stroke("path.csv", 0.5e-3, 0, 1'000'000);
  EXPECT_EQ(feel(scene, {"--replay", path("path.csv"), "--mapped"}).code, 1);
  EXPECT_EQ(feel(scene, {"--replay", path("none.csv")}).code, 1);
  write_text(path("bad.csv"), "t_ns,px_m,py_m,pz_m\n0,0,0,0\n1000000,0,zero,0\n");
  const Outcome bad = feel(scene, {"--replay", path("bad.csv"), "--log", path("log.csv")});
  EXPECT_EQ(bad.code, 1);
  EXPECT_THAT(bad.err, HasSubstr("bad.csv:3: column 'py_m'"));
  EXPECT_FALSE(fs::exists(path("log.csv")));
  write_text(path("long.csv"), "t_s,px_m,py_m,pz_m\n0,0,0,1\n1e9,0,0,1\n");
  const Outcome endless = feel(scene, {"--replay", path("long.csv"), "--log", path("log.csv")});
  EXPECT_EQ(endless.code, 1);
  EXPECT_THAT(endless.err, HasSubstr("--duration cuts it"));
  EXPECT_EQ(feel(scene, {"--replay", path("long.csv"), "--duration", "10ms"}).code, 0);
  EXPECT_EQ(feel(scene, {"--device", "2diy"}).code, 2);
  EXPECT_EQ(feel(path("none.scene.json"), {}).code, 1);
}

}  // namespace
}  // namespace asperity::cli
