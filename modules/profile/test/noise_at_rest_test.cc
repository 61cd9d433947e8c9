#include "asperity/profile/noise_at_rest.h"

#include <gtest/gtest.h>
#include <cmath>
#include <numbers>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/random.h"

namespace asperity {
namespace {

constexpr double kRate_Hz = 400.0;
constexpr double kWhite_m2ps3 = 2e-7;

struct Rest {
  std::vector<double> t_s, force_N;
  std::vector<char> resting;
  std::vector<AccelerationAtRest> directions;
};

// Waves of random amplitudes and phases whose density is A (1 + f₁/f): with so many over a longer time than the rest
// lasts it is a Gaussian process of that spectrum.
std::vector<double> flicker(std::size_t count, double corner_Hz, Random& random) {
  const double step_Hz = 0.4 * kRate_Hz / static_cast<double>(count);
  std::vector<double> out(count, 0.0);
  for (double f = step_Hz; f < 25.0; f += step_Hz) {
    const double size = std::sqrt(kWhite_m2ps3 * (1.0 + corner_Hz / f) * step_Hz);
    const double a = size * random.normal(), b = size * random.normal();
    for (std::size_t i = 0; i < count; ++i) {
      const double angle = 2.0 * std::numbers::pi * f * static_cast<double>(i) / kRate_Hz;
      out[i] += a * std::cos(angle) + b * std::sin(angle);
    }
  }
  return out;
}

Rest rest_with(double corner_Hz, double duration_s, Random& random) {
  Rest out;
  const auto n = static_cast<std::size_t>(duration_s * kRate_Hz);
  for (std::size_t i = 0; i < n; ++i) out.t_s.push_back(static_cast<double>(i) / kRate_Hz);
  out.resting.assign(n, 1);
  HeightErrors errors;
  errors.tracker_psd_m2ps = 1e-9;
  for (int axis = 0; axis < 3; ++axis) out.directions.push_back({flicker(n, corner_Hz, random), errors});
  return out;
}

NoiseAtRest found(const Rest& rest) {
  return noise_at_rest(rest.t_s, rest.force_N, rest.resting, rest.directions, kWhite_m2ps3);
}

// A corner drawn from what is said of corners: over many draws the mean of what is expected is that of the corners,
// and the square of the error is the stated variance. Of the prior's own variance, 3 Hz², most must be gone.
TEST(NoiseAtRest, IsRightOverDrawsOfTheCorner) {
  Random random(5);
  constexpr int kDraws = 120;
  double bias = 0.0, square = 0.0, stated = 0.0, alone = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    const double z = std::clamp(random.normal(), -2.5, 2.5);
    const double corner_Hz = 0.5 * std::exp(std::log(10.0) / 1.96 * z);
    const NoiseAtRest noise = found(rest_with(corner_Hz, 3.0, random));
    EXPECT_NEAR(noise.rests_s, 2.7, 0.02);
    bias += (noise.corner_Hz - corner_Hz) / kDraws;
    square += std::pow(noise.corner_Hz - corner_Hz, 2) / kDraws;
    stated += std::pow(noise.corner_sigma_Hz, 2) / kDraws;
    alone += std::pow(1.0 - corner_Hz, 2) / kDraws;
  }
  std::printf("bias %.3f Hz, error %.3f Hz, stated %.3f Hz, without data %.3f Hz\n", bias, std::sqrt(square),
              std::sqrt(stated), std::sqrt(alone));
  EXPECT_LT(std::abs(bias), 3.0 * std::sqrt(stated / kDraws));
  EXPECT_GT(square, 0.4 * stated);
  EXPECT_LT(square, 1.6 * stated);
  EXPECT_LT(square, 0.5 * alone);
}

// 30 times the noise's power at 8 to 12 Hz, and a force that presses the tip in by 20 µm, slowly.
TEST(NoiseAtRest, TakesNeitherTremorNorPressingForNoise) {
  Random random(9);
  Rest rest = rest_with(0.5, 4.0, random);
  const double without_Hz = found(rest).corner_Hz;
  rest.force_N.assign(rest.t_s.size(), 0.0);
  for (std::size_t i = 0; i < rest.t_s.size(); ++i) {
    for (const double f : {0.6, 0.9, 1.3, 1.9}) {
      const double omega = 2.0 * std::numbers::pi * f, wave = 0.02 * std::sin(omega * rest.t_s[i] + f);
      rest.force_N[i] += wave;
      rest.directions[0].accel_mps2[i] += 1e-3 * omega * omega * wave;  // 1 mm/N: h = −c F
    }
    for (AccelerationAtRest& direction : rest.directions) {
      for (const double f : {8.3, 9.1, 10.4, 11.7})
        direction.accel_mps2[i] += 3.5e-3 * std::sin(2.0 * std::numbers::pi * f * rest.t_s[i] + 3.0 * f);
    }
  }
  EXPECT_NEAR(found(rest).corner_Hz, without_Hz, 0.5 * without_Hz);
  rest.force_N.clear();  // not told of the force
  EXPECT_GT(found(rest).corner_Hz, 2.0 * without_Hz);
}

TEST(NoiseAtRest, IsTheAssumedOneWithoutARest) {
  Random random(3);
  Rest rest = rest_with(5.0, 0.9, random);
  EXPECT_EQ(found(rest).rests_s, 0.0);
  EXPECT_EQ(found(rest).corner_Hz, 1.0);
  rest = rest_with(5.0, 3.0, random);
  rest.resting.assign(rest.t_s.size(), 0);
  EXPECT_EQ(found(rest).rests_s, 0.0);
  rest.resting.pop_back();
  EXPECT_THROW(found(rest), Error);
}

}  // namespace
}  // namespace asperity
