#include "asperity/profile/estimate_stiffness.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include <Eigen/Cholesky>

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

// A rest, a stroke of 80 mm over a cylinder of 60 mm radius under a force that rises from 0.5 to 2.5 N, a rest. The
// base is the circle that fits the path best (Kåsa's fit), as who does not know the cylinder has it: most of the
// sinking is in its centre and radius.
Pressed press_round(double stiffness_N_per_m, std::uint64_t seed) {
  constexpr double kRate_hz = 1000.0, kRadius_m = 0.06, kRest_s = 1.5, kStroke_s = 3.2;
  SlowNoise drift(0.05e-3, 0.4, kRate_hz, seed), force(0.1, 0.8, kRate_hz, seed + 1000);
  Pressed out;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (int i = 0; i < static_cast<int>((2.0 * kRest_s + kStroke_s) * kRate_hz); ++i) {
    const double share = std::clamp((i / kRate_hz - kRest_s) / kStroke_s, 0.0, 1.0);
    const double angle = 0.08 / kRadius_m * (share - 0.5);
    const double f = 0.5 + 2.0 * share + force.next();
    const double height_m = drift.next() - f / stiffness_N_per_m;
    const Eigen::Vector3d n(std::sin(angle), 0.0, std::cos(angle));
    out.motion.t_ns.push_back(i * 1'000'000LL);
    out.motion.p_world_tip_m.push_back((kRadius_m + height_m) * n);
    out.motion.q_world_marker.push_back(Eigen::Quaterniond::Identity());
    out.motion.force_N.push_back(f);
    out.contact.push_back(1);
    if (share == 0.0 || share == 1.0) continue;
    const Eigen::Vector3d& p = out.motion.p_world_tip_m.back();
    const Eigen::Vector3d row(p.x(), p.z(), 1.0);
    normal += row * row.transpose();
    right += row * (p.x() * p.x() + p.z() * p.z());
  }
  const Eigen::Vector3d circle = normal.ldlt().solve(right);
  const Eigen::Vector3d centre(0.5 * circle[0], 0.0, 0.5 * circle[1]);
  const double radius_m = std::sqrt(circle[2] + centre.squaredNorm());
  for (const Eigen::Vector3d& p : out.motion.p_world_tip_m) {
    const Eigen::Vector3d n = (p - centre).normalized();
    const Eigen::Vector3d at = centre + radius_m * n;
    out.base.s_m.push_back(out.base.p_world_m.empty() ? 0.0
                                                      : out.base.s_m.back() + (at - out.base.p_world_m.back()).norm());
    out.base.p_world_m.push_back(at);
    out.base.n_world.push_back(n);
  }
  return out;
}

TEST(Stiffness, AFittedRoundBaseTakesNoSinkingAway) {
  constexpr int kRuns = 60;
  double mean = 0.0, square = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    const Pressed p = press_round(2e3, 300 + static_cast<std::uint64_t>(run));
    const StiffnessEstimate e = estimate_stiffness(p.motion, p.base, p.contact, {});
    mean += e.compliance_mm_per_N / kRuns;
    square += std::pow((e.compliance_mm_per_N - 0.5) / e.compliance_stderr_mm_per_N, 2) / kRuns;
  }
  std::printf("%.4f mm/N, error over standard error %.2f\n", mean, std::sqrt(square));
  EXPECT_NEAR(mean, 0.5, 0.05);
  EXPECT_LT(std::sqrt(square), 1.5);
}

}  // namespace
}  // namespace asperity
