#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "asperity/pipeline/process_recording.h"
#include "asperity/simulation/simulate_recording.h"

// The force of a whole scan against the contact force that the bench knows.
namespace asperity {
namespace {

Recording scan(bool three_axes, double lean_rad) {
  SimulationConfig config = make_simulation_config("sandpaper", "open");
  config.seed = 4;
  config.hand.length_m = 0.05;
  config.hand.tilt_rad[2] += lean_rad;  // along the path
  config.probe.force3 = three_axes;
  config.calibration.imperfection = 0.0;
  return simulate_recording(config);
}

double mean_true_N(const Recording& recording, const ProcessResult& result) {
  double sum = 0.0, count = 0.0;
  const double first = result.profile.s_m.front(), last = result.profile.s_m.back();
  const Truth& truth = *recording.truth;
  for (std::size_t i = 0; i < truth.s_m.size(); ++i) {
    if (!(truth.s_m[i] - truth.s_m.front() > first + 5e-3 && truth.s_m[i] - truth.s_m.front() < last - 5e-3)) continue;
    sum += truth.force_N[i];
    count += 1.0;
  }
  return sum / count;
}

double mean_found_N(const ProcessResult& result) {
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < result.profile.size(); ++i) {
    const double s_m = result.profile.s_m[i];
    if (!(s_m > result.profile.s_m.front() + 5e-3 && s_m < result.profile.s_m.back() - 5e-3)) continue;
    if (!std::isfinite(result.profile.force_N[i])) continue;
    sum += result.profile.force_N[i];
    count += 1.0;
  }
  return sum / count;
}

TEST(NormalForceScan, ThreeAxesGiveTheContactForceOfATiltedProbe) {
  for (const double lean : {-0.5, 0.5}) {
    const Recording recording = scan(true, lean);
    const ProcessResult result = process_recording(recording, {});
    EXPECT_EQ(result.base.force.source, ForceSource::kThreeAxes);
    EXPECT_NEAR(mean_found_N(result) / mean_true_N(recording, result), 1.0, 0.02) << lean;
    const SimulatedContactConfig contact = make_simulation_config("sandpaper", "open").contact;
    // The relief itself holds the tip back: the forces' ratio is above the bench's coefficient.
    const double true_friction =
        contact.friction_dynamic + contact.friction_viscous_s_per_m * result.friction.speed_mps;
    EXPECT_GT(result.base.force.tangential_share, true_friction);
    EXPECT_TRUE(result.friction.determined) << result.friction.verdict;
    EXPECT_LT(result.friction.low, true_friction);
    EXPECT_GT(result.friction.high, true_friction);
    EXPECT_NEAR(result.friction.coefficient, true_friction, 0.04);  // two standard errors
    ASSERT_TRUE(result.texture);
    EXPECT_EQ(result.texture->friction, result.friction.coefficient);
  }
}

TEST(NormalForceScan, AnAxialReadingIsCorrectedByTheAngle) {
  for (const double lean : {-0.5, 0.5}) {
    const Recording recording = scan(false, lean);
    const ProcessResult result = process_recording(recording, {});
    EXPECT_EQ(result.base.force.source, ForceSource::kCorrectedAxial);
    const double true_N = mean_true_N(recording, result);
    const double off = mean_found_N(result) / true_N - 1.0;
    EXPECT_LT(std::abs(off), 2.0 * result.base.force.relative_sigma + 0.02) << lean;
    // What was read, by the share that was divided out.
    EXPECT_GT(std::abs(result.base.force.share - 1.0), 0.0);
  }
}

TEST(NormalForceScan, OtherForcesOfThreeAxesGiveAnotherProfile) {
  Recording recording = scan(true, 0.3);
  const ProcessResult before = process_recording(recording, {});
  for (Eigen::Vector3d& counts : recording.probe.force3_counts)
    counts = 1.2 * (counts - recording.calibration.force3->C) + recording.calibration.force3->C;
  const ProcessResult after = process_recording(recording, {});
  EXPECT_NEAR(mean_found_N(after) / mean_found_N(before), 1.2, 0.01);
}

// A force that was larger than the sensor reads shows too small a softness: none is stated, and the heights stay.
TEST(NormalForceScan, AForceBeyondTheSensorsRangeGivesNoCompliance) {
  SimulationConfig config = make_simulation_config("sandpaper", "open");
  config.seed = 4;
  config.hand.length_m = 0.05;
  config.hand.force = HandForce::kRamp;
  config.calibration.imperfection = 0.0;
  Recording recording = simulate_recording(config);
  const ProcessResult before = process_recording(recording, {});
  EXPECT_FALSE(before.force_limit.is_limited());
  EXPECT_TRUE(std::isfinite(before.compliance.k_c_stderr));
  const ForceCalibration& force = recording.calibration.force;
  constexpr double kLimit_N = 1.2;
  const double limit_counts = std::floor((kLimit_N - force.offset_newton) / force.newton_per_count);
  for (double& counts : recording.probe.force_counts) {
    if (counts > limit_counts) counts = limit_counts;
  }
  const ProcessResult after = process_recording(recording, {});
  EXPECT_NEAR(after.force_limit.limit_N, kLimit_N, force.newton_per_count);
  EXPECT_GT(after.force_limit.share(), 0.2);
  for (const double value : {after.compliance.k_c, after.compliance.k_c_stderr, after.stiffness.lower_bound_N_per_mm,
                             after.friction.coefficient})
    EXPECT_TRUE(std::isnan(value));
  EXPECT_NE(after.stiffness.verdict.find("end of its range"), std::string::npos);
  EXPECT_TRUE(std::any_of(after.verdicts.begin(), after.verdicts.end(), [](const Verdict& v) {
    return v.code == "force_clipped" && v.severity == Severity::kLimited;
  }));
  EXPECT_NEAR(after.roughness->Rq_m, before.roughness->Rq_m, 0.02 * before.roughness->Rq_m);
}

// A hand that rests eight times and goes on: each time the tip has to break away.
Recording scan_with_rests(bool three_axes) {
  SimulationConfig config = make_simulation_config("sandpaper", "open");
  config.seed = 6;
  config.hand.pauses = 8;
  config.hand.pause_s = 0.3;
  config.contact.friction_static = 0.5;
  config.contact.friction_dynamic = 0.3;
  config.probe.force3 = three_axes;
  config.calibration.imperfection = 0.0;
  return simulate_recording(config);
}

TEST(NormalForceScan, RestsGiveTheRatioOfStickingToSliding) {
  const ProcessResult result = process_recording(scan_with_rests(true), {});
  ASSERT_TRUE(result.friction.determined) << result.friction.verdict;
  EXPECT_GE(result.friction.sticks, 3U);
  ASSERT_TRUE(std::isfinite(result.friction.breakaway));
  const double true_ratio = 0.5 / (0.3 + 0.2 * result.friction.speed_mps);
  // The sensor's pole of some milliseconds sees the peak late: what is measured is a lower bound.
  EXPECT_GT(result.friction.static_ratio, 1.0 + result.friction.static_ratio_stderr);
  EXPECT_LT(result.friction.static_ratio, true_ratio + 2.0 * result.friction.static_ratio_stderr);
  ASSERT_TRUE(result.texture);
  EXPECT_EQ(result.texture->static_friction_ratio, result.friction.static_ratio);
}

TEST(NormalForceScan, OneAxisOfForceMeasuresNoFriction) {
  const ProcessResult result = process_recording(scan_with_rests(false), {});
  EXPECT_EQ(result.friction.verdict.rfind("not measured", 0), 0U) << result.friction.verdict;
  EXPECT_TRUE(std::isnan(result.friction.static_ratio));
  ASSERT_TRUE(result.texture);
  EXPECT_FALSE(result.texture->friction || result.texture->static_friction_ratio);
}

}  // namespace
}  // namespace asperity
