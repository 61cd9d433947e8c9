#include "load_surface.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/testkit/temp_dir.h"

namespace asperity {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class LoadSurface : public ::testing::Test {
 protected:
  std::unique_ptr<Surface> load(const std::string& text) {
    write_file(folder_.path() / "relief.csv", text);
    config_.kind = SurfaceKind::kFile;
    config_.file = (folder_.path() / "relief.csv").string();
    return load_surface(config_);
  }
  testkit::TempDir folder_;
  SimulatedSurfaceConfig config_;
};

TEST_F(LoadSurface, ReadsHeightsAloneAndMirrorsThem) {
  config_.file_spacing_m = 1e-3;
  const auto surface = load("height\n0\n1\n5\n");  // µm, mean 2
  EXPECT_NEAR(surface->height_m(-1e-3, 0.0), -2e-6, 1e-18);
  EXPECT_NEAR(surface->height_m(0.0, 0.3), -1e-6, 1e-18);
  EXPECT_NEAR(surface->height_m(0.5e-3, 0.0), 1e-6, 1e-18);
  EXPECT_NEAR(surface->height_m(2e-3, 0.0), -1e-6, 1e-18);
  EXPECT_NEAR(surface->height_m(-2e-3, 0.0), -1e-6, 1e-18);
}

TEST_F(LoadSurface, ReadsPositionsWithUnits) {
  const auto surface = load("s_mm,height_um\r\n0,10\r\n2,20\r\n4,30\r\n");
  EXPECT_NEAR(surface->height_m(1e-3, 0.0), 5e-6, 1e-15);
}

TEST_F(LoadSurface, TakesThePlaneFromAMap) {
  // 3 × 3, z = 100 + 7 x + 3 y µm and a bump of 9 in the middle: the plane takes 1 of it.
  std::string text;
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 3; ++x) {
      const int z = 100 + 7 * x + 3 * y + (x == 1 && y == 1 ? 9 : 0);
      text += std::to_string(x * 0.005) + "," + std::to_string(y * 0.005) + "," + std::to_string(z) + "\n";
    }
    text += "\n\n";
  }
  const auto surface = load(text);
  EXPECT_NEAR(surface->height_m(0.0, 0.0), 8e-6, 1e-12);
  EXPECT_NEAR(surface->height_m(5e-6, 5e-6), -1e-6, 1e-12);
  EXPECT_NEAR(surface->height_m(2.5e-6, 0.0), 3.5e-6, 1e-12);
  EXPECT_NEAR(surface->height_m(10e-6, 10e-6), 8e-6, 1e-12);  // mirrored
}

// A TIFF by its specification (6.0): one strip of 16-bit counts, little-endian, its directory after them.
std::string tiff_of(const std::vector<unsigned>& counts, unsigned columns, unsigned rows) {
  std::string out("II*\0", 4);
  const auto put = [&out](unsigned value, int bytes) {
    for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i) & 0xffU);
  };
  put(8 + 2 * columns * rows, 4);
  for (const unsigned count : counts) put(count, 2);
  const std::vector<std::array<unsigned, 2>> fields{{256, columns}, {257, rows}, {258, 16},
                                                    {259, 1},       {262, 1},    {273, 8},
                                                    {277, 1},       {278, rows}, {279, 2 * columns * rows}};
  put(static_cast<unsigned>(fields.size()), 2);
  for (const auto& [tag, value] : fields) {
    put(tag, 2);
    put(4, 2);  // LONG
    put(1, 4);
    put(value, 4);
  }
  put(0, 4);
  return out;
}

TEST_F(LoadSurface, ReadsATiffAtItsUnitAndSpacing) {
  config_.file_spacing_m = 20e-6;
  config_.file_unit_m = 2e-9;  // a height a count
  // 3 x 3, counts 30000 + 500 x, a bump of 900 in the middle: the plane takes 100 of it and all of the slope.
  const auto surface = load(tiff_of({30000, 30500, 31000, 30000, 31400, 31000, 30000, 30500, 31000}, 3, 3));
  EXPECT_NEAR(surface->height_m(0.0, 0.0), 800 * 2e-9, 1e-15);
  EXPECT_NEAR(surface->height_m(20e-6, 20e-6), -100 * 2e-9, 1e-15);
  EXPECT_NEAR(surface->height_m(10e-6, 0.0), 350 * 2e-9, 1e-15);
  config_.file_spacing_m = 0.0;
  EXPECT_THAT(
      [&] {
        load(tiff_of({1, 2, 3, 4}, 2, 2));
      },
      ThrowsMessage<Error>(AllOf(HasSubstr("relief.csv"), HasSubstr("states no spacing"))));
}

TEST_F(LoadSurface, ReadsTablesOfStylusInstruments) {
  // Heights 2, 4, 9 µm, mean 5; German, with header lines, Latin-1 and decimal commas.
  for (const char* text : {"Messger\xe4t;T1\r\nx [mm];z [\xb5m]\r\n0,00;2,0\r\n0,02;4,0\r\n0,04;9,0\r\n",
                           "Profile 1\nX\tZ\nmm\tum\n0.00\t2\n0.02\t4\n0.04\t9\n"}) {
    const auto surface = load(text);
    EXPECT_NEAR(surface->height_m(0.0, 0.0), -1e-6, 1e-15) << text;
    EXPECT_NEAR(surface->height_m(20e-6, 0.0), 4e-6, 1e-15) << text;
    EXPECT_NEAR(surface->height_m(-10e-6, 0.0), -2e-6, 1e-15) << text;
  }
  const auto map = load("x [mm];y [mm];z [nm]\n0;0;0\n0.01;0;0\n0;0.01;0\n0.01;0.01;4000\n");
  EXPECT_NEAR(map->height_m(5e-6, 5e-6), 1e-6, 1e-15);  // the plane leaves ±1 µm of 4 at a corner
  EXPECT_NEAR(map->height_m(5e-6, -5e-6), -1e-6, 1e-15);
}

TEST_F(LoadSurface, NamesTheSettingThatATableWithoutUnitsNeeds) {
  const std::string text = "0.00;2\n0.02;4\n0.04;9\n";
  EXPECT_THAT([&] { load(text); }, ThrowsMessage<Error>(HasSubstr("--set surface.file_units=mm,um")));
  config_.file_units = "mm,um";
  EXPECT_NEAR(load(text)->height_m(20e-6, 0.0), 4e-6, 1e-15);
}

TEST_F(LoadSurface, ReadsAColumnWithDecimalCommasAndAProfileOfAResult) {
  EXPECT_NEAR(load("s_m,height_m,texture_m,texture_sigma_m\n0,7,1e-6,1e-7\n1e-3,7,2e-6,1e-7\n2e-3,7,6e-6,1e-7\n")
                  ->height_m(1e-3, 0.0),
              3e-6, 1e-15);
  config_.file_spacing_m = 1e-3;
  config_.file_unit_m = 1e-3;
  EXPECT_NEAR(load("2,0\n4,5\n8,5\n")->height_m(1e-3, 0.0), 3.5e-3, 1e-15);
}

TEST_F(LoadSurface, NamesTheLineOfAFault) {
  EXPECT_THAT([&] { load("s_m,height_m\n0,0\n1e-3,x\n"); }, ThrowsMessage<Error>(HasSubstr("relief.csv:3")));
  EXPECT_THAT([&] { load("0,0\n1e-3,1e-6\n5e-3,2e-6\n"); }, ThrowsMessage<Error>(HasSubstr("relief.csv:2")));
  EXPECT_THAT([&] { load("0\n1\n2,3\n"); }, ThrowsMessage<Error>(HasSubstr("relief.csv:3")));
  EXPECT_THAT([&] { load("1\n2\nnan\n"); }, ThrowsMessage<Error>(HasSubstr("not finite")));
  EXPECT_THAT([&] { load("0,0,1\n1,0,1\n0,1,1\n1,1,nan\n"); }, ThrowsMessage<Error>(HasSubstr("point 2 of row 2")));
  EXPECT_THAT([&] { load("0,0,1\n1,0,1\n0,1,1\n1,1,1e9\n"); }, ThrowsMessage<Error>(HasSubstr("unit")));
  EXPECT_THAT([&] { load("1\n2\n3e9\n"); }, ThrowsMessage<Error>(HasSubstr("unit")));
  EXPECT_THAT([&] { load("0,0,1\n1,0,1\n0,1,1\n"); },
              ThrowsMessage<Error>(HasSubstr("relief.csv:3: the last row has 1 points where the first has 2")));
  EXPECT_THAT([&] { load("1,2,3,4\n"); }, ThrowsMessage<Error>(HasSubstr("more than three")));
  EXPECT_THROW(load(""), Error);
  config_.file = "no/such/file.csv";
  EXPECT_THROW(load_surface(config_), Error);
}

}  // namespace
}  // namespace asperity
