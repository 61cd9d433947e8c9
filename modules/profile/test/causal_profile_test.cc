#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/profile/causal_contact.h"
#include "asperity/profile/causal_grid.h"
#include "asperity/profile/causal_high_pass.h"

namespace asperity {
namespace {

constexpr double kSpacing_m = 0.025e-3;

CausalGrid::Sample sample(double s_m, double height_m) {
  CausalGrid::Sample out;
  out.t_ns = std::llround(s_m / 25e-3 * 1e9);
  out.s_m = s_m;
  out.height_m = height_m;
  return out;
}

double wave_m(double s_m) { return 50e-6 * std::sin(2.0 * std::numbers::pi * s_m / 1e-3); }

TEST(CausalGrid, AWaveComesThroughDenseAndSparseSamples) {
  for (const double step_m : {2e-6, 6.25e-6, 40e-6, 62e-6}) {
    CausalGrid grid(kSpacing_m, 0.6e-3);
    std::vector<CausalGrid::Sample> out;
    for (double s = 0.0; s < 10e-3; s += step_m) grid.push(sample(s, wave_m(s)), out);
    ASSERT_GT(out.size(), 380u) << step_m;
    for (std::size_t i = 2; i < out.size(); ++i) {
      EXPECT_NEAR(out[i].s_m, static_cast<double>(std::llround(out[i].s_m / kSpacing_m)) * kSpacing_m, 1e-12);
      // A cell's mean lowers the wave by 0.1 %, the cubic through 16 samples a wave by 1 %.
      EXPECT_NEAR(out[i].height_m, wave_m(out[i].s_m), 1e-6) << step_m << " at " << out[i].s_m;
    }
  }
}

TEST(CausalGrid, StepsBackAndRestsLeaveNoTrace) {
  CausalGrid grid(kSpacing_m, 0.6e-3);
  std::vector<CausalGrid::Sample> out;
  for (double s = 0.0; s < 4e-3; s += 5e-6) grid.push(sample(s, 1e-6), out);
  for (double s = 3.98e-3; s > 3e-3; s -= 5e-6) grid.push(sample(s, 1.0), out);
  for (double s = 4e-3; s < 8e-3; s += 5e-6) grid.push(sample(s, 1e-6), out);
  for (std::size_t i = 1; i < out.size(); ++i) {
    EXPECT_NEAR(out[i].s_m - out[i - 1].s_m, kSpacing_m, 1e-12);
    EXPECT_NEAR(out[i].height_m, 1e-6, 1e-12);
  }
}

TEST(CausalGrid, HolesAreNan) {
  CausalGrid grid(kSpacing_m, 0.6e-3);
  std::vector<CausalGrid::Sample> out;
  for (double s = 0.0; s < 2e-3; s += 5e-6) grid.push(sample(s, 1e-6), out);
  for (double s = 3e-3; s < 5e-3; s += 5e-6) grid.push(sample(s, 1e-6), out);
  int holes = 0;
  for (std::size_t i = 1; i < out.size(); ++i) {
    EXPECT_NEAR(out[i].s_m - out[i - 1].s_m, kSpacing_m, 1e-12);
    holes += std::isnan(out[i].height_m) ? 1 : 0;
  }
  EXPECT_NEAR(holes, 40, 2);
  EXPECT_THROW(CausalGrid(0.0, 1.0), Error);
}

TEST(CausalHighPass, GainAtTheCutOffIsThatOfTheBatch) {
  CausalHighPass filter(kSpacing_m, 0.1, 2e-3);
  double highest_m = 0.0;
  for (int i = 0; i < 8000; ++i) {
    const double s_mm = 1e3 * kSpacing_m * i;
    const double y = filter.push(std::sin(2.0 * std::numbers::pi * 0.1 * s_mm));
    if (i > 4000) highest_m = std::max(highest_m, y);
  }
  EXPECT_NEAR(highest_m, std::sqrt(0.5), 2e-3);
  EXPECT_GT(filter.group_delay_m(0.4), 0.0);
  EXPECT_LT(filter.group_delay_m(0.4), 0.5e-3);
}

TEST(CausalHighPass, AShortHoleIsBridgedAndALongOneBeginsAnew) {
  CausalHighPass filter(kSpacing_m, 0.1, 2e-3);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 100; ++i) filter.push(1e-3);
  EXPECT_TRUE(std::isnan(filter.push(nan)));
  EXPECT_NEAR(filter.push(1e-3), 0.0, 1e-12);
  for (int i = 0; i < 200; ++i) filter.push(nan);
  EXPECT_EQ(filter.push(7e-3), 0.0);
}

TEST(CausalContact, FlightsStayInAndLiftsTakeAMarginWithThem) {
  CausalContact contact({});
  const auto ms = [](double t) { return std::llround(t * 1e6); };
  for (int t = 0; t < 1000; ++t) {
    const bool flight = t >= 300 && t < 310, lift = t >= 500 && t < 600;
    contact.push(ms(t), t < 100 || flight || lift ? 0.0 : 1.0);
  }
  EXPECT_FALSE(contact.touching_at(ms(50)));
  EXPECT_FALSE(contact.touching_at(ms(110))) << "the margin after the first touch";
  EXPECT_TRUE(contact.touching_at(ms(130)));
  EXPECT_TRUE(contact.touching_at(ms(305))) << "a flight";
  EXPECT_TRUE(contact.touching_at(ms(470)));
  EXPECT_FALSE(contact.touching_at(ms(490))) << "the margin before a lift";
  EXPECT_FALSE(contact.touching_at(ms(550)));
  EXPECT_TRUE(contact.touching_at(ms(630)));
  EXPECT_TRUE(CausalContact({}).touching_at(0)) << "no force sensor";
  ContactConfig wrong;
  wrong.release_N = 1.0;
  EXPECT_THROW(CausalContact{wrong}, Error);
}

}  // namespace
}  // namespace asperity
