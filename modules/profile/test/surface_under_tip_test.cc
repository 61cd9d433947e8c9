#include "asperity/profile/surface_under_tip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "asperity/base/error.h"
#include "asperity/profile/make_profile.h"

namespace asperity {
namespace {

constexpr double kRate_Hz = 4000.0, kSpeed_mps = 0.02;

// A mass on a spring (resonance f₀, damping ζ) over a sine: in the steady state the tip moves by |H| of the surface,
// H = (1 + 2jζu) / (1 − u² + 2jζu), u = f/f₀.
struct Ride {
  TipMotion motion;
  BasePath base;
  double gain;

  Ride(double f_Hz, double f0_Hz, double damping, double amplitude_m) {
    const double u = f_Hz / f0_Hz, w = 2.0 * std::numbers::pi * f_Hz, d = 2.0 * damping * u;
    gain = std::hypot(1.0, d) / std::hypot(1.0 - u * u, d);
    for (int i = 0; i < 8000; ++i) {
      const double t = i / kRate_Hz, h = amplitude_m * gain * std::sin(w * t);
      motion.t_ns.push_back(static_cast<std::int64_t>(std::llround(1e9 * t)));
      motion.p_world_tip_m.emplace_back(kSpeed_mps * t, 0.0, h);
      motion.v_world_tip_mps.emplace_back(kSpeed_mps, 0.0, 0.0);
      motion.a_world_tip_mps2.emplace_back(0.0, 0.0, -w * w * h);
      motion.q_world_marker.push_back(Eigen::Quaterniond::Identity());
      base.p_world_m.emplace_back(kSpeed_mps * t, 0.0, 0.0);
      base.n_world.emplace_back(0.0, 0.0, 1.0);
      base.s_m.push_back(kSpeed_mps * t);
    }
  }
};

double amplitude(const Profile& profile) {
  double sum = 0.0, count = 0.0;
  for (std::size_t i = profile.size() / 4; i < 3 * profile.size() / 4; ++i) {
    sum += profile.height_m[i] * profile.height_m[i];
    count += 1.0;
  }
  return std::sqrt(2.0 * sum / count);
}

TEST(SurfaceUnderTip, TheGainOfTheContactIsTakenOff) {
  constexpr double kAmplitude_m = 5e-6;
  for (const double f_Hz : {20.0, 40.0, 60.0}) {
    const Ride ride(f_Hz, 240.0, 0.1, kAmplitude_m);
    ProfileConfig config;
    const double tip = amplitude(make_profile(ride.motion, ride.base, {}, config)) / kAmplitude_m;
    config.contact_resonance_Hz = 240.0;
    const double surface = amplitude(make_profile(ride.motion, ride.base, {}, config)) / kAmplitude_m;
    EXPECT_NEAR(tip, ride.gain, 2e-3);
    EXPECT_NEAR(surface, 1.0, 6e-3) << f_Hz << " Hz, tip " << tip;
  }
}

TEST(SurfaceUnderTip, OutOfContactItIsTheTip) {
  const Ride ride(40.0, 200.0, 0.1, 5e-6);
  std::vector<char> contact(ride.motion.size(), 0);
  for (const double above : surface_above_tip_m(ride.motion, ride.base, contact, 200.0)) EXPECT_EQ(above, 0.0);
}

TEST(SurfaceUnderTip, AResonanceBeyondTheSamplingIsRefused) {
  const Ride ride(40.0, 200.0, 0.1, 5e-6);
  EXPECT_THROW(surface_above_tip_m(ride.motion, ride.base, {}, 900.0), Error);
  EXPECT_THROW(surface_above_tip_m(ride.motion, ride.base, {}, 0.0), Error);
}

}  // namespace
}  // namespace asperity
