#include "asperity/profile/make_profile_thesis.h"

#include <gtest/gtest.h>
#include <cmath>

#include "asperity/base/error.h"
#include "asperity/signal/statistics.h"

namespace asperity {
namespace {

constexpr double kPitch_m = 1e-3;  // one cycle a millimetre, well above the cut-off
constexpr double kAmplitude_m = 40e-6;
constexpr double kSpeed_mps = 0.02;

struct Scan {
  TipMotion motion;
  BasePath base;
};

// A tip that goes along x at 20 mm/s over a sine, with exact accelerations, sampled every 2 ms (25 a wave). It rests
// in the middle for `rest_s`.
Scan sine_scan(double rest_s) {
  Scan scan;
  const Eigen::Vector3d n(0.0, -0.6, 0.8);
  const double omega = 2.0 * M_PI * kSpeed_mps / kPitch_m;
  double moved_s = 0.0;
  const auto rest = static_cast<int>(rest_s / 0.002);
  for (int i = 0; i < 2000 + rest; ++i) {
    const bool moving = i < 1000 || i >= 1000 + rest;
    const double x_m = kSpeed_mps * moved_s;
    const double slow = moving ? 1.0 : 0.0;
    scan.motion.t_ns.push_back(2'000'000LL * i);
    scan.motion.p_world_tip_m.push_back(x_m * Eigen::Vector3d::UnitX());
    scan.motion.q_world_marker.push_back(Eigen::Quaterniond::Identity());
    scan.motion.v_world_tip_mps.push_back(slow * kSpeed_mps * Eigen::Vector3d::UnitX());
    scan.motion.a_world_tip_mps2.push_back(-slow * kAmplitude_m * omega * omega * std::sin(omega * moved_s) * n);
    scan.motion.force_N.push_back(1.0);
    scan.base.p_world_m.push_back(scan.motion.p_world_tip_m.back());
    scan.base.n_world.push_back(n);
    scan.base.s_m.push_back(x_m);
    if (moving) moved_s += 0.002;
  }
  return scan;
}

TEST(MakeProfileThesis, RecoversASine) {
  const Scan scan = sine_scan(0.0);
  const ThesisProfileResult result = make_profile_thesis(scan.motion, scan.base, {});
  const Profile& profile = result.profile;
  EXPECT_NEAR(result.length_m, 1999 * 0.002 * kSpeed_mps, 1e-9);
  EXPECT_EQ(result.slow_samples, 0u);
  ASSERT_EQ(profile.size(), profile.texture_m.size());
  EXPECT_NEAR(profile.s_m[1] - profile.s_m[0], 0.025e-3, 1e-15);
  // The high-pass leaves 1/(1 + (0.802·0.4)⁴) = 0.9895 of one cycle a millimetre; Verlet's gain at 25 samples
  // a wave is 1.0053; interpolation between them takes at most 0.8 %, at the middle of a segment.
  const double pass = 1.0 / (1.0 + (std::sqrt(2.0) - 1.0) * std::pow(0.4, 4));
  const double step_rad = 2.0 * M_PI * kSpeed_mps / kPitch_m * 0.002;
  const double gain = pass * std::pow(0.5 * step_rad / std::sin(0.5 * step_rad), 2);
  for (std::size_t i = 200; i + 200 < profile.size(); ++i) {
    const double expected = gain * kAmplitude_m * std::sin(2.0 * M_PI * profile.s_m[i] / kPitch_m);
    EXPECT_NEAR(profile.texture_m[i], expected, 0.3e-6) << profile.s_m[i];
    EXPECT_NEAR(profile.speed_mps[i], kSpeed_mps, 1e-12);
    EXPECT_TRUE(std::isnan(profile.sigma_m[i]));
  }
}

TEST(MakeProfileThesis, ARestIsDroppedAndDoesNotShiftWhatFollows) {
  const Scan scan = sine_scan(0.5);
  const ThesisProfileResult result = make_profile_thesis(scan.motion, scan.base, {});
  EXPECT_EQ(result.slow_samples, 250u);
  EXPECT_EQ(result.samples, 2250u);
  EXPECT_NEAR(result.length_m, 1999 * 0.002 * kSpeed_mps, 1e-9);
  const auto gap = static_cast<std::size_t>(0.04 / 0.025e-3);
  EXPECT_TRUE(std::isnan(result.profile.texture_m[gap]) || std::isnan(result.profile.texture_m[gap - 1]));
  EXPECT_FALSE(std::isnan(result.profile.texture_m[gap - 100]));
}

TEST(MakeProfileThesis, ForceRampScalesTheAmplitude) {
  Scan scan = sine_scan(0.0);
  for (std::size_t i = 0; i < scan.motion.size(); ++i) scan.motion.force_N[i] = 1.0 + 1e-3 * static_cast<double>(i);
  ThesisProfileConfig config;
  const auto scaled = make_profile_thesis(scan.motion, scan.base, config).profile.texture_m;
  config.scale_by_force = false;
  const auto plain = make_profile_thesis(scan.motion, scan.base, config).profile.texture_m;
  const auto part = [](const std::vector<double>& x, double begin, double end) {
    const auto n = static_cast<double>(x.size());
    return rms(std::span(x).subspan(static_cast<std::size_t>(begin * n), static_cast<std::size_t>((end - begin) * n)));
  };
  EXPECT_NEAR(part(scaled, 0.15, 0.25) / part(plain, 0.15, 0.25), 1.3, 0.02);
  EXPECT_NEAR(part(scaled, 0.75, 0.85) / part(plain, 0.75, 0.85), 0.7, 0.02);
}

TEST(MakeProfileThesis, RejectsWhatItCannotUse) {
  Scan scan = sine_scan(0.0);
  ThesisProfileConfig config;
  config.min_speed_mps = 1.0;
  EXPECT_THROW(make_profile_thesis(scan.motion, scan.base, config), Error);
  scan.motion.t_ns[700] += 1;
  EXPECT_THROW(make_profile_thesis(scan.motion, scan.base, {}), Error);
  scan.motion.t_ns[700] -= 1;
  scan.base.n_world.pop_back();
  EXPECT_THROW(make_profile_thesis(scan.motion, scan.base, {}), Error);
}

}  // namespace
}  // namespace asperity
