#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

#include "asperity/testkit/temp_dir.h"
#include "run_asperity.h"

namespace asperity::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string read_text(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

constexpr const char* kBits = "1000010011011110";

std::string dictionary() { return std::string("nmarkers: 1\nmarkersize: 4\nmarker_0: \"") + kBits + "\"\n"; }

// The dictionary's marker, 20 px a cell, its border's first pixel at (40, 40).
std::string picture() {
  std::string out = "P5\n200 200\n255\n";
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 200; ++x) {
      const int column = (x - 40) / 20 - 1, row = (y - 40) / 20 - 1;
      const bool outside = x < 40 || y < 40 || x >= 160 || y >= 160;
      const bool inside = column >= 0 && row >= 0 && column < 4 && row < 4;
      out += outside || (inside && kBits[4 * row + column] == '1') ? '\xf0' : '\x10';
    }
  }
  return out;
}

TEST(Markers, ARingAndItsBody) {
  const testkit::TempDir dir;
  const std::string pdf = (dir / "ring.pdf").string(), body = (dir / "markers.json").string();
  const std::vector<std::string> command = {"markers", "ring", "--size", "46mm",      "--sides",
                                            "6",       "-o",   pdf,      "--markers", body};
  const Outcome outcome = run(command);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("measure both rulers"));
  EXPECT_THAT(read_text(pdf), StartsWith("%PDF-1.7\n"));
  const auto markers = nlohmann::json::parse(read_text(body))["markers"];
  ASSERT_EQ(markers.size(), 6u);
  // Opposite faces are the prism's inner diameter apart: 57.5 mm · √3.
  EXPECT_NEAR(markers[3]["T_marker_tag"][2].get<double>(), 0.0575 * std::sqrt(3.0), 1e-12);
  EXPECT_EQ(markers[0]["T_marker_tag"], nlohmann::json::parse("[0,0,0,1,0,0,0]"));
  // Again, over its own files, with the same bytes.
  const std::string before = read_text(pdf);
  EXPECT_EQ(run(command).code, 0);
  EXPECT_EQ(read_text(pdf), before);
}

TEST(Markers, NoStrangersFileIsReplaced) {
  const testkit::TempDir dir;
  const std::string pdf = (dir / "letter.pdf").string();
  write_text(pdf, "%PDF-1.4\nsomebody's letter");
  const Outcome outcome = run({"markers", "board", "-o", pdf});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("nothing was changed"));
  EXPECT_EQ(read_text(pdf), "%PDF-1.4\nsomebody's letter");
}

TEST(Markers, WhatDoesNotFitSaysWhatWould) {
  const testkit::TempDir dir;
  const std::string pdf = (dir / "a.pdf").string();
  EXPECT_THAT(run({"markers", "sheet", "--size", "300mm", "-o", pdf}).err, HasSubstr("at most 145 mm"));
  EXPECT_EQ(run({"markers", "sheet", "--ids", "5-3", "-o", pdf}).code, 2);
  EXPECT_EQ(run({"markers", "board", "--board", "9", "-o", pdf}).code, 2);
  EXPECT_THAT(run({"markers", "sheet", "--family", "artag", "-o", pdf}).err, HasSubstr("none of tag36h11"));
  EXPECT_FALSE(std::filesystem::exists(pdf));
  EXPECT_EQ(run({"markers", "charuco", "-o", pdf}).code, 0);
}

TEST(Markers, DetectFindsAMarkerOfADictionary) {
  const testkit::TempDir dir;
  const std::string image = (dir / "a.pgm").string(), table = (dir / "corners.csv").string();
  const std::string family = "aruco:" + (dir / "d.yml").string();
  write_text(image, picture());
  write_text(dir / "d.yml", dictionary());
  const Outcome outcome = run({"markers", "detect", image, "--family", family, "-o", table, "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto marker = nlohmann::json::parse(outcome.out)["images"][0]["markers"][0];
  EXPECT_EQ(marker["id"], 0);
  const double expected_px[4][2] = {{39.5, 39.5}, {159.5, 39.5}, {159.5, 159.5}, {39.5, 159.5}};
  for (std::size_t k = 0; k < 4; ++k) {
    // A tenth of a pixel: an edge between two pixels, without blur.
    EXPECT_NEAR(marker["corners_px"][k][0].get<double>(), expected_px[k][0], 0.1);
    EXPECT_NEAR(marker["corners_px"][k][1].get<double>(), expected_px[k][1], 0.1);
  }
  EXPECT_THAT(read_text(table), StartsWith("image,id,x0_px,y0_px"));
  const Outcome none = run({"markers", "detect", image});
  EXPECT_EQ(none.code, 3);
  EXPECT_THAT(none.err, HasSubstr("no marker of tag36h11"));
  EXPECT_EQ(run({"markers", "detect", (dir / "d.yml").string()}).code, 1);
}

TEST(Markers, ABodysDictionaryLiesBesideIt) {
  const testkit::TempDir dir;
  std::filesystem::create_directory(dir / "body");
  write_text(dir / "d.yml", dictionary());
  write_text(dir / "body" / "d.yml", dictionary());
  const std::string pdf = (dir / "a.pdf").string(), body = (dir / "body" / "markers.json").string();
  const Outcome away =
      run({"markers", "sheet", "--family", "aruco:" + (dir / "d.yml").string(), "-o", pdf, "--markers", body});
  EXPECT_EQ(away.code, 1);
  EXPECT_THAT(away.err, HasSubstr("is not in the folder of the body's file"));
  const Outcome beside =
      run({"markers", "sheet", "--family", "aruco:" + (dir / "body" / "d.yml").string(), "-o", pdf, "--markers", body});
  ASSERT_EQ(beside.code, 0) << beside.err;
  EXPECT_EQ(nlohmann::json::parse(read_text(body))["markers"][0]["family"], "aruco:d.yml");
}

}  // namespace
}  // namespace asperity::cli
