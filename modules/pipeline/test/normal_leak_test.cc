#include "../src/normal_leak.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace asperity {
namespace {

// A straight stroke along x over the plane z = 0 at 1 kHz, whose hand trembles across it by noise about 8 Hz, on a base
// whose normal leans by `lean_rad` about the direction of travel. The surface has noise of `rough_m`.
double leak_of(double lean_rad, double rough_m, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  TipMotion motion;
  BasePath base;
  const double dt_s = 1e-3, w = 2.0 * std::acos(-1.0) * 8.0;
  double sway = 0.0, sway_rate = 0.0, rough = 0.0;
  const Eigen::Vector3d n(0.0, std::sin(lean_rad), std::cos(lean_rad));
  for (int i = 0; i < 4000; ++i) {
    sway_rate += dt_s * (-w * w * sway - 0.2 * w * sway_rate) + 3e-3 * normal(random) * std::sqrt(dt_s) * w;
    sway += dt_s * sway_rate;
    rough += dt_s / 0.02 * -rough + rough_m * std::sqrt(2.0 * dt_s / 0.02) * normal(random);
    const Eigen::Vector3d p(0.03 * dt_s * i, 0.1 * sway, rough);
    motion.t_ns.push_back(1'000'000LL * i);
    motion.p_world_tip_m.push_back(p);
    motion.v_world_tip_mps.push_back({0.03, 0.1 * sway_rate, 0.0});
    base.p_world_m.push_back(p - n * n.dot(p));
    base.n_world.push_back(n);
  }
  motion.q_world_marker.assign(motion.t_ns.size(), Eigen::Quaterniond::Identity());
  base.s_m.resize(motion.t_ns.size());
  const std::vector<char> moving(motion.t_ns.size(), 1);
  return normal_leak(motion, off_base(motion, base), moving);
}

TEST(NormalLeak, FindsANormalThatLeans) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    EXPECT_NEAR(std::abs(leak_of(0.3, 1e-6, seed)), std::tan(0.3), 0.05) << seed;
  }
}

TEST(NormalLeak, OfTheSurfaceItselfThereIsNone) {
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) found += leak_of(0.0, 20e-6, seed) != 0.0 ? 1 : 0;
  EXPECT_LE(found, 1);
}

}  // namespace
}  // namespace asperity
