// The same input, config and seed give the same bytes on one machine; on a processor without AVX2 and FMA the C
// library's functions round otherwise, and another compiler orders sums otherwise: the figures agree to what
// docs/command-line.md states. ASPERITY_OTHER_PROGRAM names the program as another compiler built it.
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
constexpr double kHeight_m = 1e-15;  // of profile.csv, and of a texture's coefficients
constexpr double kTruth = 1e-12;     // of truth.csv: m, N, s and parts of quaternions

void compare(const json& a, const json& b, double figures, const std::string& place, double least = 1e-18) {
  ASSERT_EQ(a.type(), b.type()) << place;
  if (a.is_object() || a.is_array()) {
    ASSERT_EQ(a.size(), b.size()) << place;
    for (const auto& [key, value] : a.items()) {
      compare(value, a.is_object() ? b.at(key) : b.at(std::stoul(key)), figures, place + "/" + key, least);
    }
  } else if (a.is_number_float()) {
    const double x = a.get<double>(), y = b.get<double>();
    EXPECT_LE(std::abs(x - y), figures * std::max(std::abs(x), std::abs(y)) + (figures > 0.0 ? least : 0.0))
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

// The same recording processed again with the variable `name` in the environment.
void expect_the_same_figures(const std::string& name, const std::string& value, double figures, double height_m) {
  const testkit::TempDir dir;
  ASSERT_EQ(
      run({"simulate", "--surface", "sandpaper", "--seed", "3", "--set", "hand.length_m=0.04", "-o", dir / "rec"}).code,
      0);
  const int code = run({"process", dir / "rec", "-o", dir / "here", "--quiet"}).code;
  ::setenv(name.c_str(), value.c_str(), 1);
  const int other = run({"process", dir / "rec", "-o", dir / "there", "--quiet"}).code;
  ::unsetenv(name.c_str());
  ASSERT_EQ(code, other);
  const auto result = [&](const char* folder) { return json::parse(std::ifstream(dir / folder / "result.json")); };
  compare(result("here"), result("there"), figures, "");
  const auto here = table(dir / "here/profile.csv"), there = table(dir / "there/profile.csv");
  ASSERT_EQ(here.size(), there.size());
  ASSERT_GT(here.size(), 1000u);
  double largest_m = 0.0;
  for (std::size_t i = 0; i < here.size(); ++i) {
    ASSERT_EQ(here[i].size(), there[i].size());
    ASSERT_EQ(std::isfinite(here[i][1]), std::isfinite(there[i][1])) << i;
    if (std::isfinite(here[i][1])) largest_m = std::max(largest_m, std::abs(here[i][1] - there[i][1]));
  }
  EXPECT_LE(largest_m, height_m);
  const auto texture = [&](const char* folder) { return json::parse(std::ifstream(dir / folder / "texture.json")); };
  compare(texture("here"), texture("there"), figures, "texture", height_m);
}

// The same simulated with the variable `name` in the environment.
void expect_the_same_truth(const std::string& name, const std::string& value, double tolerance) {
  const testkit::TempDir dir;
  const auto simulate = [&](const char* folder) {
    return run({"simulate", "--surface", "sandpaper", "--seed", "3", "--set", "hand.length_m=0.02", "-o", dir / folder})
        .code;
  };
  ASSERT_EQ(simulate("here"), 0);
  ::setenv(name.c_str(), value.c_str(), 1);
  const int code = simulate("there");
  ::unsetenv(name.c_str());
  ASSERT_EQ(code, 0);
  const auto here = table(dir / "here/truth.csv"), there = table(dir / "there/truth.csv");
  ASSERT_EQ(here.size(), there.size());
  ASSERT_GT(here.size(), 100u);
  for (std::size_t i = 0; i < here.size(); ++i) {
    ASSERT_EQ(here[i].size(), there[i].size());
    for (std::size_t k = 0; k < here[i].size(); ++k) {
      if (std::isnan(here[i][k]) && std::isnan(there[i][k])) continue;
      ASSERT_NEAR(here[i][k], there[i][k], tolerance) << "row " << i + 2 << ", column " << k + 1;
    }
  }
}

TEST(OtherProcessor, TheFiguresAgree) {
  expect_the_same_figures("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-AVX2_Usable,-AVX2,-FMA_Usable,-FMA", kFigures,
                          kHeight_m);
  expect_the_same_truth("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-AVX2_Usable,-AVX2,-FMA_Usable,-FMA", kTruth);
}

// `scripts/check clang` builds the other program; without it this one is compared with itself, to the last byte.
TEST(OtherCompiler, TheFiguresAgree) {
  const bool built = ::getenv("ASPERITY_OTHER_PROGRAM") != nullptr;
  expect_the_same_figures("ASPERITY_USE_OTHER", "1", built ? kFigures : 0.0, built ? kHeight_m : 0.0);
  expect_the_same_truth("ASPERITY_USE_OTHER", "1", built ? kTruth : 0.0);
}

}  // namespace
}  // namespace asperity::cli
