#include <cmath>
#include <numbers>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "asperity/base/random.h"
#include "asperity/profile/estimate_texture_noise.h"
#include "asperity/profile/measure_profile_texture.h"
#include "gaussian_filter.h"
#include "robust_gaussian_filter.h"

namespace asperity {
namespace {

using std::numbers::pi;

template <class Height>
std::vector<double> sampled(std::size_t count, double spacing_m, const Height& height_m) {
  std::vector<double> z;
  for (std::size_t i = 0; i < count; ++i) z.push_back(height_m((static_cast<double>(i) + 0.5) * spacing_m));
  return z;
}

// 20 periods of 1000 samples: sums equal integrals to about 1e-5.
constexpr double kPitch_m = 0.1e-3, kSpacing_m = kPitch_m / 1000, kA_m = 3e-6;
constexpr std::size_t kCount = 20000;

TEST(ProfileParameters, OfASine) {
  const auto z = sampled(kCount, kSpacing_m, [](double x) { return kA_m * std::sin(2 * pi * x / kPitch_m); });
  const ProfileParametersResult r = measure_profile_parameters(z, kSpacing_m, 5);
  const double near_m = 2e-5 * kA_m;
  EXPECT_NEAR(r.p_m, kA_m, near_m);
  EXPECT_NEAR(r.v_m, kA_m, near_m);
  EXPECT_NEAR(r.z_m, 2 * kA_m, near_m);
  EXPECT_NEAR(r.zx_m, 2 * kA_m, near_m);
  EXPECT_NEAR(r.t_m, 2 * kA_m, near_m);
  EXPECT_NEAR(r.c_m, 2 * kA_m, near_m);
  EXPECT_NEAR(r.cx_m, 2 * kA_m, near_m);
  EXPECT_NEAR(r.a_m, 2 * kA_m / pi, near_m);
  EXPECT_NEAR(r.q_m, kA_m / std::numbers::sqrt2, near_m);
  EXPECT_NEAR(r.ku, 1.5, 1e-6);
  EXPECT_NEAR(r.sm_m, kPitch_m, 1e-6 * kPitch_m);
  EXPECT_NEAR(r.pc_per_m, 1.0 / kPitch_m, 1e-6 / kPitch_m);
  EXPECT_NEAR(r.cq_m, 0.0, 1e-3 * kA_m);
  EXPECT_NEAR(r.smx_m, kPitch_m, 1e-6 * kPitch_m);
  EXPECT_NEAR(r.smq_m, 0.0, 1e-4 * kPitch_m);
  EXPECT_NEAR(r.sw_m, kPitch_m, 1e-3 * kPitch_m);
  // 20 peaks and 20 pits: the rise from and to the mean line, A, is above 5 % of 2A.
  EXPECT_NEAR(r.pd_per_m, 1.0 / kPitch_m, 1e-9 / kPitch_m);
  EXPECT_NEAR(r.vd_per_m, 1.0 / kPitch_m, 1e-9 / kPitch_m);
  const double curvature = kA_m * std::pow(2 * pi / kPitch_m, 2);
  EXPECT_NEAR(r.mpc_per_m, curvature, 1e-4 * curvature);
  EXPECT_NEAR(r.mvc_per_m, curvature, 1e-4 * curvature);
  EXPECT_NEAR(r.five_p_m, kA_m, near_m);
  EXPECT_NEAR(r.five_v_m, kA_m, near_m);
  EXPECT_NEAR(r.ten_z_m, 2 * kA_m, near_m);
  EXPECT_TRUE(std::isnan(r.mq)) << "a sine is not of two processes";
  // Slope (2π A/λ) cos: root mean square over √2, mean of absolutes 2/π of it.
  const double slope = 2 * pi * kA_m / kPitch_m;
  EXPECT_NEAR(r.dq, slope / std::numbers::sqrt2, 1e-5 * slope);
  EXPECT_NEAR(r.da, slope * 2 / pi, 1e-5 * slope);
  EXPECT_NEAR(r.dt, slope, 1e-5 * slope);
  // Developed length: ∫ √(1 + s² cos²) by Simpson's rule over a quarter period.
  double longer = 0.0;
  constexpr int kSteps = 2000;
  for (int i = 0; i <= kSteps; ++i) {
    const double s = slope * std::cos(0.5 * pi * i / kSteps);
    longer += (i == 0 || i == kSteps ? 1 : i % 2 ? 4 : 2) * (std::sqrt(1 + s * s) - 1) / (3.0 * kSteps);
  }
  EXPECT_NEAR(r.dr, longer, 1e-5 * longer);
  EXPECT_NEAR(r.dl_m, (1 + longer) * 20 * kPitch_m, 1e-5 * longer * 20 * kPitch_m);
  // The mean of sin a sin(a + φ) over the pairs of 20 periods, times 2: cos φ and, as the last pairs end within a
  // period, sin φ / (40 π − φ) more. Where it is 0.2, by bisection.
  double low = 0.0, high = 0.5 * pi;
  for (int i = 0; i < 60; ++i) {
    const double phi = 0.5 * (low + high);
    (std::cos(phi) + std::sin(phi) / (40 * pi - phi) > 0.2 ? low : high) = phi;
  }
  EXPECT_NEAR(r.al_m, kPitch_m * low / (2 * pi), 1e-4 * kPitch_m);
  // Material curve A cos(π q): half above the mean line; volumes by its integral A sin(π q)/π.
  EXPECT_NEAR(r.mr, 0.5, 1e-3);
  EXPECT_NEAR(r.dc_m, 2 * kA_m * std::cos(0.1 * pi), 1e-3 * kA_m);
  const auto volume = [](double q) { return kA_m * (std::sin(pi * q) / pi - q * std::cos(pi * q)); };
  EXPECT_NEAR(r.vmp_m, volume(0.1), 1e-3 * kA_m);
  EXPECT_NEAR(r.vmc_m, volume(0.8) - volume(0.1), 1e-3 * kA_m);
  EXPECT_NEAR(r.vvv_m, volume(0.2), 1e-3 * kA_m);  // symmetric: void below 80 % is material above 20 %
  EXPECT_NEAR(r.vvc_m, volume(0.9) - volume(0.2), 1e-3 * kA_m);
}

// A triangle's material curve is a straight line: the core is all of it.
TEST(ProfileParameters, OfATriangle) {
  const auto z = sampled(kCount, kSpacing_m, [](double x) {
    const double phase = x / kPitch_m - std::floor(x / kPitch_m);
    return kA_m * (4 * std::abs(phase - 0.5) - 1);
  });
  const ProfileParametersResult r = measure_profile_parameters(z, kSpacing_m, 5);
  EXPECT_NEAR(r.a_m, kA_m / 2, 1e-5 * kA_m);
  EXPECT_NEAR(r.q_m, kA_m / std::numbers::sqrt3, 1e-5 * kA_m);
  EXPECT_NEAR(r.ku, 1.8, 1e-4);
  EXPECT_NEAR(r.k_m, 2 * kA_m, 2e-3 * kA_m);
  EXPECT_NEAR(r.pk_m, 0.0, 2e-3 * kA_m);
  EXPECT_NEAR(r.vk_m, 0.0, 2e-3 * kA_m);
  EXPECT_NEAR(r.mrk1, 0.0, 2e-3);
  EXPECT_NEAR(r.mrk2, 1.0, 2e-3);
  EXPECT_NEAR(r.dq, 4 * kA_m / kPitch_m, 0.01 * 4 * kA_m / kPitch_m);  // but at the corners
  EXPECT_NEAR(r.dc_m, 0.8 * 2 * kA_m, 2e-3 * kA_m);
}

TEST(ProfileParameters, OfASquareWave) {
  const auto z = sampled(kCount, kSpacing_m,
                         [](double x) { return std::fmod(x, kPitch_m) < 0.25 * kPitch_m ? 1.5 * kA_m : -0.5 * kA_m; });
  const ProfileParametersResult r = measure_profile_parameters(z, kSpacing_m, 5);
  EXPECT_NEAR(r.a_m, 0.75 * kA_m, 1e-9 * kA_m);
  EXPECT_NEAR(r.q_m, std::sqrt(0.75) * kA_m, 1e-9 * kA_m);
  EXPECT_NEAR(r.p_m, 1.5 * kA_m, 1e-15);
  EXPECT_NEAR(r.v_m, 0.5 * kA_m, 1e-15);
  EXPECT_NEAR(r.c_m, 2 * kA_m, 1e-15);
  EXPECT_NEAR(r.sk, (0.25 * 3.375 - 0.75 * 0.125) / std::pow(0.75, 1.5), 1e-9);
  EXPECT_NEAR(r.mr, 0.25, 1e-12);
  EXPECT_NEAR(r.vmp_m, 0.0, 1e-15);
  EXPECT_NEAR(r.sm_m, kPitch_m, 1e-6 * kPitch_m);
}

// Of Gaussian heights the curve falls least about 50 %: the line is fitted over 30 to 70 % of Φ⁻¹(1 − q). Its slope is
// ∫ (q − ½) h dq / ∫ (q − ½)² dq = −(√(2π))⁻¹-type integrals, done here by the midpoint rule on bisected quantiles.
TEST(ProfileParameters, TheCoreOfGaussianHeights) {
  const auto quantile = [](double q) {  // height that a part q exceed
    double low = -9.0, high = 9.0;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (0.5 * std::erfc(middle / std::numbers::sqrt2) > q ? low : high) = middle;
    }
    return low;
  };
  double moment = 0.0, square = 0.0;
  constexpr int kSteps = 20000;
  for (int i = 0; i < kSteps; ++i) {
    const double q = 0.3 + 0.4 * (i + 0.5) / kSteps;
    moment += (q - 0.5) * quantile(q);
    square += (q - 0.5) * (q - 0.5);
  }
  const double k = -moment / square;
  const double ratio1 = 0.5 * std::erfc(0.5 * k / std::numbers::sqrt2);
  double area = 0.0;
  for (int i = 0; i < kSteps; ++i) area += (quantile(ratio1 * (i + 0.5) / kSteps) - 0.5 * k) * ratio1 / kSteps;
  std::vector<double> z;
  for (int i = 0; i < 40000; ++i) z.push_back(1e-6 * quantile((i + 0.5) / 40000));
  const ProfileParametersResult r = measure_profile_parameters(z, 1e-6, 1);
  EXPECT_NEAR(r.k_m, 1e-6 * k, 1e-9);
  EXPECT_NEAR(r.mrk1, ratio1, 1e-3);
  EXPECT_NEAR(r.mrk2, 1.0 - ratio1, 1e-3);
  EXPECT_NEAR(r.pk_m, 1e-6 * 2 * area / ratio1, 3e-9);
  EXPECT_NEAR(r.vk_m, 1e-6 * 2 * area / ratio1, 3e-9);
}

// Two waves one after the other, 1 : 2 in width and height: elements of λ and 2λ, of 2A and 4A.
TEST(ProfileParameters, TheScatterOfElements) {
  const auto z = sampled(30000, kSpacing_m, [](double x) {
    const double s = std::fmod(x, 3 * kPitch_m);
    return s < kPitch_m ? kA_m * std::sin(2 * pi * s / kPitch_m) : 2 * kA_m * std::sin(pi * (s - kPitch_m) / kPitch_m);
  });
  const ProfileParametersResult r = measure_profile_parameters(z, kSpacing_m, 5);
  EXPECT_NEAR(r.smx_m, 2 * kPitch_m, 1e-4 * kPitch_m);
  EXPECT_NEAR(r.cx_m, 4 * kA_m, 1e-4 * kA_m);
  // 40 hills and pits make 37 elements: 19 of a narrow pit or hill with a wide hill or pit (1.5 λ, 3A), 9 of 2λ, 9 of
  // λ.
  EXPECT_EQ(r.elements, 37u);
  EXPECT_NEAR(r.smq_m, kPitch_m * std::sqrt(18 * 0.25 / 37), 1e-3 * kPitch_m);
  EXPECT_NEAR(r.cq_m, kA_m * std::sqrt(18.0 / 37), 1e-3 * kA_m);
  EXPECT_NEAR(r.five_p_m, 2 * kA_m, 1e-5 * kA_m);
  // Half of the peaks have A (2π/λ)², half 2A (π/λ)².
  EXPECT_NEAR(r.mpc_per_m, 0.75 * kA_m * std::pow(2 * pi / kPitch_m, 2), 1e-3 * kA_m * std::pow(2 * pi / kPitch_m, 2));
}

// Heights whose curve on probability paper is two straight lines, and what is none.
TEST(ProfileParameters, TwoProcessesOnProbabilityPaper) {
  const auto quantile = [](double q) {
    double low = -9.0, high = 9.0;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (0.5 * std::erfc(-middle / std::numbers::sqrt2) < q ? low : high) = middle;
    }
    return low;
  };
  constexpr double kMeet = 0.7;  // a standard deviation: at a material ratio of 75.8 %
  const auto heights = [&](double plateau, double pits) {
    std::vector<double> z;
    for (int i = 0; i < 20000; ++i) {
      const double s = quantile((i + 0.5) / 20000);
      z.push_back(s < kMeet ? -plateau * s : -plateau * kMeet - pits * (s - kMeet));
    }
    double mean = 0.0;
    for (const double h : z) mean += h / 20000;
    for (double& h : z) h -= mean;
    return measure_profile_parameters(z, 1e-6, 1);
  };
  const ProfileParametersResult two = heights(0.2e-6, 1.5e-6);
  EXPECT_NEAR(two.pq_m, 0.2e-6, 2e-9);
  EXPECT_NEAR(two.vq_m, 1.5e-6, 1.5e-8);
  EXPECT_NEAR(two.mq, 0.5 * std::erfc(-kMeet / std::numbers::sqrt2), 4e-3);
  EXPECT_TRUE(std::isnan(heights(1e-6, 1e-6).pq_m));
  EXPECT_TRUE(std::isnan(heights(1e-6, 0.5e-6).mq));
}

TEST(ProfileParameters, MissingHeightsTakePartInNothing) {
  auto z = sampled(kCount, kSpacing_m, [](double x) { return kA_m * std::sin(2 * pi * x / kPitch_m); });
  const auto whole = measure_profile_parameters(z, kSpacing_m, 5);
  for (std::size_t i = 5000; i < 6000; ++i) z[i] = kNan;  // one period
  const auto r = measure_profile_parameters(z, kSpacing_m, 5);
  EXPECT_EQ(r.missing, 1000u);
  for (const ProfileParameter& p : kProfileParameters) {
    const double expected = whole.*p.value;
    if (std::isnan(expected)) {
      EXPECT_TRUE(std::isnan(r.*p.value)) << p.suffix;
      continue;
    }
    // Each end of a stretch is 0.6 % of the autocorrelation length (the sine above); a gap adds two.
    const double relative = p.suffix == "al" ? 1e-2 : 2e-3;
    EXPECT_NEAR(r.*p.value, expected, relative * std::abs(expected) + 1e-9) << p.suffix;
  }
}

TEST(FilterProfile, SplitsALongAndAShortWave) {
  // 0.1 mm and 4 mm at λc 0.8 mm: the Gaussian passes 2^−(λc/λ)² of a wave.
  constexpr double kStep_m = 5e-6;
  const auto z = sampled(8000, kStep_m, [](double x) {
    return 1e-6 * std::sin(2 * pi * x / 0.1e-3) + 5e-6 * std::sin(2 * pi * x / 4e-3);
  });
  RoughnessConfig config;
  config.lambda_c_mm = 0.8;
  for (const auto filter : {ProfileFilter::kGaussian, ProfileFilter::kRobust}) {
    config.filter = filter;
    const ProfileTexture r = measure_profile_texture(z, kStep_m, config);
    ASSERT_TRUE(r.R && r.W);
    EXPECT_NEAR(r.P.q_m, std::sqrt(13.0) * 1e-6, 1e-9);
    EXPECT_NEAR(r.R->q_m, 1e-6 / std::numbers::sqrt2, 0.04e-6);  // with 1 − 2^−0.04 of the long wave
    EXPECT_NEAR(r.W->q_m, 5e-6 * std::exp2(-0.04) / std::numbers::sqrt2, 0.1e-6);
    EXPECT_NEAR(r.W->sm_m, 4e-3, 0.02e-3);
  }
  config.filter = ProfileFilter::kGaussian;
  config.ends = ProfileEnds::kCut;
  const FilteredProfiles cut = filter_profile(z, kStep_m, config);
  EXPECT_EQ(cut.roughness_m.size(), 8000u - 160u);
  EXPECT_EQ(cut.primary_m.size(), 8000u);
  config.lambda_f_mm = 2.0;
  EXPECT_EQ(filter_profile(z, kStep_m, config).waviness_m.size(), 8000u - 160u - 400u);
  config.ends = ProfileEnds::kKeep;
  // λf takes 2^−(2/4)² of the 4 mm wave away again.
  EXPECT_NEAR(measure_profile_texture(z, kStep_m, config).W->q_m,
              5e-6 * std::exp2(-0.04) * (1 - std::exp2(-0.25)) / std::numbers::sqrt2, 0.05e-6);
  config.ends = ProfileEnds::kCut;
  config.lambda_c_mm = 39.99;  // leaves two heights
  EXPECT_THROW(filter_profile(z, kStep_m, config), Error);
}

// Linear (no outliers), a wave of the cut-off length is halved; parabolas are kept to the end; deep scratches that bend
// the Gaussian mean line leave the robust one alone.
TEST(RobustGaussian, HalvesTheCutOffKeepsParabolasAndIgnoresScratches) {
  constexpr double kStep_m = 2e-6, kCutoff_m = 0.8e-3;
  const auto parabola = sampled(2000, kStep_m, [](double x) { return 0.3 * x * x - 1e-3 * x; });
  const auto kept = robust_gaussian_mean_line_m(parabola, kStep_m, kCutoff_m);
  for (std::size_t i = 0; i < kept.size(); ++i) EXPECT_NEAR(kept[i], parabola[i], 1e-15);

  Random random(7);
  auto scratched = sampled(4000, kStep_m, [&](double) { return 0.1e-6 * random.normal(); });
  const auto without = robust_gaussian_mean_line_m(scratched, kStep_m, kCutoff_m);
  for (std::size_t at = 300; at < 4000; at += 400) {
    for (std::size_t i = at; i < at + 40; ++i) scratched[i] -= 10e-6;  // a tenth of the profile
  }
  const auto robust = robust_gaussian_mean_line_m(scratched, kStep_m, kCutoff_m);
  const auto plain = gaussian_mean_line_m(scratched, kStep_m, kCutoff_m);
  double worst_m = 0.0, worst_plain_m = 0.0;
  for (std::size_t i = 0; i < robust.size(); ++i) {
    worst_m = std::max(worst_m, std::abs(robust[i] - without[i]));
    worst_plain_m = std::max(worst_plain_m, std::abs(plain[i] - without[i]));
  }
  // Noise of 0.1 µm over some 200 independent heights less a tenth of them: 0.03 µm; 10 µm over a tenth: 1 µm.
  EXPECT_LT(worst_m, 0.05e-6);
  EXPECT_GT(worst_plain_m, 0.7e-6);
}

// With the noise's σ known, the standard errors hold the difference to the profile without noise.
TEST(ProfileTexture, StandardErrorsCoverWhatNoiseDoes) {
  constexpr double kStep_m = 25e-6;
  const auto truth = sampled(1600, kStep_m, [](double x) {
    return 10e-6 * std::sin(2 * pi * x / 1e-3) + 6e-6 * std::sin(2 * pi * x / 0.37e-3 + 1.0);
  });
  RoughnessConfig config;
  config.lambda_c_mm = 2.5;
  const ProfileTexture want = measure_profile_texture(truth, kStep_m, config);
  const std::vector<double> sigma(truth.size(), 2e-6);
  TextureNoise noise = noise_of_sigma(truth, sigma, kStep_m, 0.1);
  std::vector<double> measured = truth;
  // Noise of that spectrum from another generator than the estimate's: a sum of cosines with random phases.
  Random random(3);
  for (std::size_t k = 1; k < noise.frequency_cycles_per_mm.size(); ++k) {
    const double f = noise.frequency_cycles_per_mm[k], df = f - noise.frequency_cycles_per_mm[k - 1];
    const double a = std::sqrt(2 * noise.added_psd_m2_mm[k] * df), phase = random.uniform(0, 2 * pi);
    for (std::size_t i = 0; i < measured.size(); ++i)
      measured[i] += a * std::cos(2 * pi * f * static_cast<double>(i) * 1e3 * kStep_m + phase);
  }
  const ProfileTexture got = measure_profile_texture(measured, kStep_m, config, {}, noise);
  EXPECT_TRUE(std::isnan(measure_profile_texture(measured, kStep_m, config).R->standard_error.q_m));
  int covered = 0, all = 0;
  for (const ProfileParameter& p : kProfileParameters) {
    const double error = got.R->standard_error.*p.value;
    if (std::isnan((*got.R).*p.value)) {  // two sines are not of two processes
      EXPECT_TRUE(std::isnan(error)) << p.suffix;
      continue;
    }
    ASSERT_GT(error, 0.0) << p.suffix;
    ++all;
    if (std::abs((*got.R).*p.value - (*want.R).*p.value) <= 2.0 * error) ++covered;
  }
  EXPECT_EQ(all, 43);
  EXPECT_GE(covered, 39) << "of " << all;  // 95 % of 43 are 41; 28 of 31 before
}

}  // namespace
}  // namespace asperity
