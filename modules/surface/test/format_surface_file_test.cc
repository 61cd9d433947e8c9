#include "asperity/surface/format_surface_file.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "asperity/surface/parse_surface_file.h"

namespace asperity {
namespace {

ArealMap relief(std::size_t columns, std::size_t rows) {
  ArealMap map{0.5e-6, rows > 1 ? 1.25e-6 : 0.0, columns, rows, {}};
  for (std::size_t i = 0; i < columns * rows; ++i)
    map.height_m.push_back(i % 5 == 3 ? kNan : 1e-6 * std::sin(static_cast<double>(i)));
  return map;
}

void expect_same(const ArealMap& got, const ArealMap& want, double tolerance_m) {
  EXPECT_EQ(got.columns, want.columns);
  EXPECT_EQ(got.rows, want.rows);
  EXPECT_DOUBLE_EQ(got.x_spacing_m, want.x_spacing_m);
  EXPECT_DOUBLE_EQ(got.y_spacing_m, want.y_spacing_m);
  ASSERT_EQ(got.height_m.size(), want.height_m.size());
  for (std::size_t i = 0; i < want.height_m.size(); ++i) {
    if (std::isnan(want.height_m[i])) {
      EXPECT_TRUE(std::isnan(got.height_m[i])) << i;
    } else {
      EXPECT_NEAR(got.height_m[i], want.height_m[i], tolerance_m) << i;
    }
  }
}

TEST(FormatSurfaceFile, IsReadAgainWithItsGaps) {
  for (const ArealMap& map : {relief(7, 4), relief(13, 1), relief(4, 9)}) {
    const auto read = [](const std::string& bytes) { return parse_surface_file(bytes, "file").value(); };
    expect_same(read(format_gsf(map)).map, map, 1e-13);  // 32-bit numbers of a micrometre
    expect_same(read(format_sdf(map, SdfForm::kText)).map, map, 0.0);
    expect_same(read(format_sdf(map, SdfForm::kBinary)).map, map, 0.0);
    EXPECT_EQ(read(format_sdf(map, SdfForm::kText)).is_profile(), map.rows == 1);
  }
}

// The header's fields as ISO 25178-71 is described: sizes of 8, 10, 12 and 12 bytes, then 2 · 2, 4 · 8 and 3.
TEST(FormatSurfaceFile, TheBinaryHeaderHas81Bytes) {
  EXPECT_EQ(format_sdf(relief(7, 4), SdfForm::kBinary).size(), 81u + 28u * 8u);
  EXPECT_EQ(format_gsf(relief(7, 4)).size() % 4, 0u);
}

TEST(FormatSurfaceFile, RefusesWhatIsNoRelief) {
  ArealMap map = relief(7, 4);
  map.height_m[2] = std::numeric_limits<double>::infinity();
  EXPECT_THROW(format_gsf(map), Error);
  map = relief(7, 4);
  map.x_spacing_m = 0.0;
  EXPECT_THROW(format_sdf(map, SdfForm::kText), Error);
  map = relief(70000, 1);
  EXPECT_THROW(format_sdf(map, SdfForm::kBinary), Error);
  EXPECT_NO_THROW(format_sdf(map, SdfForm::kText));
  map.height_m.pop_back();
  EXPECT_THROW(format_gsf(map), Error);
}

}  // namespace
}  // namespace asperity
