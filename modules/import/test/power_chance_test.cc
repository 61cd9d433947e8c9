#include "../src/power_chance.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace asperity {
namespace {

WindowPowers windows(std::vector<double> power) {
  constexpr std::size_t kLength = 150;
  WindowPowers out{kLength, {}, std::move(power)};
  for (std::size_t i = 0; i < out.power.size(); ++i) out.first.push_back(i * kLength);
  return out;
}

// Powers about `mean` that spread by a fifth.
std::vector<double> spread(double mean, std::size_t count) {
  std::vector<double> out;
  for (std::size_t i = 0; i < count; ++i) out.push_back(mean * (0.8 + 0.1 * static_cast<double>((7 * i) % 5)));
  return out;
}

// A sensor that repeats itself for one window is not a sensor without noise.
TEST(PowerChance, OneSilentWindowLeavesTheOthers) {
  std::vector<double> quiet = spread(1.0, 20);
  const double before = power_chance(windows(spread(1.0, 20)), windows(quiet));
  quiet[7] = 0.0;
  EXPECT_GT(before, 0.1);
  EXPECT_GT(power_chance(windows(spread(1.0, 20)), windows(quiet)), 0.1);
  EXPECT_LT(power_chance(windows(spread(2.0, 20)), windows(quiet)), 1e-3);
}

TEST(PowerChance, OfSilenceAlone) {
  EXPECT_EQ(power_chance(windows(spread(1.0, 20)), windows(std::vector<double>(20, 0.0))), 0.0);
  EXPECT_EQ(power_chance(windows(std::vector<double>(20, 0.0)), windows(spread(1.0, 20))), 1.0);
}

}  // namespace
}  // namespace asperity
