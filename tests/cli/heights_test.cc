// Each command that reads heights reads every kind of file of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "asperity/testkit/temp_dir.h"
#include "run_asperity.h"

namespace asperity::cli {
namespace {

using ::testing::HasSubstr;

constexpr int kColumns = 200, kRows = 120;
constexpr double kStep_m = 20e-6, kHeight_m = 20e-6;

// Whole periods: of the map Sq is half of the height, of its first row Rq is it over the root of two.
double height_m(int column, int row) {
  return kHeight_m * std::sin(2.0 * std::numbers::pi * (column + 0.5) / 40.0) *
         std::cos(2.0 * std::numbers::pi * row / 60.0);
}

void append(std::string& out, std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i) & 0xffU);
}

struct Pixels {
  int bits;
  int format;  // 1 unsigned, 2 signed, 3 float
};

// A TIFF by its specification (6.0): one strip, then the directory. Counts of nanometres, floats of micrometres.
std::string tiff(Pixels kind) {
  std::string out("II*\0", 4);
  const std::uint64_t data = static_cast<std::uint64_t>(kColumns) * kRows * static_cast<std::uint64_t>(kind.bits) / 8;
  append(out, 8 + data, 4);
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const double z_m = height_m(column, row);
      if (kind.format == 3) {
        append(out, std::bit_cast<std::uint32_t>(static_cast<float>(1e6 * z_m)), 4);
      } else {
        append(out, static_cast<std::uint64_t>(std::llround(1e9 * z_m) + (kind.format == 1 ? 30000 : 0)),
               kind.bits / 8);
      }
    }
  }
  const std::vector<std::array<std::uint64_t, 2>> fields{{256, kColumns},
                                                         {257, kRows},
                                                         {258, static_cast<std::uint64_t>(kind.bits)},
                                                         {259, 1},
                                                         {262, 1},
                                                         {273, 8},
                                                         {277, 1},
                                                         {278, kRows},
                                                         {279, data},
                                                         {339, static_cast<std::uint64_t>(kind.format)}};
  append(out, fields.size(), 2);
  for (const auto& [tag, value] : fields) {
    append(out, tag, 2);
    append(out, 4, 2);
    append(out, 1, 4);
    append(out, value, 4);
  }
  append(out, 0, 4);
  return out;
}

std::string with_commas(std::string text) {
  for (char& c : text) c = c == '.' ? ',' : c;
  return text;
}

struct HeightsFile {
  std::string name, content;
  bool is_map = false;
  std::vector<std::string> options;  // of the commands that have settings `input`
  std::vector<std::string> of_simulate;
};

std::vector<HeightsFile> tables() {
  std::string map = "x [mm];y [mm];z [µm]\n", plain_map = "x_mm,y_mm,z_um\n";
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const double x = 1e3 * kStep_m * column, y = 1e3 * kStep_m * row, z = 1e6 * height_m(column, row);
      map += with_commas(fmt::format("{:.3f};{:.3f};{:.9f}\n", x, y, z));
      plain_map += fmt::format("{:.3f},{:.3f},{:.9f}\n", x, y, z);
    }
  }
  std::string tabs = "Program A\nDate\t1.2.2020\nx [mm]\tz [µm]\n", without, column, commas,
              profile = "s_m,height_m,texture_m,texture_sigma_m\n", plain = "x_mm,z_um\n",
              smd =
                  fmt::format("ISO 5436 - 2000\nPRF\t0\tone\nCX\tI\t{0}\tm\t1.0\tD\t{1}\nCZ\tA\t{0}\tm\t1.0\tD\n\3\n\3",
                              kColumns, kStep_m);
  for (int i = 0; i < kColumns; ++i) {
    const double x = 1e3 * kStep_m * i, z = 1e6 * height_m(i, 0);
    tabs += fmt::format("{:.3f}\t{:.9f}\n", x, z);
    without += fmt::format("{:.3f};{:.9f}\n", x, z);
    plain += fmt::format("{:.3f},{:.9f}\n", x, z);
    column += fmt::format("{:.9f}\n", z);
    commas += with_commas(fmt::format("{:.9f}\n", z));
    profile += fmt::format("{:.6f},{:.15f},{:.15f},1e-8\n", 1e-3 * x, 1e-6 * z, 1e-6 * z);
    smd += fmt::format("{:.15f}\n", 1e-6 * z);
  }
  const std::vector<std::string> spacing{"--spacing", "20um"};
  return {{"map.csv", map, true, {}, {}},
          {"xyz.csv", plain_map, true, {}, {}},
          {"tabs.txt", tabs, false, {}, {}},
          {"without.txt", without, false, {"--set", "input.units=mm,um"}, {"--set", "surface.file_units=mm,um"}},
          {"plain.csv", plain, false, {}, {}},
          {"column.txt", column, false, spacing, spacing},
          {"commas.txt", commas, false, spacing, spacing},
          {"profile.csv", profile, false, {}, {}},
          {"line.smd", smd + "\3 0\n\x1a", false, {}, {}}};
}

std::vector<HeightsFile> tiffs() {
  const std::vector<std::string> counts{"--spacing", "20um", "--set", "input.unit=nm"}, floats{"--spacing", "20um"},
      simulated{"--spacing", "20um", "--set", "surface.file_unit_m=1e-9"};
  return {{"u16.tif", tiff({16, 1}), true, counts, simulated},
          {"i32.tif", tiff({32, 2}), true, counts, simulated},
          {"f32.tif", tiff({32, 3}), true, floats, floats}};
}

class EveryHeightsFile : public testing::Test {
 protected:
  std::string at(const std::string& name) const { return (dir_.path() / name).string(); }

  Outcome run_with(std::vector<std::string> arguments, const std::vector<std::string>& options) const {
    arguments.insert(arguments.end(), options.begin(), options.end());
    return cli::run(arguments);
  }

  // Rq or Sq, in units of its value in closed form.
  double root_mean_square(const HeightsFile& file, const std::string& path,
                          const std::vector<std::string>& options) const {
    const Outcome ran = run_with({"roughness", path, "--json"}, options);
    EXPECT_EQ(ran.code, 0) << path << ran.err;
    if (ran.code != 0) return 0.0;
    const auto values = nlohmann::json::parse(ran.out).at("roughness");
    return file.is_map ? values.at("Sq_m").get<double>() / (0.5 * kHeight_m)
                       : values.at("Rq_m").get<double>() / (kHeight_m / std::numbers::sqrt2);
  }

  void check(const HeightsFile& file) const {
    SCOPED_TRACE(file.name);
    // Counts of 1 nm: ±0.5 nm of 10 µm; the plane of a map takes 5e-3 of a sine's power, which it is not orthogonal to.
    const double tolerance = file.is_map ? 5e-3 : 1e-6;
    const std::string path = at(file.name);
    write_text(path, file.content);
    EXPECT_NEAR(root_mean_square(file, path, file.options), 1.0, tolerance);
    const std::string before = at(file.name + ".out");
    for (const std::string to : {"x3p", "sdf", "sdf-binary", "gsf"}) {
      const Outcome exported = run_with({"export", path, "--to", to, "-o", before + to}, file.options);
      ASSERT_EQ(exported.code, 0) << to << exported.err;
      const auto stem = std::filesystem::path(path).stem().string();
      const std::string ending = to == "sdf-binary" ? "sdf" : to;
      EXPECT_NEAR(root_mean_square(file, before + to + "/" + stem + "." + ending, {}), 1.0, tolerance) << to;
    }
    const std::vector<std::vector<std::string>> commands{
        {"plot", path, "-o", before + ".svg"},
        {"texture", "compare", path, path},
        {"texture", "fit", path, "--model", file.is_map ? "areal" : "fourier1d", "-o", before + ".texture.json"}};
    for (const auto& command : commands) {
      const Outcome ran = run_with(command, file.options);
      EXPECT_EQ(ran.code, 0) << command[0] << ' ' << command[1] << ran.err;
    }
    const Outcome scanned = run_with({"simulate", "--surface", path, "-o", before + ".rec"}, file.of_simulate);
    EXPECT_EQ(scanned.code, 0) << scanned.err;
  }

  const testkit::TempDir dir_;
};

TEST_F(EveryHeightsFile, IsReadByEachCommandAsATable) {
  for (const HeightsFile& file : tables()) check(file);
}

TEST_F(EveryHeightsFile, IsReadByEachCommandAsATiff) {
  for (const HeightsFile& file : tiffs()) check(file);
}

TEST_F(EveryHeightsFile, WarnsOfASumThatDoesNotHold) {
  const std::string line = tables().back().content;  // an SMD, which states 0
  write_text(at("line.smd"), line);
  unsigned sum = 0;
  for (const char c : line.substr(0, line.rfind('\3') + 1)) sum += static_cast<unsigned char>(c);
  const std::string warning = fmt::format("the sum of its bytes is {} (modulo 65535), but it states 0", sum % 65535);
  EXPECT_THAT(cli::run({"roughness", at("line.smd")}).out, HasSubstr(warning));
  const auto json = nlohmann::json::parse(cli::run({"roughness", at("line.smd"), "--json"}).out);
  ASSERT_EQ(json.at("problems").size(), 1U);
  EXPECT_EQ(json.at("problems")[0].at("kind"), "checksum");
  const Outcome exported = cli::run({"export", at("line.smd"), "--to", "x3p", "-o", at("x")});
  EXPECT_EQ(exported.code, 0);
  EXPECT_THAT(exported.out, HasSubstr("warning: " + at("line.smd") + ": " + warning));
  EXPECT_FALSE(nlohmann::json::parse(cli::run({"roughness", at("x/line.x3p"), "--json"}).out).contains("problems"));
  const Outcome fitted = cli::run({"texture", "fit", at("line.smd"), "-o", at("line.texture.json")});
  EXPECT_EQ(fitted.code, 0) << fitted.err;
  EXPECT_THAT(fitted.out, HasSubstr("note: " + at("line.smd") + ": " + warning));
  EXPECT_THAT(cli::run({"texture", "compare", at("line.smd"), at("line.texture.json")}).err, HasSubstr(warning));
  const std::vector<std::string> simulate{"simulate",           "--surface", at("line.smd"), "--set",
                                          "hand.length_m=0.01", "-o",        at("rec")};
  const Outcome simulated = cli::run(simulate);
  EXPECT_EQ(simulated.code, 0) << simulated.err;
  EXPECT_THAT(simulated.out, HasSubstr("warning: " + at("line.smd") + ": " + warning));
  std::vector<std::string> with_json = simulate;
  with_json.push_back("--json");
  const auto about = nlohmann::json::parse(cli::run(with_json).out);
  ASSERT_EQ(about.at("problems").size(), 1U);
  EXPECT_EQ(about.at("problems")[0].at("kind"), "checksum");
}

TEST_F(EveryHeightsFile, OfATiffIsRefusedWithoutASpacing) {
  write_text(at("u16.tif"), tiff({16, 1}));
  for (const std::vector<std::string>& command :
       std::vector<std::vector<std::string>>{{"roughness", at("u16.tif")},
                                             {"export", at("u16.tif"), "--to", "x3p", "-o", at("x")},
                                             {"plot", at("u16.tif"), "-o", at("p.svg")},
                                             {"simulate", "--surface", at("u16.tif"), "-o", at("r")}}) {
    const Outcome ran = cli::run(command);
    EXPECT_EQ(ran.code, 1) << command[0];
    EXPECT_THAT(ran.err, HasSubstr("states no spacing")) << command[0];
  }
}

}  // namespace
}  // namespace asperity::cli
