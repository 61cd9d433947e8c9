#include "asperity/signal/spectrum.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/base/random.h"

namespace asperity {
namespace {

constexpr double kPi = std::numbers::pi;

std::vector<double> noise(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  std::vector<double> x(n);
  for (double& v : x) v = random.normal();
  return x;
}

// Against the sum itself, for even, odd and prime lengths on both sides of the chirp's threshold.
TEST(Spectrum, TransformIsTheSum) {
  for (const std::size_t n : {1u, 2u, 3u, 4u, 12u, 45u, 61u, 67u, 202u, 1009u}) {
    const auto x = noise(n, n);
    const auto half = real_dft(x);
    ASSERT_EQ(half.size(), n / 2 + 1);
    for (std::size_t k = 0; k < half.size(); ++k) {
      std::complex<double> sum = 0.0;
      for (std::size_t m = 0; m < n; ++m) {
        sum += x[m] * std::polar(1.0, -2.0 * kPi * static_cast<double>((k * m) % n) / static_cast<double>(n));
      }
      EXPECT_NEAR(std::abs(half[k] - sum), 0.0, 1e-11) << n << " " << k;
    }
    const auto back = inverse_real_dft(half, n);
    for (std::size_t m = 0; m < n; ++m) EXPECT_NEAR(back[m], x[m], 1e-12);
  }
  EXPECT_TRUE(real_dft({}).empty());
  EXPECT_THROW(inverse_real_dft(real_dft(noise(8, 1)), 7 + 4), Error);
}

// White noise of variance 1 at rate r has the one-sided density 2/r.
TEST(Spectrum, WelchOfWhiteNoiseIsFlat) {
  const double rate = 40.0;
  const auto spectrum = welch(noise(200000, 5), rate, 256);
  double variance = 0.0;
  for (std::size_t k = 0; k < spectrum.density.size(); ++k) {
    variance += spectrum.density[k] * (spectrum.frequency[1] - spectrum.frequency[0]);
    if (k <= 2 || k >= 126) continue;
    EXPECT_NEAR(spectrum.density[k] * rate / 2.0, 1.0, 0.2);  // 1561 segments: 5 sigma is 0.13
  }
  EXPECT_NEAR(variance, 1.0, 0.02);
  EXPECT_EQ(spectrum.frequency.back(), rate / 2.0);
}

TEST(Spectrum, WelchPutsASineWhereItIs) {
  std::vector<double> x(8192);
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] = 7.0 + 3.0 * std::sin(2.0 * kPi * 0.4 * static_cast<double>(i) / 40.0);
  const auto spectrum = welch(x, 40.0, 1000);
  std::size_t peak = 0;
  double power = 0.0;
  for (std::size_t k = 0; k < spectrum.density.size(); ++k) {
    if (spectrum.density[k] > spectrum.density[peak]) peak = k;
    power += spectrum.density[k] * 0.04;
  }
  EXPECT_NEAR(spectrum.frequency[peak], 0.4, 1e-12);
  EXPECT_NEAR(power, 4.5, 1e-9);  // A²/2
}

TEST(Spectrum, WelchRejectsTooLittle) {
  EXPECT_THROW(welch(noise(3, 1), 1.0, 8), Error);
  EXPECT_THROW(welch(noise(30, 1), 0.0, 8), Error);
}

}  // namespace
}  // namespace asperity
