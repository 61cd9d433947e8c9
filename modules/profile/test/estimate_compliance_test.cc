#include "asperity/profile/estimate_compliance.h"

#include <gtest/gtest.h>
#include <cmath>

#include "asperity/base/error.h"
#include "asperity/base/random.h"

namespace asperity {
namespace {

const Eigen::Vector3d kNormal(0.0, -0.6, 0.8);

// A stroke of 6 s between rests of 1 s, the force from 0.5 to 2 N, the speed from 20 to 40 mm/s and the
// amplitude of the acceleration v² F^power of a 40 Hz sine, with `noise_mps2` added throughout.
TipMotion ramp(double power, double noise_mps2) {
  Random random(1);
  TipMotion m;
  double way_m = 0.0;
  for (int i = 0; i < 8000; ++i) {
    const double t = 0.001 * i;
    const double u = (t - 1.0) / 6.0;
    const bool moving = u >= 0.0 && u <= 1.0;
    const double force_N = 0.5 + 1.5 * std::clamp(u, 0.0, 1.0);
    const double speed_mps = moving ? 0.02 + 0.02 * u : 0.0;
    const double amplitude = 2000.0 * speed_mps * speed_mps * std::pow(force_N, power);
    m.t_ns.push_back(1'000'000LL * i);
    way_m += 0.001 * speed_mps;
    m.p_world_tip_m.push_back(way_m * Eigen::Vector3d::UnitX() + 1e-3 * random.normal() * kNormal);
    if (i % 500 == 7) m.p_world_tip_m.back().y() += 0.05;  // a flipped pose
    m.q_world_marker.push_back(Eigen::Quaterniond::Identity());
    m.v_world_tip_mps.push_back(speed_mps * Eigen::Vector3d::UnitX());
    const double a = amplitude * std::sin(2.0 * M_PI * 40.0 * t) + noise_mps2 * random.normal();
    m.a_world_tip_mps2.push_back(a * kNormal + 0.4 * random.normal() * Eigen::Vector3d::UnitX());
    m.force_N.push_back(i % 3 == 0 ? force_N : std::nan(""));
  }
  return m;
}

Compliance estimate(const TipMotion& motion, const ComplianceConfig& config = {}) {
  return estimate_compliance(motion, std::vector<std::int64_t>{0}, std::vector{kNormal}, config);
}

TEST(EstimateCompliance, TableOneIsTheExponential) {
  EXPECT_NEAR(compliance_coefficient(0.0454), 0.9556, 5e-5);
  EXPECT_NEAR(compliance_coefficient(0.2581), 0.7725, 5e-5);
  EXPECT_NEAR(compliance_coefficient(3.7127), 0.0244, 5e-5);
}

// The seed's hypothesis of a stiff surface: acceleration in proportion to the force.
TEST(EstimateCompliance, AmplitudeInProportionToForceIsStiff) {
  const Compliance c = estimate(ramp(1.0, 0.0));
  EXPECT_GT(c.windows.size(), 18u);
  EXPECT_NEAR(c.exponent, 0.0, 0.02);
  EXPECT_NEAR(c.k_c, 1.0, 1e-3);
}

// The ratio is F^(1-power): for power -1 F², whose variance over a uniform ramp from 0.5 to 2 N is
// <F⁴>/<F²>² - 1 = 0.445 in the continuum; windows at the ends cut it.
TEST(EstimateCompliance, VarianceIsThatOfTheForcesPower) {
  const Compliance c = estimate(ramp(-1.0, 0.0));
  EXPECT_NEAR(c.exponent, 2.0, 0.03);
  const double expected = (31.96875 / 5.0 / 1.5) / std::pow(7.875 / 3.0 / 1.5, 2) - 1.0;
  EXPECT_NEAR(c.sigma_r2, expected, 0.1 * expected);
  EXPECT_NEAR(c.k_c, std::exp(-c.sigma_r2), 1e-12);
  EXPECT_NEAR(c.ratio_variance, c.sigma_r2, 0.1 * expected);  // no scatter here
}

TEST(EstimateCompliance, FallsAsTheSurfaceYields) {
  double before = 1.0;
  for (const double power : {0.5, 0.0, -0.5, -1.0}) {
    const double k_c = estimate(ramp(power, 0.1)).k_c;
    EXPECT_LT(k_c, before) << power;
    before = k_c;
  }
}

// Noise is measured at rest and leaves the amplitudes: without that the exponent would be drawn to 1.
TEST(EstimateCompliance, NoiseAtRestIsSubtracted) {
  const Compliance c = estimate(ramp(-1.0, 0.3));
  EXPECT_NEAR(c.rest_amplitude_mps2, 0.3, 0.03);
  EXPECT_NEAR(c.exponent, 2.0, 0.15);
}

TEST(EstimateCompliance, WithoutARampThereIsNoCoefficient) {
  TipMotion motion = ramp(0.0, 0.0);
  for (double& f : motion.force_N) f = 1.0;
  EXPECT_TRUE(std::isnan(estimate(motion).k_c));
  EXPECT_FALSE(estimate(motion).windows.empty());
  for (double& f : motion.force_N) f = std::nan("");
  EXPECT_TRUE(std::isnan(estimate(motion).k_c));
  EXPECT_TRUE(std::isnan(estimate({}).k_c));
}

TEST(EstimateCompliance, RejectsUnequalSizes) {
  EXPECT_THROW(estimate_compliance(ramp(0.0, 0.0), {}, {}, {}), Error);
  TipMotion motion = ramp(0.0, 0.0);
  motion.force_N.pop_back();
  EXPECT_THROW(estimate(motion), Error);
}

}  // namespace
}  // namespace asperity
