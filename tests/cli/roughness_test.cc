#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "asperity/base/csv.h"
#include "asperity/testkit/temp_dir.h"
#include "run_asperity.h"

namespace asperity::cli {
namespace {

using ::testing::HasSubstr;

// A square wave of ±1 µm: Ra = Rq = 1 µm, Rt = Rz = 2 µm, whatever the rounding of a filter.
std::string square_wave() {
  std::string text;
  for (int i = 0; i < 1000; ++i) text += i / 25 % 2 == 0 ? "1\n" : "-1\n";
  return text;
}

TEST(Roughness, OfAColumnOfHeights) {
  const testkit::TempDir dir;
  const std::string file = (dir / "heights.csv").string();
  write_text(file, square_wave());
  const Outcome outcome = run({"roughness", file, "--spacing", "0.5um", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  constexpr double kRounding_m = 1e-15;
  EXPECT_EQ(json["kind"], "profile");
  EXPECT_NEAR(json["roughness"]["Ra_m"].get<double>(), 1e-6, kRounding_m);
  EXPECT_NEAR(json["roughness"]["Rq_m"].get<double>(), 1e-6, kRounding_m);
  EXPECT_NEAR(json["roughness"]["Rz_m"].get<double>(), 2e-6, kRounding_m);
  EXPECT_NEAR(json["roughness"]["Rt_m"].get<double>(), 2e-6, kRounding_m);
  EXPECT_EQ(json["config"]["input"]["spacing_m"], 5e-7);
  const Outcome table = run({"roughness", file, "--spacing", "0.5um"});
  EXPECT_THAT(table.out, HasSubstr("Ra                1 µm\n"));
}

// A wave of 25 µm on one of 8 mm: of the class that its Ra calls for only the short one is left, and the filters are
// told.
TEST(Roughness, ASettingClassFiltersAndSaysSo) {
  const testkit::TempDir dir;
  const std::string file = (dir / "heights.csv").string();
  std::string text;
  constexpr double kTwoPi = 6.283185307179586;
  for (int i = 0; i < 16000; ++i) {
    const double x_mm = 0.5e-3 * i;
    text += std::to_string(1.0 * std::sin(kTwoPi * x_mm / 0.025) + 40.0 * std::sin(kTwoPi * x_mm / 8.0)) + "\n";
  }
  write_text(file, text);
  const Outcome unfiltered = run({"roughness", file, "--spacing", "0.5um"});
  EXPECT_THAT(unfiltered.out, HasSubstr("filters     no λs, no λc; 5 sections of 1.6 mm\n"));
  EXPECT_THAT(unfiltered.out, HasSubstr("waviness included"));
  // 8 mm are ten sections of λc = 0.8 mm; five are the setting.
  const Outcome own = run({"roughness", file, "--spacing", "0.5um", "--lambda-c", "0.8mm"});
  EXPECT_THAT(own.out, HasSubstr("5 sections of 1.6 mm\n            sections as long as λc, as in ISO 21920: --set "
                                 "roughness.sections=10; "));
  EXPECT_THAT(
      run({"roughness", file, "--spacing", "0.5um", "--lambda-c", "0.8mm", "--set", "roughness.sections=10"}).out,
      ::testing::Not(HasSubstr("as in ISO 21920")));
  const Outcome outcome = run({"roughness", file, "--spacing", "0.5um", "--class", "auto", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["filters"]["setting_class"], "Sc3");
  EXPECT_EQ(json["filters"]["lambda_c_mm"], 0.8);
  EXPECT_EQ(json["filters"]["sections"], 10);
  // λs passes 2^−0.01 = 0.993 of a wave of 25 µm, and λc leaves 1 − 2^−0.01 = 0.7 % of that of 8 mm, 0.28 µm.
  EXPECT_NEAR(json["roughness"]["Ra_m"].get<double>(), 2e-6 / 3.14159265, 0.03e-6);
  EXPECT_THAT(run({"roughness", file, "--spacing", "0.5um", "--class", "Sc9"}).err, HasSubstr("--class"));
}

TEST(Roughness, OfAnArealMap) {
  const testkit::TempDir dir;
  const std::string file = (dir / "map.txt").string();
  std::string text = "x_mm,y_mm,z_um\n";
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      text += std::to_string(x) + "," + std::to_string(y) + "," + ((x + y) % 2 == 0 ? "3" : "-3") + "\n";
    }
  }
  write_text(file, text);
  const Outcome outcome = run({"roughness", file, "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["kind"], "areal");
  EXPECT_NEAR(json["roughness"]["Sz_m"].get<double>(), 6e-6, 0.2e-6);  // a plane fits a checkerboard's edges a little
  EXPECT_FALSE(json["roughness"].contains("Sq_stderr_m"));
  EXPECT_THAT(run({"roughness", file}).out, HasSubstr("intervals   not determined"));
  const Outcome stated = run({"roughness", file, "--noise", "100nm", "--json"});
  ASSERT_EQ(stated.code, 0) << stated.err;
  // Of 64 independent heights: 0.1 µm / √64, to what 24 draws leave open.
  EXPECT_NEAR(nlohmann::json::parse(stated.out)["roughness"]["Sq_stderr_m"].get<double>(), 0.0125e-6, 0.006e-6);
  EXPECT_THAT(run({"roughness", file, "--noise", "100nm"}).out,
              HasSubstr("noise       0.1 µm RMS, independent from height to height"));
  const std::string profile = (dir / "profile.txt").string();
  write_text(profile, "0\n1\n0\n1\n");
  const Outcome of_profile = run({"roughness", profile, "--spacing", "1um", "--noise", "100nm"});
  EXPECT_EQ(of_profile.code, 2);
  EXPECT_THAT(of_profile.err, HasSubstr("is a profile; --noise applies to areal maps only"));
  const Outcome filtered = run({"roughness", file, "--class", "auto"});
  EXPECT_EQ(filtered.code, 2) << "it has no effect on an areal map";
  EXPECT_THAT(filtered.err, HasSubstr("is an areal map"));
}

// Several files: each is measured as alone, and one that cannot be read does not stop the others.
TEST(Roughness, OfManyFilesWithTableAndReport) {
  const testkit::TempDir dir;
  const std::string square = (dir / "square, one.csv").string(), map = (dir / "map.csv").string();
  std::string heights = "x_mm,z_um\n";
  for (int i = 0; i < 400; ++i) heights += fmt::format("{},{}\n", 0.001 * i, i / 25 % 2 == 0 ? 1 : -1);
  write_text(square, heights);
  std::string points = "x_mm,y_mm,z_um\n";
  for (int row = 0; row < 20; ++row)
    for (int column = 0; column < 20; ++column)
      points += fmt::format("{},{},{}\n", 0.01 * column, 0.01 * row, (row + column) % 2);
  write_text(map, points);
  const std::string none = (dir / "none.csv").string(), table = (dir / "t.csv").string(),
                    report = (dir / "r.html").string();
  const Outcome outcome = run({"roughness", square, none, map, "--table", table, "--report", report, "--json"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("none.csv: no such file"));
  const auto json = nlohmann::json::parse(outcome.out);
  ASSERT_EQ(json["files"].size(), 2U);
  EXPECT_EQ(json["files"][0]["roughness"],
            nlohmann::json::parse(run({"roughness", square, "--json"}).out)["roughness"]);
  EXPECT_EQ(json["failed"].size(), 1U);
  const std::string rows = read_file(table, 1 << 20);
  EXPECT_THAT(rows, testing::StartsWith("file,kind,Ra_m,"));
  EXPECT_THAT(rows, HasSubstr("\n\"" + square + "\",profile,1.0000000"));
  EXPECT_THAT(rows, HasSubstr("\n" + map + ",areal,,"));
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 3);
  const std::string page = read_file(report, 1 << 24);
  EXPECT_THAT(page, HasSubstr("<h2>" + square + "</h2>"));
  EXPECT_THAT(page, HasSubstr("Material ratio of R"));
  EXPECT_THAT(page, HasSubstr("<p class=\"failed\">" + none));
  EXPECT_THAT(page, testing::Not(HasSubstr("<script")));
  // Not over what is somebody else's.
  const Outcome refused = run({"roughness", square, "--table", map});
  EXPECT_EQ(refused.code, 1);
  EXPECT_EQ(read_file(map, 1 << 20), points);
}

TEST(Roughness, OfAResultsFolderAndOfStandardInput) {
  const testkit::TempDir dir;
  std::string heights = "s_m,height_m\n";
  for (int i = 0; i < 400; ++i) heights += fmt::format("{},{}\n", 1e-6 * i, i / 25 % 2 == 0 ? 1e-6 : -1e-6);
  write_text(dir / "profile.csv", heights);
  const Outcome folder = run({"roughness", dir.path().string()});
  EXPECT_EQ(folder.code, 0) << folder.err;
  EXPECT_THAT(folder.out, HasSubstr("Ra                1 µm\n"));
  EXPECT_EQ(run_from(dir / "profile.csv", {"roughness", "-"}).out, folder.out);
  const Outcome empty = run({"roughness", (dir / "profile.csv").parent_path().parent_path().string()});
  EXPECT_EQ(empty.code, 1);
  EXPECT_THAT(empty.err, HasSubstr("a folder without a profile.csv"));
  EXPECT_EQ(run_from(dir / "profile.csv", {"roughness", "-", "-"}).code, 2);
}

TEST(Roughness, BadFilesEndWith1AndSayWhere) {
  const testkit::TempDir dir;
  const std::string file = (dir / "heights.csv").string();
  const auto outcome_of = [&](const std::string& text) {
    write_text(file, text);
    return run({"roughness", file, "--spacing", "0.5um"});
  };
  EXPECT_EQ(run({"roughness", (dir / "absent").string()}).code, 1);
  EXPECT_EQ(run({"roughness", dir.path().string()}).code, 1);
  for (const std::string& text :
       {std::string(), std::string("1\n2\nx\n"), std::string("\x00\xff", 2), std::string("1\ninf\n2\n")}) {
    const Outcome outcome = outcome_of(text);
    EXPECT_EQ(outcome.code, 1) << text;
    EXPECT_THAT(outcome.err, HasSubstr(file)) << text;
  }
  EXPECT_THAT(outcome_of("1\n2\nx\n").err, HasSubstr(file + ":3"));
}

}  // namespace
}  // namespace asperity::cli
