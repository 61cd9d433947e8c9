#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/texture/evaluate_fourier1d.h"
#include "asperity/texture/fit_fourier1d.h"

namespace asperity {
namespace {

using std::numbers::pi;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kSpacing_m = 0.025e-3;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

template <class Height>
std::vector<double> sampled(std::size_t count, const Height& height_m) {
  std::vector<double> z;
  for (std::size_t i = 0; i < count; ++i) z.push_back(height_m(static_cast<double>(i) * kSpacing_m));
  return z;
}

Fourier1d random_texture(std::size_t coefficients, std::uint64_t seed) {
  Random random(seed);
  Fourier1d f{10.0, {}, {}, 1e-4};
  for (std::size_t j = 1; j <= coefficients; ++j) {
    f.a_m.push_back(1e-5 * random.normal() / static_cast<double>(j));
    f.b_m.push_back(1e-5 * random.normal() / static_cast<double>(j));
  }
  return f;
}

class EvaluateFourier1d : public testing::TestWithParam<std::size_t> {};

TEST_P(EvaluateFourier1d, IsTheSumOfTheSeed) {
  const Fourier1d f = random_texture(GetParam(), 1);
  for (const double x_m : {0.0, 1.234e-3, -4.2e-3, 9.999e-3, 0.31234}) {
    long double height = f.mean_m;
    long double slope = 0.0L;
    const long double omega = 2.0L * std::numbers::pi_v<long double> / 10e-3L;
    for (std::size_t j = 1; j <= f.a_m.size(); ++j) {
      const long double phase = static_cast<long double>(j) * omega * static_cast<long double>(x_m);
      height += f.a_m[j - 1] * std::cos(phase) + f.b_m[j - 1] * std::sin(phase);
      slope += static_cast<long double>(j) * omega * (f.b_m[j - 1] * std::cos(phase) - f.a_m[j - 1] * std::sin(phase));
    }
    const HeightAndSlope got = evaluate_height(f, x_m);
    EXPECT_NEAR(got.height_m, static_cast<double>(height), 1e-16) << x_m;
    EXPECT_NEAR(got.slope, static_cast<double>(slope), 1e-11) << x_m;
  }
}

INSTANTIATE_TEST_SUITE_P(Counts, EvaluateFourier1d, testing::Values(1, 2, 3, 4, 7, 128));

TEST(EvaluateFourier1dAt, NotANumberStaysOne) {
  const Fourier1d f = random_texture(4, 1);
  EXPECT_TRUE(std::isnan(evaluate_height(f, kNan).height_m));
  EXPECT_TRUE(std::isnan(evaluate_height(f, std::numeric_limits<double>::infinity()).height_m));
}

TEST(LowestHeight, IsBelowEveryPointAndReached) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Fourier1d f = random_texture(1 + 7 * seed, seed);
    const double lowest = lowest_height_m(f);
    double brute = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 10000; ++i) brute = std::min(brute, evaluate_height(f, 1e-6 * i).height_m);
    EXPECT_LE(lowest, brute + 1e-17);
    // A grid step of 1 µm misses the valley by at most |g''| step² / 8, 4 nm for these spectra.
    EXPECT_GE(lowest, brute - 4e-9);
    EXPECT_NEAR(height_offset_m(f), -lowest, 0.0);
  }
  EXPECT_NEAR(lowest_height_m({10.0, {3e-6}, {4e-6}, 1e-6}), -4e-6, 1e-18);
}

TEST(FitFourier1d, FindsTheCoefficientsOfASeries) {
  const Fourier1d truth = random_texture(128, 3);
  const auto z = sampled(400, [&](double x) { return evaluate_height(truth, x).height_m; });
  const FourierFit fit = fit_fourier1d(z, kSpacing_m, {.seam_mm = 0.0});
  EXPECT_EQ(fit.samples, 400u);
  EXPECT_EQ(fit.texture.length_mm, 10.0);
  EXPECT_NEAR(fit.texture.omega_rad_per_mm(), 0.6283185307179586, 1e-15);
  EXPECT_NEAR(fit.texture.mean_m, truth.mean_m, 1e-17);
  for (std::size_t j = 0; j < 128; ++j) {
    EXPECT_NEAR(fit.texture.a_m[j], truth.a_m[j], 1e-17) << j;
    EXPECT_NEAR(fit.texture.b_m[j], truth.b_m[j], 1e-17) << j;
  }
  EXPECT_LT(fit.rms_error_m, 1e-16);
}

TEST(FitFourier1d, FollowsTheErratumsTransform) {
  Random random(9);
  const auto z = sampled(400, [&](double) { return 1e-6 * random.normal(); });
  const FourierFit fit = fit_fourier1d(z, kSpacing_m, {.seam_mm = 0.0});
  for (const std::size_t j : {1u, 7u, 128u}) {
    std::complex<double> sum = 0.0;
    for (std::size_t n = 0; n < 400; ++n)
      sum += z[n] * std::exp(std::complex<double>(0.0, -2 * pi * static_cast<double>(j * n) / 400));
    EXPECT_NEAR(fit.texture.a_m[j - 1], 2.0 / 400 * sum.real(), 1e-18);
    EXPECT_NEAR(fit.texture.b_m[j - 1], -2.0 / 400 * sum.imag(), 1e-18);
  }
  // Parseval: what the 128 harmonics do not hold is the error.
  double power = 0.0;
  for (std::size_t j = 0; j < 128; ++j)
    power += 0.5 * (fit.texture.a_m[j] * fit.texture.a_m[j] + fit.texture.b_m[j] * fit.texture.b_m[j]);
  EXPECT_NEAR(fit.rms_error_m, std::sqrt(fit.rms_height_m * fit.rms_height_m - power), 1e-12);
}

// Holes of 1.5 mm depth every 2.5 mm with walls of finite slope, as a dilated tip feels them.
double protoboard_m(double x_m) {
  const double phase = x_m / 2.5e-3 - std::floor(x_m / 2.5e-3);
  return -1.5e-3 / (1.0 + std::exp((std::abs(phase - 0.5) - 0.2) / 0.02));
}

TEST(FitFourier1d, ReproducesAPeriodicSurfaceBeyondItsWindow) {
  const auto z = sampled(2000, [](double x) { return protoboard_m(x + 0.3e-3); });
  const FourierFit fit = fit_fourier1d(z, kSpacing_m);
  double square = 0.0;
  for (std::size_t i = 0; i < z.size(); ++i) {
    const double x_m = (static_cast<double>(i) - static_cast<double>(fit.first_sample)) * kSpacing_m;
    square += std::pow(evaluate_height(fit.texture, x_m).height_m - z[i], 2);
  }
  // Four whole pitches in 10 mm: only what lies above 12.8 cycles/mm is lost.
  EXPECT_LT(std::sqrt(square / static_cast<double>(z.size())), 2e-6);
  EXPECT_LT(fit.rms_error_m, 2e-6);
  EXPECT_NEAR(fit.height_offset_m, 1.5e-3, 0.01e-3);
  for (int i = 0; i < 1000; ++i)
    EXPECT_GE(evaluate_height(fit.texture, 1e-5 * i).height_m + fit.height_offset_m, -1e-15);
}

TEST(FitFourier1d, ClosesTheSeam) {
  // A pitch that does not divide 10 mm, and no continuation to blend with in the first case.
  const auto wave = [](double x) { return 0.2e-3 * std::sin(2 * pi * x / 2.3e-3); };
  for (const std::size_t count : {400u, 402u, 460u, 4000u}) {
    const auto z = sampled(count, wave);
    const FourierFit closed = fit_fourier1d(z, kSpacing_m, {.coefficients = 60});
    const FourierFit open = fit_fourier1d(z, kSpacing_m, {.coefficients = 60, .seam_mm = 0.0});
    const auto ringing_m = [&](const FourierFit& fit) {
      // Away from the seam the closed texture follows its source; the open one rings more.
      double worst = 0.0;
      for (std::size_t i = 40; i + 40 < 400; ++i) {
        const double difference =
            evaluate_height(fit.texture, static_cast<double>(i) * kSpacing_m).height_m - z[fit.first_sample + i];
        worst = std::max(worst, std::abs(difference));
      }
      return worst;
    };
    EXPECT_LT(ringing_m(closed), 0.5e-6) << count;
    EXPECT_GT(ringing_m(open), ringing_m(closed)) << count;
  }
}

TEST(FitFourier1d, AvoidsGapsAndBridgesShortOnes) {
  auto z = sampled(1000, [](double x) { return 1e-4 * std::sin(2 * pi * x / 2.5e-3); });
  for (std::size_t i = 380; i < 420; ++i) z[i] = kNan;
  z[700] = z[701] = kNan;
  FourierFit fit = fit_fourier1d(z, kSpacing_m);
  EXPECT_GE(fit.first_sample, 420u);
  EXPECT_EQ(fit.bridged, 2u);
  EXPECT_TRUE(fit.problems.empty());
  // A straight line over three steps of 25 µm misses a wave of 2.5 mm by at most 3 % of 1e-4 m.
  EXPECT_LT(fit.rms_error_m, 0.5e-6);

  fit = fit_fourier1d(z, kSpacing_m, {.max_gap_mm = 0.0});
  ASSERT_EQ(fit.problems.size(), 1u);
  EXPECT_EQ(fit.problems[0].kind, "short_texture");
  EXPECT_EQ(fit.first_sample, 0u);
  EXPECT_EQ(fit.samples, 380u);
  EXPECT_NEAR(fit.texture.length_mm, 9.5, 1e-12);
  EXPECT_EQ(fit.texture.a_m.size(), 128u);
}

TEST(FitFourier1d, SameInputGivesTheSameBits) {
  Random random(4);
  const auto z = sampled(3000, [&](double) { return 1e-6 * random.normal(); });
  const FourierFit a = fit_fourier1d(z, kSpacing_m);
  const FourierFit b = fit_fourier1d(z, kSpacing_m);
  EXPECT_EQ(a.first_sample, b.first_sample);
  EXPECT_EQ(a.texture.a_m, b.texture.a_m);
  EXPECT_EQ(a.height_offset_m, b.height_offset_m);
}

TEST(FitFourier1d, RefusesWhatCannotBeATexture) {
  auto z = sampled(1000, [](double x) { return x; });
  EXPECT_THAT([&] { fit_fourier1d(z, 0.0); }, ThrowsMessage<Error>(HasSubstr("spacing 0 m")));
  EXPECT_THAT(
      [&] { fit_fourier1d(z, 0.05e-3); },
      ThrowsMessage<Error>(HasSubstr("128 coefficients need more than 256 samples; a length of 10 mm has 200")));
  z[3] = std::numeric_limits<double>::infinity();
  EXPECT_THAT([&] { fit_fourier1d(z, kSpacing_m); }, ThrowsMessage<Error>(HasSubstr("height 4 is infinite")));
  for (std::size_t i = 0; i < z.size(); ++i) {
    if (i % 90 < 30) z[i] = kNan;
  }
  EXPECT_THAT([&] { fit_fourier1d(z, kSpacing_m); },
              ThrowsMessage<Error>(HasSubstr("longest gap-free stretch is 1.5 mm; at least 2.5 mm")));
}

}  // namespace
}  // namespace asperity
