#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/profile/measure_roughness.h"
#include "asperity/profile/read_heights.h"
#include "gaussian_filter.h"

namespace asperity {
namespace {

using std::numbers::pi;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
const std::string kData = ASPERITY_TEST_DATA;

template <class Height>
std::vector<double> sampled(std::size_t count, double spacing_m, const Height& height_m) {
  std::vector<double> z;
  z.reserve(count);
  for (std::size_t i = 0; i < count; ++i) z.push_back(height_m((static_cast<double>(i) + 0.5) * spacing_m));
  return z;
}

HeightProfile measured(const std::string& name) {
  return std::get<HeightProfile>(read_heights(kData + "/profiles_mts/" + name + ".csv", {.spacing_m = 0.5e-6}));
}

TEST(Roughness, AgreesWithPublishedMatlabValues) {
  const std::string text = read_file(kData + "/profiles_mts/expected_matlab.csv", 1 << 20);
  CsvReader expected(text, "expected_matlab.csv");
  int compared = 0;
  while (expected.next()) {
    const HeightProfile profile = measured(std::string(expected.cell(0)));
    const RoughnessResult r = measure_roughness(profile.height_m, profile.spacing_m);
    const std::string_view quantity = expected.cell(1);
    double got_m = kNan;
    if (quantity == "Rz") got_m = r.Rz_m;
    if (quantity == "R10z") got_m = r.R10z_m;
    if (quantity == "R5p") got_m = r.R5p_m;
    if (quantity == "R5v") got_m = r.R5v_m;
    if (quantity == "Rcm") got_m = inverse_material_ratio_m(profile.height_m, expected.number(2));
    // The profiles have ten digits; differences of heights keep a relative 1e-9.
    const double want_m = expected.number(3) * 1e-6;
    EXPECT_NEAR(got_m, want_m, 1e-9 * std::abs(want_m))
        << expected.cell(0) << " " << quantity << " " << expected.cell(2);
    ++compared;
  }
  EXPECT_EQ(compared, 16);
}

TEST(Roughness, SineHasItsAnalyticValues) {
  constexpr double kAmplitude_m = 3e-6;
  constexpr double kPitch_m = 0.1e-3;
  // 20 whole periods of 1000 samples: sums equal the integrals to far below 1e-5.
  const auto z =
      sampled(20000, kPitch_m / 1000, [&](double x) { return 7e-6 + kAmplitude_m * std::sin(2 * pi * x / kPitch_m); });
  const RoughnessResult r = measure_roughness(z, kPitch_m / 1000);
  EXPECT_NEAR(r.Ra_m, 2 * kAmplitude_m / pi, 1e-5 * kAmplitude_m);
  EXPECT_NEAR(r.Rq_m, kAmplitude_m / std::numbers::sqrt2, 1e-9 * kAmplitude_m);
  EXPECT_NEAR(r.Rz_m, 2 * kAmplitude_m, 2e-5 * kAmplitude_m);
  EXPECT_NEAR(r.Rt_m, 2 * kAmplitude_m, 2e-5 * kAmplitude_m);
  EXPECT_NEAR(r.Rsk, 0.0, 1e-9);
  EXPECT_NEAR(r.Rku, 1.5, 1e-9);
  EXPECT_NEAR(r.RSm_m, kPitch_m, 1e-6 * kPitch_m);
  EXPECT_NEAR(r.R5p_m, kAmplitude_m, 2e-5 * kAmplitude_m);
  EXPECT_NEAR(r.R10z_m, 2 * kAmplitude_m, 4e-5 * kAmplitude_m);
  EXPECT_NEAR(r.Rcm50_m, -kAmplitude_m, 1e-2 * kAmplitude_m);
  EXPECT_EQ(r.sections_used, 5u);
  EXPECT_DOUBLE_EQ(r.length_m, 2e-3);
}

TEST(Roughness, SawtoothAndSquareWaveHaveTheirAnalyticValues) {
  constexpr double kA_m = 1e-6;
  const auto saw = sampled(10000, 1e-6, [&](double x) { return kA_m * (2 * (x / 1e-3 - std::floor(x / 1e-3)) - 1); });
  RoughnessResult r = measure_roughness(saw, 1e-6);
  EXPECT_NEAR(r.Ra_m, kA_m / 2, 1e-5 * kA_m);
  EXPECT_NEAR(r.Rq_m, kA_m / std::sqrt(3.0), 1e-5 * kA_m);
  EXPECT_NEAR(r.Rku, 1.8, 1e-4);
  EXPECT_NEAR(r.RSm_m, 1e-3, 1e-6);
  const auto square = sampled(10000, 1e-6, [&](double x) { return std::fmod(x, 1e-3) < 0.5e-3 ? kA_m : -kA_m; });
  r = measure_roughness(square, 1e-6);
  EXPECT_NEAR(r.Ra_m, kA_m, 1e-12 * kA_m);
  EXPECT_NEAR(r.Rku, 1.0, 1e-12);
  EXPECT_NEAR(r.RSm_m, 1e-3, 1e-9);
}

TEST(Roughness, ScalesAndTurnsOverAsItMust) {
  const HeightProfile profile = measured("Bu_1_56_ak");
  const RoughnessResult r = measure_roughness(profile.height_m, profile.spacing_m);
  std::vector<double> over(profile.height_m.rbegin(), profile.height_m.rend());
  for (double& z : over) z *= -2.0;
  const RoughnessResult o = measure_roughness(over, profile.spacing_m);
  EXPECT_NEAR(o.Ra_m, 2 * r.Ra_m, 1e-12 * r.Ra_m);
  EXPECT_NEAR(o.Rsk, -r.Rsk, 1e-9);
  EXPECT_NEAR(o.RSm_m, r.RSm_m, 1e-9 * r.RSm_m);
  EXPECT_NEAR(o.R5p_m, 2 * r.R5v_m, 1e-12 * r.R5v_m);
  EXPECT_EQ(o.elements, r.elements);
}

TEST(Roughness, SmallRippleAndSpikesDoNotShortenRSm) {
  constexpr double kPitch_m = 0.5e-3;
  Random random(5);
  const auto z = sampled(20000, 1e-6, [&](double x) {
    return 1e-6 * std::sin(2 * pi * x / kPitch_m) + 0.02e-6 * std::sin(2 * pi * x / 7e-6) + 1e-9 * random.normal();
  });
  const RoughnessResult r = measure_roughness(z, 1e-6);
  // Each end of an element may lie one ripple off; they average out over the elements.
  EXPECT_NEAR(r.RSm_m, kPitch_m, 1e-6);
  EXPECT_EQ(r.elements, 77u);
  const RoughnessResult all = measure_roughness(z, 1e-6, {.element_height = 0.0, .element_width = 0.0});
  EXPECT_LT(all.RSm_m, 0.95 * kPitch_m);
}

// Two-sided prominence by its definition: from each sample outwards until something higher.
std::vector<double> peaks_by_definition(const std::vector<double>& z, double prominence) {
  std::vector<double> peaks;
  for (std::size_t i = 0; i < z.size(); ++i) {
    double left = z[i];
    double right = z[i];
    for (std::size_t j = i; j-- > 0 && z[j] < z[i];) left = std::min(left, z[j]);
    for (std::size_t j = i + 1; j < z.size() && z[j] < z[i]; ++j) right = std::min(right, z[j]);
    if (z[i] - left >= prominence && z[i] - right >= prominence) peaks.push_back(z[i]);
  }
  std::sort(peaks.rbegin(), peaks.rend());
  return peaks;
}

TEST(Roughness, SignificantPeaksAgreeWithTheirDefinition) {
  Random random(11);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<double> z(400);
    double walk = 0.0;
    for (double& v : z) v = walk = 0.9 * walk + random.normal();
    double mean = 0.0;
    for (const double v : z) mean += v / static_cast<double>(z.size());
    for (double& v : z) v -= mean;
    const RoughnessResult r = measure_roughness(z, 1e-6, {.peak_prominence = 0.2});
    const auto peaks = peaks_by_definition(z, 0.2 * r.Rz_m);
    ASSERT_GE(peaks.size(), 5u);
    EXPECT_NEAR(r.R5p_m, (peaks[0] + peaks[1] + peaks[2] + peaks[3] + peaks[4]) / 5, 1e-12);
  }
}

TEST(Roughness, LineIsRemovedWhenAsked) {
  const auto sine = sampled(5000, 1e-6, [](double x) { return 1e-6 * std::cos(2 * pi * x / 0.1e-3); });
  auto tilted = sine;
  for (std::size_t i = 0; i < tilted.size(); ++i) tilted[i] += 3e-9 * static_cast<double>(i);
  const RoughnessResult flat = measure_roughness(sine, 1e-6, {.form = ProfileForm::kLine});
  const RoughnessResult r = measure_roughness(tilted, 1e-6, {.form = ProfileForm::kLine});
  EXPECT_NEAR(r.Rq_m, flat.Rq_m, 1e-12 * flat.Rq_m + 1e-18);
  EXPECT_GT(measure_roughness(tilted, 1e-6).Rq_m, 3 * flat.Rq_m);
}

TEST(Roughness, GapsAreLeftOut) {
  constexpr double kPitch_m = 0.1e-3;
  auto z = sampled(20000, 1e-7, [&](double x) { return 1e-6 * std::sin(2 * pi * x / kPitch_m); });
  // Whole periods go, so that what remains has the analytic values still.
  for (std::size_t i = 6000; i < 8000; ++i) z[i] = kNan;
  const RoughnessResult r = measure_roughness(z, 1e-7);
  EXPECT_EQ(r.missing, 2000u);
  EXPECT_NEAR(r.Ra_m, 2e-6 / pi, 1e-11);
  EXPECT_NEAR(r.RSm_m, kPitch_m, 1e-9);
  EXPECT_EQ(r.sections_used, 5u);
  for (std::size_t i = 4000; i < 8000; ++i) z[i] = kNan;
  EXPECT_EQ(measure_roughness(z, 1e-7).sections_used, 4u);
  for (std::size_t i = 1000; i < 18000; ++i) z[i] = kNan;
  EXPECT_THAT([&] { measure_roughness(z, 1e-7); },
              ThrowsMessage<Error>(HasSubstr("17000 of 20000 heights are missing")));
}

TEST(Roughness, RefusesWhatHasNoMeaning) {
  const std::vector<double> z(100, 1.0);
  EXPECT_THAT([&] { measure_roughness(z, 0.0); }, ThrowsMessage<Error>(HasSubstr("spacing 0 m")));
  EXPECT_THAT([&] { measure_roughness(std::span(z).first(9), 1e-6); },
              ThrowsMessage<Error>(HasSubstr("9 heights are too few for 5 sections")));
  auto infinite = z;
  infinite[41] = std::numeric_limits<double>::infinity();
  EXPECT_THAT([&] { measure_roughness(infinite, 1e-6); }, ThrowsMessage<Error>(HasSubstr("height 42 is infinite")));
  EXPECT_THAT([&] { inverse_material_ratio_m(z, 101); }, ThrowsMessage<Error>(HasSubstr("101 %")));
}

TEST(Roughness, FlatProfileHasZerosAndNoShape) {
  const RoughnessResult r = measure_roughness(std::vector<double>(100, 0.25), 1e-6);
  EXPECT_EQ(r.Ra_m, 0.0);
  EXPECT_EQ(r.Rz_m, 0.0);
  EXPECT_TRUE(std::isnan(r.Rsk));
  EXPECT_TRUE(std::isnan(r.RSm_m));
  EXPECT_TRUE(std::isnan(r.R5p_m));
}

TEST(GaussianFilter, PassesWavesByItsTransferFunction) {
  constexpr double kCutoff_m = 0.8e-3;
  for (const double wavelength_m : {0.2e-3, 0.4e-3, 0.8e-3, 1.6e-3, 4e-3}) {
    const auto z = sampled(8000, 2e-6, [&](double x) { return std::cos(2 * pi * (x - 8e-3) / wavelength_m); });
    const auto mean_line = gaussian_mean_line_m(z, 2e-6, kCutoff_m);
    // ISO 16610-21: exp(−π (α λc / λ)²), α² = ln 2 / π. Cut at one cut-off length, its sum is right to 1e-6.
    const double gain = std::exp2(-std::pow(kCutoff_m / wavelength_m, 2));
    EXPECT_NEAR(mean_line[4000], gain * z[4000], 2e-6) << wavelength_m;
  }
}

TEST(GaussianFilter, KeepsStraightLinesUpToEndsAndGaps) {
  auto z = sampled(1000, 1e-6, [](double x) { return 2.0 + 300.0 * x; });
  for (std::size_t i = 400; i < 460; ++i) z[i] = kNan;
  const auto mean_line = gaussian_mean_line_m(z, 1e-6, 0.1e-3);
  for (std::size_t i = 0; i < z.size(); ++i) {
    if (std::isnan(z[i])) {
      EXPECT_TRUE(std::isnan(mean_line[i]));
    } else {
      EXPECT_NEAR(mean_line[i], z[i], 1e-12) << i;
    }
  }
}

TEST(Roughness, CutoffsSeparateWavinessAndNoise) {
  const auto z = sampled(16000, 0.5e-6, [](double x) {
    return 20e-6 * std::sin(2 * pi * x / 8e-3) + 1e-6 * std::sin(2 * pi * x / 0.1e-3) +
           0.3e-6 * std::sin(2 * pi * x / 1.5e-6);
  });
  const RoughnessResult r = measure_roughness(z, 0.5e-6, {.lambda_s_mm = 0.0025, .lambda_c_mm = 0.8});
  // λc lets 2^-64 of the roughness go and leaves 0.7 % of the waviness (0.14 µm); λs leaves 15 % of the noise.
  EXPECT_NEAR(r.Rq_m, 1e-6 / std::numbers::sqrt2, 0.02e-6);
  EXPECT_NEAR(r.RSm_m, 0.1e-3, 1e-6);
}

// It ends wherever it is asked: with and without filters, in the features and between transforms.
TEST(Roughness, EndsWhenItIsCancelled) {
  const auto z = sampled(60000, 1e-6, [](double x) { return 1e-6 * std::sin(2 * pi * x / 8e-6); });
  for (const RoughnessConfig& config : {RoughnessConfig{}, RoughnessConfig{.lambda_c_mm = 0.8},
                                        RoughnessConfig{.lambda_c_mm = 0.8, .filter = ProfileFilter::kRobust}}) {
    int asked = 0;
    measure_roughness(z, 1e-6, config, {{}, [&] { return ++asked, false; }});
    EXPECT_GT(asked, 30);  // a line in 4096 of each pass
    for (int last = 1; last <= asked; last += 1 + asked / 20) {
      int now = 0;
      EXPECT_THROW(measure_roughness(z, 1e-6, config, {{}, [&] { return ++now == last; }}), Cancelled) << last;
    }
  }
}

}  // namespace
}  // namespace asperity
