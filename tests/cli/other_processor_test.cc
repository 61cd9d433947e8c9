// The same input, config and seed give the same bytes on one machine; on a processor without AVX2 and FMA the C
// library's functions round otherwise, and the figures agree to what docs/command-line.md states.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "asperity/testkit/temp_dir.h"
#include "run_asperity.h"

namespace asperity::cli {
namespace {

using nlohmann::json;

constexpr double kFigures = 1e-9;    // relative, of result.json
constexpr double kHeight_m = 1e-15;  // of profile.csv

void compare(const json& a, const json& b, const std::string& place) {
  ASSERT_EQ(a.type(), b.type()) << place;
  if (a.is_object() || a.is_array()) {
    ASSERT_EQ(a.size(), b.size()) << place;
    for (const auto& [key, value] : a.items()) {
      compare(value, a.is_object() ? b.at(key) : b.at(std::stoul(key)), place + "/" + key);
    }
  } else if (a.is_number_float()) {
    const double x = a.get<double>(), y = b.get<double>();
    EXPECT_LE(std::abs(x - y), kFigures * std::max(std::abs(x), std::abs(y)) + 1e-18)
        << place << ": " << x << ", " << y;
  } else {
    EXPECT_EQ(a, b) << place;
  }
}

std::vector<std::vector<double>> table(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<std::vector<double>> out;
  std::string line, cell;
  std::getline(file, line);
  while (std::getline(file, line)) {
    out.emplace_back();
    for (std::stringstream cells(line); std::getline(cells, cell, ',');)
      out.back().push_back(cell.empty() ? NAN : std::strtod(cell.c_str(), nullptr));
  }
  return out;
}

TEST(OtherProcessor, TheFiguresAgree) {
  const testkit::TempDir dir;
  ASSERT_EQ(
      run({"simulate", "--surface", "sandpaper", "--seed", "3", "--set", "hand.length_m=0.04", "-o", dir / "rec"}).code,
      0);
  run({"process", dir / "rec", "-o", dir / "here", "--quiet"});
  ::setenv("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-AVX2_Usable,-AVX2,-FMA_Usable,-FMA", 1);
  run({"process", dir / "rec", "-o", dir / "there", "--quiet"});
  ::unsetenv("GLIBC_TUNABLES");
  const auto result = [&](const char* folder) { return json::parse(std::ifstream(dir / folder / "result.json")); };
  compare(result("here"), result("there"), "");
  const auto here = table(dir / "here/profile.csv"), there = table(dir / "there/profile.csv");
  ASSERT_EQ(here.size(), there.size());
  ASSERT_GT(here.size(), 1000u);
  for (std::size_t i = 0; i < here.size(); ++i) {
    ASSERT_EQ(here[i].size(), there[i].size());
    if (std::isfinite(here[i][1])) {
      ASSERT_NEAR(here[i][1], there[i][1], kHeight_m) << i;
    }
  }
}

}  // namespace
}  // namespace asperity::cli
