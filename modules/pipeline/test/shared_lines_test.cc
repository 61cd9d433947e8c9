#include "../src/shared_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "../src/path_runs.h"
#include "../src/run_links.h"

namespace asperity {
namespace {

using Path = std::vector<Eigen::Vector3d>;
constexpr double kStep_m = 25e-6;
constexpr std::size_t kPointsOfNode = 10;

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

// Passes of 30 mm along x in one recording, back and forth, lifted by 3 mm at the ends; within ±0.2 mm of one line, so
// that each pair shares it.
Path rubbed(int passes) {
  Path path;
  for (int i = 0; i < passes; ++i) {
    const double y_m = 0.2e-3 * std::sin(2.4 * i), x0_m = i % 2 == 0 ? 0.0 : 0.03;
    add_line(path, {x0_m, y_m, 0}, {0.03 - x0_m, y_m, 0});
    add_line(path, {0.03 - x0_m, y_m, 0}, {0.03 - x0_m, y_m, 0.003});
    add_line(path, {0.03 - x0_m, y_m, 0.003}, {0.03 - x0_m, y_m, 0});
  }
  return path;
}

TEST(SharedLines, ManyPassesAreOneLine) {
  for (const int passes : {20, 150}) {
    const std::vector<Path> paths{rubbed(passes)};
    const std::vector<SharedLine> lines = find_shared_lines(paths, kStep_m);
    SCOPED_TRACE(passes);
    ASSERT_EQ(lines.size(), 1U);
    ASSERT_EQ(lines[0].size(), static_cast<std::size_t>(passes));
    const auto x_of = [&](std::size_t at) { return paths[0][std::min(at, paths[0].size() - 1)].x(); };
    const LinePass& origin = lines[0][0];
    const double sign = x_of(origin.last - 1) > x_of(origin.first) ? 1.0 : -1.0;
    for (const LinePass& pass : lines[0]) {
      const bool along = (x_of(pass.last - 1) - x_of(pass.first)) * sign > 0.0;
      EXPECT_EQ(pass.place.backward, !along);
      EXPECT_NEAR(pass.place.start_m, (x_of(pass.first) - x_of(origin.first)) * sign, 0.5e-3);
    }
  }
}

// The parts of each line, found by each run's links to all others and a plain search for the most.
std::vector<std::set<std::size_t>> lines_of_all_pairs(const std::vector<Path>& paths) {
  std::vector<std::vector<Node>> nodes;
  std::vector<Run> runs;
  for (std::size_t scan = 0; scan < paths.size(); ++scan) {
    nodes.push_back(make_nodes(paths[scan], kPointsOfNode));
    add_runs(nodes.back(), scan, runs);
  }
  NearNodes near;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    for (std::size_t i = runs[r].first; i < runs[r].last; ++i) near.add(nodes[runs[r].scan][i].p_m, {r, i});
  }
  RunLinker linker(nodes, runs);
  std::vector<std::vector<RunLink>> links;
  for (std::size_t r = 0; r < runs.size(); ++r) links.push_back(linker.links_of(r, near));
  std::vector<char> taken(runs.size(), 0);
  std::vector<std::set<std::size_t>> out;
  while (true) {
    std::size_t best = 0, most = 0;
    for (std::size_t r = 0; r < runs.size(); ++r) {
      std::size_t sum = 0;
      for (const RunLink& link : links[r]) sum += taken[r] == 0 && taken[link.other] == 0 ? link.last - link.first : 0;
      if (sum > most) best = r;
      most = std::max(most, sum);
    }
    if (most == 0) return out;
    // A part by the first of its points that are on the line.
    std::set<std::size_t> line;
    std::size_t first = runs[best].last;
    const auto number = [](std::size_t scan, std::size_t node) { return scan * 1000000 + node; };
    for (const RunLink& link : links[best]) {
      if (taken[link.other] != 0) continue;
      first = std::min(first, link.first);
      line.insert(number(runs[link.other].scan, link.other_first));
      taken[link.other] = 1;
    }
    line.insert(number(runs[best].scan, first));
    taken[best] = 1;
    out.push_back(line);
  }
}

TEST(SharedLines, TheSameAsAllPairs) {
  std::size_t parts = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> part(0.0, 1.0);
    std::vector<Path> paths(1 + seed % 3);
    for (Path& path : paths) {
      for (int stroke = 0; stroke < 12; ++stroke) {
        const double y_m = 0.5e-3 * std::floor(4.0 * part(random)) + 0.4e-3 * part(random), z_m = 3e-3;
        double from_m = 0.03 * part(random), to_m = from_m + 0.01 + 0.05 * part(random);
        if (part(random) < 0.5) std::swap(from_m, to_m);
        add_line(path, {from_m, y_m, 0}, {to_m, y_m, 0});
        add_line(path, {to_m, y_m, 0}, {to_m, y_m, z_m});
      }
    }
    std::vector<std::set<std::size_t>> found;
    for (const SharedLine& line : find_shared_lines(paths, kStep_m)) {
      found.emplace_back();
      for (const LinePass& pass : line) found.back().insert(pass.scan * 1000000 + pass.first / kPointsOfNode);
      parts += line.size();
    }
    EXPECT_EQ(found, lines_of_all_pairs(paths));
  }
  EXPECT_GT(parts, 600U);
}

// Four times the passes are four times the points: with each pair of passes compared it was 16 times the comparisons.
TEST(SharedLines, WorkGrowsWithTheLength) {
  std::size_t of_200 = 0, of_800 = 0;
  EXPECT_EQ(find_shared_lines(std::vector<Path>{rubbed(200)}, kStep_m, &of_200).size(), 1U);
  EXPECT_EQ(find_shared_lines(std::vector<Path>{rubbed(800)}, kStep_m, &of_800).size(), 1U);
  EXPECT_LT(of_800, 5 * of_200);
}

// One recording goes round a circle again and again, without a turn; another one does too.
TEST(SharedLines, WorkOnACircleGrowsWithTheLength) {
  const auto circling = [](int rounds) {
    Path path;
    const double radius_m = 8e-3, turns = 2.0 * std::numbers::pi;
    for (double angle = 0.0; angle < turns * rounds; angle += kStep_m / radius_m)
      path.emplace_back(radius_m * std::cos(angle), radius_m * std::sin(angle), 0.0);
    return path;
  };
  std::size_t of_50 = 0, of_200 = 0;
  find_shared_lines(std::vector<Path>{circling(50), circling(50)}, kStep_m, &of_50);
  find_shared_lines(std::vector<Path>{circling(200), circling(200)}, kStep_m, &of_200);
  EXPECT_LT(of_200, 5 * of_50);
}
}  // namespace
}  // namespace asperity
