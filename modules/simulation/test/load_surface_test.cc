#include "load_surface.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/testkit/temp_dir.h"

namespace asperity {
namespace {

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
