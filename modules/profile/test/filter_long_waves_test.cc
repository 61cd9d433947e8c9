// λc and λf against the Gaussian's transfer function: of a wave of length λ the mean line keeps 2^−(λc/λ)².
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "asperity/profile/filter_profile.h"

namespace asperity {
namespace {

TEST(FilterProfile, WavinessIsTheBandBetweenBothCutOffs) {
  constexpr double kStep_m = 10e-6, kHeight_m = 3e-6;
  constexpr std::size_t kCount = 12000, kEnd = 2000;  // 20 mm at either end, where the weights are cut
  RoughnessConfig config;
  config.lambda_c_mm = 0.8;
  config.lambda_f_mm = 8.0;
  for (const double wave_mm : {0.4, 0.8, 2.0, 4.0, 8.0, 20.0}) {
    std::vector<double> z(kCount);
    const double k = 2.0 * std::numbers::pi / (1e-3 * wave_mm);
    for (std::size_t i = 0; i < kCount; ++i) z[i] = kHeight_m * std::cos(k * kStep_m * static_cast<double>(i));
    const std::vector<double> w = filter_profile(z, kStep_m, config).waviness_m;
    ASSERT_EQ(w.size(), kCount);
    const double below = std::exp2(-std::pow(config.lambda_c_mm / wave_mm, 2)),
                 above = 1.0 - std::exp2(-std::pow(config.lambda_f_mm / wave_mm, 2));
    // Differences, as W has mean zero over a length that is no whole number of waves.
    for (std::size_t i = kEnd; i + 137 < kCount - kEnd; i += 61) {
      EXPECT_NEAR(w[i] - w[i + 137], below * above * (z[i] - z[i + 137]), 1e-5 * kHeight_m)
          << wave_mm << " mm, " << i;  // the weights are cut at 7e-7 of their peak
    }
  }
}

}  // namespace
}  // namespace asperity
