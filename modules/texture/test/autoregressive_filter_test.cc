#include "asperity/texture/autoregressive_filter.h"

#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/texture/series_state.h"

namespace asperity {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

std::vector<double> random_reflections(Random& random, int order, double largest) {
  std::vector<double> k(static_cast<std::size_t>(order));
  for (double& km : k) km = random.uniform(-largest, largest);
  return k;
}

TEST(AutoregressiveFilter, FrequenciesOfASecondOrderFilterByHand) {
  // A = 1 + a1 z⁻¹ + a2 z⁻²: the sum is (1 + z⁻¹)(1 − (1 − a1 − a2) z⁻¹ + z⁻²), the difference
  // (1 − z⁻¹)(1 + (1 + a1 − a2) z⁻¹ + z⁻²).
  const double a1 = -1.2;
  const double a2 = 0.72;
  const std::vector<double> a{a1, a2};
  std::vector<double> k(2);
  ASSERT_TRUE(ar_to_reflection(a, k));
  EXPECT_NEAR(k[1], a2, 1e-15);
  EXPECT_NEAR(k[0], a1 / (1.0 + a2), 1e-15);
  const auto lsf = reflection_to_lsf(k);
  EXPECT_NEAR(lsf[0], std::acos(0.5 * (1.0 - a1 - a2)), 1e-12);
  EXPECT_NEAR(lsf[1], std::acos(-0.5 * (1.0 + a1 - a2)), 1e-12);
}

TEST(AutoregressiveFilter, FormsConvertIntoEachOther) {
  Random random(3);
  for (int order = 1; order <= kMaxSeriesOrder; ++order) {
    const auto k = random_reflections(random, order, order > 16 ? 0.5 : 0.9);
    std::vector<double> a(k.size()), back(k.size()), from_lsf(k.size());
    reflection_to_ar(k, a);
    ASSERT_TRUE(ar_to_reflection(a, back));
    const auto lsf = reflection_to_lsf(k);
    lsf_to_ar(lsf, from_lsf);
    double last = 0.0;
    for (std::size_t i = 0; i < k.size(); ++i) {
      EXPECT_NEAR(back[i], k[i], 1e-9) << order;
      // Frequencies are found to 1e-16 of π; the polynomial of order 32 is up to 1e7 times as sensitive.
      EXPECT_NEAR(from_lsf[i], a[i], 1e-8 * (1.0 + std::abs(a[i]))) << order;
      EXPECT_GT(lsf[i], last);
      last = lsf[i];
    }
    EXPECT_LT(last, std::numbers::pi);
  }
}

TEST(AutoregressiveFilter, SumAndDifferenceVanishAtTheFrequencies) {
  Random random(4);
  const auto k = random_reflections(random, 9, 0.95);
  std::vector<double> a(9);
  reflection_to_ar(k, a);
  const auto lsf = reflection_to_lsf(k);
  for (std::size_t i = 0; i < lsf.size(); ++i) {
    const auto z = std::polar(1.0, -lsf[i]);
    std::complex<double> value = 1.0;
    for (std::size_t j = 0; j < a.size(); ++j) value += a[j] * std::pow(z, static_cast<double>(j + 1));
    const auto mirrored = std::pow(z, 10.0) * std::conj(value);
    EXPECT_LT(std::abs(i % 2 == 0 ? value + mirrored : value - mirrored), 1e-9) << i;
  }
}

TEST(AutoregressiveFilter, UnstableIsTold) {
  std::vector<double> k(2);
  EXPECT_FALSE(ar_to_reflection(std::vector<double>{-2.0, 1.01}, k));
  EXPECT_FALSE(ar_to_reflection(std::vector<double>{0.0, 1.0}, k));
  EXPECT_FALSE(ar_to_reflection(std::vector<double>{std::nan(""), 0.1}, k));
  EXPECT_THAT([] { reflection_to_lsf(std::vector<double>{1.0}); }, ThrowsMessage<Error>(HasSubstr("unstable")));
  EXPECT_THAT([] { reflection_to_lsf(std::vector<double>(33, 0.1)); }, ThrowsMessage<Error>(HasSubstr("order 33")));
}

TEST(AutoregressiveFilter, AutocovarianceIsTheSpectrumsTransform) {
  const std::vector<double> k{-0.7, 0.5, 0.2};
  std::vector<double> a(3);
  reflection_to_ar(k, a);
  const auto r = autocovariance(k, 2.0, 8);
  constexpr int kSteps = 4096;  // the sum is exact to rounding: the spectrum is smooth and periodic
  for (std::size_t m = 0; m < r.size(); ++m) {
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      const double omega = 2.0 * std::numbers::pi * i / kSteps;
      sum += power_density(a, {}, 1.0, 2.0, omega) * std::cos(omega * static_cast<double>(m)) / kSteps;
    }
    EXPECT_NEAR(r[m], sum, 1e-11 * r[0]) << m;
  }
  const auto back = levinson(std::span(r).first(4));
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(back.k[i], k[i], 1e-12);
  EXPECT_NEAR(back.variance, 2.0, 1e-12);
}

TEST(AutoregressiveFilter, LevinsonRefusesWhatIsNoAutocovariance) {
  EXPECT_THAT([] { levinson(std::vector<double>{0.0}); }, ThrowsMessage<Error>(HasSubstr("no variance")));
  EXPECT_THAT([] { levinson(std::vector<double>{1.0, 1.5}); }, ThrowsMessage<Error>(HasSubstr("positive definite")));
}

}  // namespace
}  // namespace asperity
