#include "../src/shared_lines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace asperity {
namespace {

using Path = std::vector<Eigen::Vector3d>;
constexpr double kStep_m = 25e-6;

// Straight pieces between corners, joined by half circles where `radius_m` is given; points every 25 µm.
void add_line(Path& path, const Eigen::Vector3d& from_m, const Eigen::Vector3d& to_m) {
  const auto count = static_cast<int>(std::lround((to_m - from_m).norm() / kStep_m));
  for (int i = 0; i < count; ++i) path.emplace_back(from_m + (to_m - from_m) * (static_cast<double>(i) / count));
}

// A stroke of 40 mm along x, a loop at its end, and back at y = `apart_m`.
Path there_and_back(double apart_m) {
  Path path;
  add_line(path, {0, 0, 0}, {0.04, 0, 0});
  const double radius_m = 0.5 * std::max(apart_m, 2e-3);
  for (double angle = 0.0; angle < std::numbers::pi; angle += kStep_m / radius_m)
    path.emplace_back(0.04 + radius_m * std::sin(angle), radius_m * (1.0 - std::cos(angle)), 0.0);
  add_line(path, {0.04, 2.0 * radius_m, 0}, {0.038, apart_m, 0});
  add_line(path, {0.038, apart_m, 0}, {0.0, apart_m, 0});
  return path;
}

TEST(SharedLines, AStrokeThatComesBack) {
  const std::vector<Path> paths{there_and_back(0.2e-3)};
  const std::vector<SharedLine> lines = find_shared_lines(paths, kStep_m);
  ASSERT_EQ(lines.size(), 1U);
  ASSERT_EQ(lines[0].size(), 2U);
  for (const LinePass& pass : lines[0]) {
    EXPECT_EQ(pass.scan, 0U);
    const Path part(paths[0].begin() + static_cast<std::ptrdiff_t>(pass.first),
                    paths[0].begin() + static_cast<std::ptrdiff_t>(pass.last));
    EXPECT_NEAR(part.front().x(), pass.place.backward ? 0.038 : 0.0, 2.5e-3);
    EXPECT_NEAR(part.back().x(), pass.place.backward ? 0.0 : 0.038, 2.5e-3);
  }
  const LinePass &one = lines[0][0], &other = lines[0][1];
  EXPECT_NE(one.place.backward, other.place.backward);
  EXPECT_EQ(one.place.start_m, 0.0);
  // Along the first one's own direction.
  const double apart_m = std::abs(paths[0][one.first].x() - paths[0][other.first].x());
  EXPECT_NEAR(other.place.start_m, apart_m, 0.2e-3);
}

TEST(SharedLines, RowsAndCrossingsAreNone) {
  EXPECT_TRUE(find_shared_lines(std::vector<Path>{there_and_back(2.5e-3)}, kStep_m).empty());
  std::vector<Path> paths(2);
  add_line(paths[0], {-0.02, 0, 0}, {0.02, 0, 0});
  add_line(paths[1], {0, -0.02, 0}, {0, 0.02, 0});
  EXPECT_TRUE(find_shared_lines(paths, kStep_m).empty());
}

TEST(SharedLines, ScansOverPartsOfOneLine) {
  std::vector<Path> paths(4);
  add_line(paths[0], {0, 0, 0}, {0.06, 0, 0});
  add_line(paths[1], {0.02, 0.1e-3, 0}, {0.08, 0.1e-3, 0});
  add_line(paths[2], {0.05, -0.1e-3, 0}, {0.01, -0.1e-3, 0});
  add_line(paths[3], {0, 0.01, 0}, {0.06, 0.01, 0});
  const std::vector<SharedLine> lines = find_shared_lines(paths, kStep_m);
  ASSERT_EQ(lines.size(), 1U);
  ASSERT_EQ(lines[0].size(), 3U);
  const double origin_m = paths[lines[0][0].scan][lines[0][0].first].x();
  for (const LinePass& pass : lines[0]) {
    EXPECT_NE(pass.scan, 3U);
    EXPECT_EQ(pass.place.backward, pass.scan == 2);
    EXPECT_NEAR(pass.place.start_m, paths[pass.scan][pass.first].x() - origin_m, 0.3e-3);
  }
}

TEST(SharedLines, ScansWithoutAPathAreNone) {
  std::vector<Path> paths(3);
  add_line(paths[1], {0, 0, 0}, {0.03, 0, 0});
  paths[2].assign(2000, Eigen::Vector3d::Constant(std::nan("")));
  EXPECT_TRUE(find_shared_lines(paths, kStep_m).empty());
}

}  // namespace
}  // namespace asperity
