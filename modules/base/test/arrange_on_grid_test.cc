#include "asperity/base/arrange_on_grid.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace asperity {
namespace {

using Points = std::vector<std::array<double, 3>>;

// Column c, row r of a grid of 1 µm by 2 µm from (−3, 5) mm has the height 100 r + c.
Points grid(std::size_t columns, std::size_t rows) {
  Points out;
  for (std::size_t r = 0; r < rows; ++r) {
    for (std::size_t c = 0; c < columns; ++c) {
      const auto x = static_cast<double>(c), y = static_cast<double>(r);
      out.push_back({-3e-3 + 1e-6 * x, 5e-3 + 2e-6 * y, 100.0 * y + x});
    }
  }
  return out;
}

TEST(ArrangeOnGrid, TakesAnyOrderAndLeavesGaps) {
  Points points = grid(40, 30);
  std::shuffle(points.begin(), points.end(), std::mt19937(1));
  // A third of the points are missing, a whole row and a whole column of them.
  std::erase_if(points, [](const auto& p) {
    const int height = static_cast<int>(p[2]);
    return height % 3 == 0 || height / 100 == 7 || height % 100 == 11;
  });
  const auto map = arrange_on_grid(points);
  ASSERT_TRUE(map);
  ASSERT_EQ(map->columns, 40u);
  ASSERT_EQ(map->rows, 30u);
  EXPECT_NEAR(map->x_spacing_m, 1e-6, 1e-15);
  EXPECT_NEAR(map->y_spacing_m, 2e-6, 1e-15);
  std::size_t present = 0;
  for (std::size_t i = 0; i < map->height_m.size(); ++i) {
    if (std::isnan(map->height_m[i])) continue;
    ++present;
    EXPECT_EQ(map->height_m[i], 100.0 * static_cast<double>(i / 40) + static_cast<double>(i % 40));
  }
  EXPECT_EQ(present, points.size());
}

TEST(ArrangeOnGrid, RefusesWhatIsNoGrid) {
  const Points full = grid(8, 6);
  Points twice = full, off = full, cut = full, line(full.begin(), full.begin() + 8);
  twice.push_back(full[3]);
  off[9][0] += 0.3e-6;
  cut.resize(full.size() - 3);
  EXPECT_FALSE(arrange_on_grid(twice));
  EXPECT_FALSE(arrange_on_grid(off));
  EXPECT_FALSE(arrange_on_grid(cut));
  EXPECT_FALSE(arrange_on_grid(line));
  EXPECT_FALSE(arrange_on_grid({}));
  // Scattered points, whose grid would be nearly empty.
  std::mt19937 random(2);
  std::uniform_real_distribution<double> anywhere(0.0, 1.0);
  Points scattered(200);
  for (auto& p : scattered) p = {anywhere(random), anywhere(random), 0.0};
  EXPECT_FALSE(arrange_on_grid(scattered));
}

}  // namespace
}  // namespace asperity
