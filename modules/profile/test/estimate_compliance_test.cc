#include "asperity/profile/estimate_compliance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cmath>
#include <functional>
#include <numbers>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/profile/stiffness_of_compliance.h"

namespace asperity {
namespace {

using testing::HasSubstr;

const Eigen::Vector3d kNormal(0.0, -0.6, 0.8);
constexpr double kPi = std::numbers::pi;

// A stroke of `length_m` between rests of 1 s, the force from `light` to `firm`, over a relief of 1.25 cycles/mm, or a
// Gaussian one of 0.5 to 2.5 cycles/mm for a seed above 0, whose amplitude falls with the force as `fall`.
struct Stroke {
  double light_N = 0.3, firm_N = 2.5;
  double speed_mps = 0.025;
  double length_m = 0.08;
  double noise_mps2 = 0.0;
  std::uint64_t seed = 0;
  std::function<double(double)> fall = [](double) { return 1.0; };
};

TipMotion scan(const Stroke& stroke) {
  Random random(stroke.seed + 1000);
  struct Wave {
    double amplitude, cycles_per_m, phase;
  };
  std::vector<Wave> waves;
  if (stroke.seed == 0) waves.push_back({2000.0, 1250.0, 0.3});
  for (int k = 0; k < 120 && stroke.seed > 0; ++k)
    waves.push_back({200.0, 500.0 + 2000.0 * random.uniform(), 2.0 * kPi * random.uniform()});
  TipMotion m;
  double s_m = 0.0;
  const double stroke_s = stroke.length_m / stroke.speed_mps;
  for (int i = 0; i < static_cast<int>(1000.0 * (stroke_s + 2.0)); ++i) {
    const double u = (0.001 * i - 1.0) / stroke_s;
    const bool moving = u >= 0.0 && u <= 1.0;
    const double force_N = stroke.light_N + (stroke.firm_N - stroke.light_N) * std::clamp(u, 0.0, 1.0);
    const double v = moving ? stroke.speed_mps * (1.0 + 0.1 * std::sin(2.0 * kPi * u)) : 0.0;
    s_m += 0.001 * v;
    double a = stroke.noise_mps2 * random.normal();
    for (const Wave& w : waves)
      a += v * v * stroke.fall(force_N) * w.amplitude * std::sin(2.0 * kPi * w.cycles_per_m * s_m + w.phase);
    m.t_ns.push_back(1'000'000LL * i);
    m.p_world_tip_m.push_back(s_m * Eigen::Vector3d::UnitX() + 1e-3 * random.normal() * kNormal);
    if (i % 500 == 7) m.p_world_tip_m.back().y() += 0.05;  // a flipped pose
    m.q_world_marker.push_back(Eigen::Quaterniond::Identity());
    m.v_world_tip_mps.push_back(v * Eigen::Vector3d::UnitX());
    m.a_world_tip_mps2.push_back(a * kNormal + 0.4 * random.normal() * Eigen::Vector3d::UnitX());
    m.force_N.push_back(i % 3 == 0 ? force_N : std::nan(""));
  }
  return m;
}

Compliance estimate(const TipMotion& motion, const ComplianceConfig& config = {}) {
  return estimate_compliance(motion, std::vector<std::int64_t>{0}, std::vector{kNormal}, config);
}

// exp(-g (F^p - 1) / p).
std::function<double(double)> law(double g, double p) {
  return [=](double f) { return std::exp(-g * (std::pow(f, p) - 1.0) / p); };
}

TEST(EstimateCompliance, TableOneIsTheExponential) {
  EXPECT_NEAR(compliance_coefficient(0.0454), 0.9556, 5e-5);
  EXPECT_NEAR(compliance_coefficient(0.2581), 0.7725, 5e-5);
  EXPECT_NEAR(compliance_coefficient(3.7127), 0.0244, 5e-5);
}

// A power law in closed form: <F^(2b)>/<F^b>² − <F²>/<F>² over 0.5 to 1.5 N, <F^n> = (1.5^(n+1) − 0.5^(n+1))/(n+1).
TEST(EstimateCompliance, TheStandardVarianceIsTheClosedForm) {
  const auto moment = [](double n) { return (std::pow(1.5, n + 1.0) - std::pow(0.5, n + 1.0)) / (n + 1.0); };
  for (const double g : {-0.5, 0.0, 0.3, 1.0, 2.0}) {
    const double b = 1.0 + g;
    const double expected = moment(2.0 * b) / std::pow(moment(b), 2) - moment(2.0) / std::pow(moment(1.0), 2);
    EXPECT_NEAR(standard_sigma_r2(g, 1e-6), expected, 2e-4) << g;
  }
  EXPECT_DOUBLE_EQ(standard_sigma_r2(-3.0, 0.5), standard_sigma_r2(-1.0, 0.5));
}

// A tip that follows a rigid relief has a = v² h″ at any force; and the seed's stiff surface, on which a grows with it.
TEST(EstimateCompliance, RigidSurfacesHaveOne) {
  const Compliance rigid = estimate(scan({}));
  EXPECT_TRUE(rigid.determined);
  EXPECT_NEAR(rigid.exponent, 1.0, 0.02);
  EXPECT_NEAR(rigid.k_c, 1.0, 5e-3);
  const Compliance seeds = estimate(scan({.fall = [](double f) { return f; }}));
  EXPECT_NEAR(seeds.exponent, 0.0, 0.15);  // of the laws, F^1 is the limit p → 0
  EXPECT_EQ(seeds.k_c, 1.0);
}

// The point of the standard forces: k_c is the surface's, whatever the ramp and the speed. The truth is the law's own.
TEST(EstimateCompliance, IsTheSameForEveryRampAndSpeed) {
  for (const auto& [g, p] : {std::pair{0.2, 0.5}, std::pair{0.8, 0.5}, std::pair{0.8, 1.0}, std::pair{1.5, 0.75}}) {
    const double truth = compliance_coefficient(standard_sigma_r2(g, p));
    for (const auto& [light, firm] : {std::pair{0.3, 0.8}, {1.0, 2.5}, {0.3, 2.5}, {0.3, 4.0}}) {
      for (const double speed : {0.02, 0.04, 0.06}) {
        const Compliance c = estimate(scan({.light_N = light, .firm_N = firm, .speed_mps = speed, .fall = law(g, p)}));
        EXPECT_TRUE(c.determined) << light << ' ' << firm << ' ' << speed << ": " << c.verdict;
        // The ramp of 0.3 to 0.8 N says nothing of what a law does at 1.5 N.
        EXPECT_NEAR(c.k_c, truth, firm < 1.0 ? 0.1 * truth : 0.04 * truth)
            << g << ' ' << p << ' ' << light << ' ' << speed;
        EXPECT_LE(c.k_c_low, truth);
        EXPECT_GE(c.k_c_high, truth);
      }
    }
  }
}

TEST(EstimateCompliance, FallsAsTheSurfaceYields) {
  double before = 1.1;
  for (const double g : {0.0, 0.3, 0.7, 1.2}) {
    const double k_c = estimate(scan({.fall = law(g, 0.5)})).k_c;
    EXPECT_LT(k_c, before) << g;
    before = k_c;
  }
}

// Gaussian reliefs: the interval holds the law's k_c as often as it says, and is as wide as the estimates scatter.
TEST(EstimateCompliance, TheIntervalHolds) {
  constexpr int kRuns = 60;
  const double truth = compliance_coefficient(standard_sigma_r2(0.6, 0.75));
  double square = 0.0, variance = 0.0;
  int holds = 0;
  for (int run = 1; run <= kRuns; ++run) {
    const Compliance c =
        estimate(scan({.seed = static_cast<std::uint64_t>(run), .fall = law(0.6, 0.75)}), {.softness_sigma = 0.0});
    ASSERT_TRUE(c.determined);
    holds += c.k_c_low <= truth && truth <= c.k_c_high ? 1 : 0;
    square += std::pow(c.k_c - truth, 2) / kRuns;
    variance += std::pow(c.k_c_stderr, 2) / kRuns;
  }
  EXPECT_GE(holds, 52);                                  // 57 expected, σ 1.7
  EXPECT_NEAR(std::sqrt(square / variance), 1.0, 0.35);  // 60 runs: σ 0.09, and what the laws disagree on
}

// Noise is measured at rest and taken out: without that an amplitude that falls with the force would seem not to.
TEST(EstimateCompliance, NoiseAtRestIsSubtracted) {
  const Compliance clean = estimate(scan({.fall = law(1.0, 0.5)}));
  const Compliance noisy = estimate(scan({.noise_mps2 = 1.0, .fall = law(1.0, 0.5)}));
  EXPECT_GT(noisy.rest_amplitude_mps2, 0.1);
  EXPECT_NEAR(noisy.exponent, clean.exponent, 2.5 * noisy.exponent_error);
  EXPECT_NEAR(noisy.k_c, clean.k_c, 0.06);
}

TEST(EstimateCompliance, SaysWhatIsMissing) {
  Compliance c = estimate(scan({.light_N = 0.9, .firm_N = 1.1, .seed = 3}));
  EXPECT_FALSE(c.determined);
  EXPECT_TRUE(std::isnan(c.k_c));
  EXPECT_GT(c.k_c_stderr, 0.0);
  EXPECT_FALSE(c.windows.empty());
  EXPECT_THAT(c.verdict, HasSubstr("3.5 times as hard"));

  c = estimate(scan({.length_m = 0.012}));
  EXPECT_THAT(c.verdict, HasSubstr("8 are needed"));

  c = estimate(scan({.noise_mps2 = 1.0, .fall = [](double) { return 0.0; }}));
  EXPECT_THAT(c.verdict, HasSubstr("above the noise of the stationary probe"));

  TipMotion motion = scan({});
  for (std::size_t i = 0; i < motion.size(); ++i)
    if (std::isfinite(motion.force_N[i]) && i % 40 < 10) motion.force_N[i] = 0.0;
  c = estimate(motion);
  // Every section, of a scan that has heights all along: it is no share of the path.
  EXPECT_EQ(c.lost_fraction, 1.0);
  EXPECT_THAT(c.verdict, HasSubstr("in 100 % of the sections of 4 mm the force falls below a quarter of its mean"));

  motion.force_N.assign(motion.size(), std::nan(""));
  EXPECT_EQ(estimate(motion).verdict, "not determined: no force was measured");
  EXPECT_TRUE(std::isnan(estimate({}).k_c));
}

// The chart at its own points, and what it cannot tell.
TEST(StiffnessOfCompliance, ReadsTheChartBackwards) {
  Compliance c;
  EXPECT_FALSE(stiffness_of_compliance(c).has_value());
  c.determined = true;
  c.k_c = 0.952;  // the median of 10 N/mm
  const auto cork = stiffness_of_compliance(c);
  EXPECT_NEAR(cork->stiffness_N_per_mm, 10.0, 1e-9);
  EXPECT_EQ(cork->low_N_per_mm, 1.0);
  EXPECT_GT(cork->high_N_per_mm, 50.0);
  EXPECT_LT(cork->high_N_per_mm, 200.0);
  c.k_c = 0.8;
  EXPECT_EQ(stiffness_of_compliance(c)->stiffness_N_per_mm, 1.0);
  EXPECT_NEAR(stiffness_of_compliance(c)->high_N_per_mm, 1.5, 1e-9);
  c.k_c = 1.0;
  EXPECT_TRUE(std::isinf(stiffness_of_compliance(c)->high_N_per_mm));
  double before = 0.0;
  for (c.k_c = 0.7; c.k_c < 1.0; c.k_c += 0.01) {
    const auto s = stiffness_of_compliance(c);
    EXPECT_LE(s->low_N_per_mm, s->stiffness_N_per_mm);
    EXPECT_LE(s->stiffness_N_per_mm, s->high_N_per_mm);
    EXPECT_GE(s->stiffness_N_per_mm, before);
    before = s->stiffness_N_per_mm;
  }
}

TEST(EstimateCompliance, RejectsUnequalSizes) {
  EXPECT_THROW(estimate_compliance(scan({}), {}, {}, {}), Error);
  TipMotion motion = scan({});
  motion.force_N.pop_back();
  EXPECT_THROW(estimate(motion), Error);
}

}  // namespace
}  // namespace asperity
