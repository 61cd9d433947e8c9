#include "asperity/profile/estimate_stiffness.h"

#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "synthetic_path.h"

namespace asperity {
namespace {

using synthetic::SlowNoise;

struct Pressed {
  TipMotion motion;
  BasePath base;
  std::vector<char> contact;
};

// A stroke at 25 mm/s over a sine of 1.5 mm; the tip sinks by F/k.
Pressed press(double stiffness_N_per_m, double drift_m, double force_sigma_N, std::uint64_t seed,
              double relief_answer_N_per_m = 0.0) {
  constexpr double kRate_hz = 1000.0;
  SlowNoise drift(drift_m, 0.4, kRate_hz, seed), force(force_sigma_N, 0.8, kRate_hz, seed + 1000);
  Pressed out;
  for (int i = 0; i < 6000; ++i) {
    const double s = 0.025 * i / kRate_hz;
    const double texture = 50e-6 * std::sin(2.0 * std::numbers::pi * s / 1.5e-3);
    const double f = 1.0 + 0.2 * i / 6000.0 + force.next() + relief_answer_N_per_m * texture;
    out.motion.t_ns.push_back(i * 1'000'000LL);
    out.motion.p_world_tip_m.emplace_back(s, 0.0, texture - f / stiffness_N_per_m + drift.next());
    out.motion.q_world_marker.push_back(Eigen::Quaterniond::Identity());
    out.motion.force_N.push_back(i % 3 == 0 ? f : NAN);
    out.base.p_world_m.emplace_back(s, 0.0, 0.0);
    out.base.n_world.push_back(Eigen::Vector3d::UnitZ());
    out.base.s_m.push_back(s);
    out.contact.push_back(1);
  }
  return out;
}

TEST(Stiffness, SoftRubberIsMeasured) {
  for (const double answer : {0.0, 2000.0}) {
    const Pressed p = press(2e3, 0.02e-3, 0.15, 5, answer);
    const StiffnessEstimate e = estimate_stiffness(p.motion, p.base, p.contact, {});
    EXPECT_TRUE(e.measured);
    EXPECT_NEAR(e.stiffness_N_per_mm, 2.0, 3.5 * e.stiffness_stderr_N_per_mm);
    EXPECT_LT(e.stiffness_stderr_N_per_mm, 0.4);
    EXPECT_LT(e.lower_bound_N_per_mm, 2.0);
  }
}

TEST(Stiffness, StandardErrorIsTheSpreadAndTheBoundHolds) {
  double square = 0.0;
  int bound_holds = 0, measured = 0;
  constexpr int kRuns = 100;
  for (int run = 0; run < kRuns; ++run) {
    const Pressed p = press(20e3, 0.05e-3, 0.15, 40 + static_cast<std::uint64_t>(run));
    const StiffnessEstimate e = estimate_stiffness(p.motion, p.base, p.contact, {});
    square += std::pow((e.compliance_mm_per_N - 0.05) / e.compliance_stderr_mm_per_N, 2);
    bound_holds += e.lower_bound_N_per_mm < 20.0 ? 1 : 0;
    measured += e.measured ? 1 : 0;
  }
  // About ten independent bins carry the noise's own estimate, so the ratio is Student's rather than normal.
  EXPECT_NEAR(std::sqrt(square / kRuns), 1.1, 0.35);
  EXPECT_GE(bound_holds, 90);
  EXPECT_LE(measured, 20);
}

TEST(Stiffness, AStiffSurfaceGivesABoundOnly) {
  const Pressed p = press(2e5, 0.05e-3, 0.1, 9);
  const StiffnessEstimate e = estimate_stiffness(p.motion, p.base, p.contact, {});
  EXPECT_FALSE(e.measured);
  EXPECT_TRUE(std::isnan(e.stiffness_N_per_mm));
  EXPECT_LT(e.lower_bound_N_per_mm, 200.0);
  EXPECT_GT(e.lower_bound_N_per_mm, 0.5);
}

TEST(Stiffness, SaysWhatIsMissing) {
  Pressed p = press(2e3, 0.0, 0.1, 1);
  std::fill(p.contact.begin(), p.contact.end(), 0);
  EXPECT_FALSE(estimate_stiffness(p.motion, p.base, p.contact, {}).measured);
  std::fill(p.contact.begin(), p.contact.end(), 1);
  p.motion.force_N.assign(p.motion.size(), NAN);
  EXPECT_EQ(estimate_stiffness(p.motion, p.base, p.contact, {}).verdict, "no force was measured");
  p.contact.pop_back();
  EXPECT_THROW(estimate_stiffness(p.motion, p.base, p.contact, {}), Error);
}

}  // namespace
}  // namespace asperity
