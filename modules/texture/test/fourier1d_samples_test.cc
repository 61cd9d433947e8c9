#include "asperity/texture/fit_fourier1d_samples.h"

#include <cmath>
#include <complex>
#include <filesystem>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/signal/zero_phase.h"
#include "asperity/texture/evaluate_fourier1d.h"
#include "asperity/texture/fit_fourier1d.h"

namespace asperity {
namespace {

using std::numbers::pi;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Fourier1d random_series(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  Fourier1d f{10.0, {}, {}, 3e-6};
  for (std::size_t j = 0; j < count; ++j) {
    f.a_m.push_back(1e-6 * random.normal());
    f.b_m.push_back(1e-6 * random.normal());
  }
  return f;
}

TEST(EvaluateFourier1dLong, IsTheSumForThousandsOfHarmonics) {
  const Fourier1d f = random_series(4096, 5);
  double amplitude_m = 0.0;
  for (std::size_t j = 0; j < f.a_m.size(); ++j) amplitude_m += std::hypot(f.a_m[j], f.b_m[j]);
  Random random(6);
  for (int i = 0; i < 50; ++i) {
    const double x_m = random.uniform(-0.1, 0.1);
    long double height = f.mean_m;
    long double slope = 0.0L;
    for (std::size_t j = 1; j <= f.a_m.size(); ++j) {
      const long double omega = 2.0L * std::numbers::pi_v<long double> * static_cast<long double>(j) / 0.01L;
      const long double phase = omega * static_cast<long double>(x_m);
      height += f.a_m[j - 1] * std::cos(phase) + f.b_m[j - 1] * std::sin(phase);
      slope += omega * (f.b_m[j - 1] * std::cos(phase) - f.a_m[j - 1] * std::sin(phase));
    }
    const HeightAndSlope got = evaluate_height(f, x_m);
    EXPECT_NEAR(got.height_m, static_cast<double>(height), 1e-12 * amplitude_m);
    EXPECT_NEAR(got.slope, static_cast<double>(slope), 1e-12 * amplitude_m * 4096 * 2 * pi / 0.01);
  }
}

TEST(FitFourier1dSamples, IsTheDftOfEvenSamples) {
  Random random(2);
  constexpr std::size_t kCount = 600;
  std::vector<double> x_m, z_m;
  for (std::size_t i = 0; i < kCount; ++i) {
    x_m.push_back(10e-3 * static_cast<double>(i) / kCount);
    z_m.push_back(1e-6 * random.normal());
  }
  const FourierSamplesFit fit = fit_fourier1d_samples(x_m, z_m, 10e-3, {.coefficients = 128, .ridge = 0.0});
  for (const std::size_t j : {1u, 17u, 128u}) {
    std::complex<double> dft = 0.0;
    for (std::size_t n = 0; n < kCount; ++n)
      dft += z_m[n] * std::polar(1.0, -2 * pi * static_cast<double>(j * n % kCount) / kCount);
    EXPECT_NEAR(fit.texture.a_m[j - 1], 2.0 / kCount * dft.real(), 1e-17);
    EXPECT_NEAR(fit.texture.b_m[j - 1], -2.0 / kCount * dft.imag(), 1e-17);
  }
  EXPECT_LE(fit.iterations, 3);
}

TEST(FitFourier1dSamples, FindsASeriesFromUnevenSamplesWithAGap) {
  const Fourier1d truth = random_series(40, 7);
  Random random(8);
  std::vector<double> x_m, z_m;
  while (x_m.size() < 700) {
    const double x = random.uniform(-5e-3, 5e-3);
    // A gap of 0.1 mm, less than the finest wave's 0.25 mm, and positions in no order.
    if (x > 1e-3 && x < 1.1e-3) continue;
    x_m.push_back(x);
    z_m.push_back(evaluate_height(truth, x).height_m);
  }
  z_m[5] = kNan;
  const FourierSamplesFit fit = fit_fourier1d_samples(x_m, z_m, 10e-3, {.coefficients = 40, .ridge = 0.0});
  EXPECT_LT(fit.relative_residual, 1e-11);
  EXPECT_NEAR(fit.texture.mean_m, truth.mean_m, 1e-13);
  for (std::size_t j = 0; j < 40; ++j) {
    EXPECT_NEAR(fit.texture.a_m[j], truth.a_m[j], 1e-12) << j;
    EXPECT_NEAR(fit.texture.b_m[j], truth.b_m[j], 1e-12) << j;
  }
}

TEST(FitFourier1dSamples, RefusesTooFewAndInfinite) {
  const std::vector<double> x{0.0, 1e-3, 2e-3};
  EXPECT_THAT([&] { fit_fourier1d_samples(x, x, 10e-3, {.coefficients = 2}); },
              ThrowsMessage<Error>(HasSubstr("2 coefficients need more than 4 heights; there are 3")));
  const std::vector<double> bad{0.0, std::numeric_limits<double>::infinity(), 0.0};
  EXPECT_THAT([&] { fit_fourier1d_samples(x, bad, 10e-3, {.coefficients = 1}); },
              ThrowsMessage<Error>(HasSubstr("height 2, inf m")));
  EXPECT_THAT([&] { fit_fourier1d_samples(x, {}, 10e-3); }, ThrowsMessage<Error>(HasSubstr("3 positions for 0")));
}

TEST(FitFourier1dPath, HoldsAWholePathWithGaps) {
  Random random(3);
  std::vector<double> z_m;
  for (int i = 0; i < 2000; ++i) {
    const double x_mm = 0.025 * i;
    z_m.push_back(20e-6 * std::sin(2 * pi * x_mm / 2.3) + 10e-6 * std::sin(2 * pi * x_mm / 0.71 + 1) +
                  0.2e-6 * random.normal());
  }
  const std::vector<double> whole = z_m;
  for (int i = 900; i < 940; ++i) z_m[static_cast<std::size_t>(i)] = kNan;
  const FourierPathFit path = fit_fourier1d_path(z_m, 0.025e-3);
  EXPECT_TRUE(path.problems.empty());
  EXPECT_EQ(path.fit.texture.a_m.size(), 672u);  // 12.8 a millimetre of 50 mm and 2.5 mm of seam
  EXPECT_LT(path.fit.rms_error_m, 0.02 * path.fit.rms_height_m);
  // In the gap of 1 mm and in the seam the series stays within twice the profile's own range.
  for (double x_mm = 0.0; x_mm < 52.5; x_mm += 0.01)
    EXPECT_LT(std::abs(evaluate_height(path.fit.texture, 1e-3 * x_mm).height_m), 60e-6) << x_mm;
  EXPECT_EQ(fit_fourier1d_path(z_m, 0.025e-3, {.most_coefficients = 100}).problems.at(0).kind, "coarse_texture");
}

// A turned surface measured every 0.5 µm over 4 mm; the files and their licence are in modules/profile/test/data.
std::vector<double> measured_m(const char* name) {
  const auto file = std::filesystem::path(ASPERITY_TEST_DATA).parent_path().parent_path().parent_path() / "profile" /
                    "test" / "data" / "profiles_mts" / name;
  const std::string text = read_file(file, 1 << 20);
  CsvReader csv(text, file.string());
  csv.accept_unterminated();
  std::vector<double> z_m;
  while (csv.next()) z_m.push_back(1e-6 * csv.number(0));
  return z_m;
}

TEST(FitFourier1dMeasured, ReproducesBandLimitedProfilesOutsideTheSeam) {
  for (const char* name : {"Bu_1_56_ak.csv", "Luftpresser_1_56_ak.csv"}) {
    constexpr double kSpacing_m = 0.5e-6;
    // 128 harmonics of 3 mm reach 42.7 cycles/mm.
    const auto z_m = zero_phase_lowpass(measured_m(name), 25.0, 1e-3 / kSpacing_m, 4);
    FitFourier1dConfig config;
    config.length_mm = 3.0;
    config.seam_mm = 0.25;
    const FourierFit fit = fit_fourier1d(z_m, kSpacing_m, config);
    double mean_m = 0.0;
    for (std::size_t i = 0; i < fit.samples; ++i)
      mean_m += z_m[fit.first_sample + i] / static_cast<double>(fit.samples);
    const auto seam = static_cast<std::size_t>(std::lround(config.seam_mm * 1e-3 / kSpacing_m));
    double error = 0.0;
    double height = 0.0;
    for (std::size_t i = seam; i < fit.samples - seam; ++i) {
      const double z = z_m[fit.first_sample + i];
      error += std::pow(evaluate_height(fit.texture, kSpacing_m * static_cast<double>(i)).height_m - z, 2);
      height += std::pow(z - mean_m, 2);
    }
    EXPECT_LT(std::sqrt(error / height), 0.02) << name;
  }
}

}  // namespace
}  // namespace asperity
