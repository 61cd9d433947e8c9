#include "asperity/profile/make_profile.h"

#include <gmock/gmock.h>

#include "asperity/base/error.h"
#include "asperity/profile/compare_profiles.h"
#include "asperity/profile/extract_texture.h"
#include "asperity/profile/find_base_path.h"
#include "asperity/profile/resample_over_path.h"
#include "synthetic_path.h"

namespace asperity {
namespace {

using namespace synthetic;

// A flat path along x with s = x, so that the profile alone is tested.
struct Flat {
  TipMotion motion;
  BasePath base;
  std::vector<double> height_m;
};

Flat make_flat(const std::vector<double>& t_s, const std::vector<double>& s_m,
               const std::function<double(double)>& height) {
  Flat out;
  for (std::size_t i = 0; i < t_s.size(); ++i) {
    const double h = height(s_m[i]);
    out.motion.t_ns.push_back(static_cast<std::int64_t>(std::llround(t_s[i] * 1e9)));
    out.motion.p_world_tip_m.emplace_back(s_m[i], 0.0, h);
    out.motion.q_world_marker.push_back(Eigen::Quaterniond::Identity());
    out.motion.cov_world_tip_m2.push_back(Eigen::Matrix3d(Eigen::Vector3d(1e-8, 1e-8, 4e-12).asDiagonal()));
    out.motion.force_N.push_back(i % 5 == 0 ? 1.0 + 10.0 * s_m[i] : NAN);
    out.base.p_world_m.emplace_back(s_m[i], 0.0, 0.0);
    out.base.n_world.push_back(Eigen::Vector3d::UnitZ());
    out.base.s_m.push_back(s_m[i]);
    out.height_m.push_back(h);
  }
  return out;
}

Flat make_even(double rate_hz, double speed_mps, double duration_s, const std::function<double(double)>& height) {
  std::vector<double> t, s;
  for (int i = 0; i <= static_cast<int>(rate_hz * duration_s); ++i) {
    t.push_back(i / rate_hz);
    s.push_back(speed_mps * t.back());
  }
  return make_flat(t, s, height);
}

TEST(MakeProfile, ReproducesAKnownHeightFromDenseAndSparseSamples) {
  for (const double rate_hz : {400.0, 1000.0, 4000.0, 20000.0}) {
    const auto height = sine(50e-6, 0.5e-3);  // 2 cycles/mm
    const Flat flat = make_even(rate_hz, 0.025, 2.0, height);
    const Profile profile = make_profile(flat.motion, flat.base, {}, {});
    ASSERT_EQ(profile.size(), 2001u);
    for (std::size_t k = 40; k + 40 < profile.size(); ++k) {
      EXPECT_NEAR(profile.s_m[k], 0.025e-3 * static_cast<double>(k), 1e-12);
      // At 400 Hz there are 8 samples a period: the spline's error there is 0.4 % of the amplitude.
      EXPECT_NEAR(profile.height_m[k], height(profile.s_m[k]), rate_hz < 500.0 ? 0.4e-6 : 0.05e-6) << rate_hz;
      EXPECT_NEAR(profile.sigma_m[k], 2e-6, 1e-12);
      EXPECT_NEAR(profile.force_N[k], 1.0 + 10.0 * profile.s_m[k], 1e-6);
      EXPECT_NEAR(profile.speed_mps[k], 0.025, 1e-6);
    }
  }
}

TEST(MakeProfile, KnowsWhereThePathEndsBetweenItsPoints) {
  std::vector<double> t_s, s_m;
  for (int i = 0; i <= 4000; ++i) {
    t_s.push_back(i / 2000.0);
    s_m.push_back(0.011e-3 + 0.025 * t_s.back());
  }
  const Flat flat = make_flat(t_s, s_m, sine(50e-6, 0.5e-3));
  const Profile profile = make_profile(flat.motion, flat.base, {}, {});
  EXPECT_DOUBLE_EQ(profile.from_m, s_m.front());
  EXPECT_DOUBLE_EQ(profile.to_m, s_m.back());
}

// After the stroke the tip creeps by 0.15 mm within half a second, while the height drifts by 75 µm.
TEST(MakeProfile, ACreepAtThePathsEndHasNoHeights) {
  std::vector<double> t_s, s_m;
  for (int i = 0; i <= 5000; ++i) {
    t_s.push_back(i / 2000.0);
    s_m.push_back(t_s.back() < 2.0 ? 0.025 * t_s.back() : 0.05 + 0.3e-3 * (t_s.back() - 2.0));
  }
  Flat flat = make_flat(t_s, s_m, sine(5e-6, 0.5e-3));
  for (std::size_t i = 4000; i < t_s.size(); ++i) flat.motion.p_world_tip_m[i].z() -= 150e-6 * (t_s[i] - 2.0);
  const Profile profile = make_profile(flat.motion, flat.base, {}, {});
  EXPECT_NEAR(profile.to_m, s_m.back(), 1e-9);
  EXPECT_NEAR(profile.crept_last_m, 0.15e-3, 0.021e-3);  // 70 ms of it beside the stroke
  EXPECT_EQ(profile.crept_first_m, 0.0);
  // The texture, and the drift of the 20 ms that stay.
  for (const double height_m : profile.height_m) EXPECT_FALSE(std::abs(height_m) > 8.5e-6) << height_m;
}

TEST(MakeProfile, DetailBeyondTheSpacingDoesNotFold) {
  // 32 cycles/mm would fold to 8 at 40 points a mm.
  const Flat flat = make_even(20000.0, 0.02, 1.0, sine(10e-6, 1e-3 / 32.0));
  const Profile profile = make_profile(flat.motion, flat.base, {}, {});
  for (std::size_t k = 20; k + 20 < profile.size(); ++k) EXPECT_NEAR(profile.height_m[k], 0.0, 0.1e-6);
}

TEST(MakeProfile, LostContactAndWideHolesAreGaps) {
  const Flat flat = make_even(4000.0, 0.025, 2.0, sine(50e-6, 2.5e-3));
  std::vector<char> usable(flat.motion.size(), 1);
  std::fill(usable.begin() + 2000, usable.begin() + 2400, 0);  // 2.5 mm from s = 12.5 mm
  std::fill(usable.begin() + 6000, usable.begin() + 6020, 0);  // 0.125 mm: interpolated
  const Profile profile = make_profile(flat.motion, flat.base, usable, {});
  std::size_t gaps = 0;
  for (std::size_t k = 0; k < profile.size(); ++k) {
    const bool inside = profile.s_m[k] > 12.494e-3 && profile.s_m[k] < 14.99e-3;
    EXPECT_EQ(std::isnan(profile.height_m[k]), inside) << profile.s_m[k];
    EXPECT_EQ(std::isnan(profile.texture_m[k]), inside);
    gaps += inside ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(gaps), 100.0, 1.0);
}

TEST(MakeProfile, AShortStopLeavesNoTraceAndALongOneParts) {
  for (const double stop_s : {0.4, 3.0}) {
    std::vector<double> t, s;
    for (int i = 0; i <= static_cast<int>((2.0 + stop_s) * 2000.0); ++i) {
      t.push_back(i / 2000.0);
      s.push_back(0.025 * (t.back() < 1.0 ? t.back() : std::max(1.0, t.back() - stop_s)));
    }
    Flat flat = make_flat(t, s, sine(50e-6, 2.5e-3));
    // The position's slow error moves by 0.1 mm during the stop.
    for (std::size_t i = 0; i < t.size(); ++i) {
      if (stop_s > 1.0) flat.motion.p_world_tip_m[i].z() += 0.1e-3 * std::clamp((t[i] - 1.0) / stop_s, 0.0, 1.0);
    }
    ProfileConfig config;
    config.cutoff_cycles_per_mm = 0.05;  // 20 mm of each 25 mm run settle its level
    const Profile profile = make_profile(flat.motion, flat.base, {}, config);
    const auto nans =
        std::count_if(profile.height_m.begin(), profile.height_m.end(), [](double h) { return std::isnan(h); });
    EXPECT_EQ(nans, stop_s > 1.0 ? 1 : 0);
    for (std::size_t k = 0; k < profile.size(); ++k) {
      if (std::abs(profile.s_m[k] - 0.025) < 0.4e-3 || profile.s_m[k] < 4e-3 || profile.s_m[k] > 0.046) continue;
      // The step itself would ring by tens of µm; what is left of the ends of two runs is a few.
      EXPECT_NEAR(profile.texture_m[k], sine(50e-6, 2.5e-3)(profile.s_m[k]), 6e-6)
          << stop_s << " at " << profile.s_m[k];
    }
  }
}

TEST(MakeProfile, StepsBackAreAveragedNotFolded) {
  std::vector<double> t, s;
  for (int i = 0; i <= 8000; ++i) {
    t.push_back(i / 4000.0);
    s.push_back(0.025 * t.back() +
                0.6e-3 * std::sin(2.0 * std::numbers::pi * 9.0 * t.back()));  // goes back in every period
  }
  const auto height = sine(50e-6, 1.2e-3);
  const Flat flat = make_flat(t, s, height);
  const Profile profile = make_profile(flat.motion, flat.base, {}, {});
  for (std::size_t k = 40; k + 40 < profile.size(); ++k)
    EXPECT_NEAR(profile.height_m[k], height(profile.s_m[k]), 0.1e-6);
}

TEST(ExtractTexture, IsMinusThreeDecibelsAtTheCutoffAndPassesAGap) {
  std::vector<double> x(8000);
  for (std::size_t k = 0; k < x.size(); ++k)
    x[k] = std::sin(2.0 * std::numbers::pi * 0.1 * 0.025 * static_cast<double>(k));
  const auto amplitude = [](const std::vector<double>& y) {
    double top = 0.0;
    for (std::size_t k = 3000; k < 5000; ++k) top = std::isfinite(y[k]) ? std::max(top, y[k]) : top;
    return top;
  };
  EXPECT_NEAR(amplitude(extract_texture(x, 0.025e-3, 0.1, 2e-3)), std::sqrt(0.5), 1e-3);
  EXPECT_NEAR(amplitude(extract_texture(x, 0.025e-3, 0.0, 2e-3)), 1.0, 1e-3);
  std::fill(x.begin() + 4000, x.begin() + 4010, NAN);
  const std::vector<double> y = extract_texture(x, 0.025e-3, 0.1, 2e-3);
  EXPECT_TRUE(std::isnan(y[4005]));
  EXPECT_NEAR(amplitude(y), std::sqrt(0.5), 2e-3);
  EXPECT_THROW(extract_texture(x, 0.0, 0.1, 0.0), Error);
}

// Of a round body that was taken for flat: a radius of 94 mm over 12.8 mm, which has 0.2 mm of sag.
TEST(ExtractTexture, LeavesOutTheSagOfAShortStrokeOverARoundBody) {
  std::vector<double> round(513), both(513), texture(513);
  for (std::size_t k = 0; k < round.size(); ++k) {
    const double s_m = 0.025e-3 * (static_cast<double>(k) - 256.0);
    round[k] = -s_m * s_m / (2.0 * 0.094);
    texture[k] = 5e-6 * std::sin(2.0 * std::numbers::pi * s_m / 1e-3);
    both[k] = round[k] + texture[k];
  }
  const auto largest = [](const std::vector<double>& x) {
    double out = 0.0;
    for (const double value : x) out = std::max(out, std::abs(value));
    return out;
  };
  EXPECT_LT(largest(extract_texture(round, 0.025e-3, 0.15, 2e-3)), 1e-9);
  std::vector<double> difference = extract_texture(both, 0.025e-3, 0.15, 2e-3);
  for (std::size_t k = 0; k < difference.size(); ++k) difference[k] -= texture[k];
  EXPECT_LT(largest(difference), 1e-6);  // at the ends, where a mirror breaks a sine
}

// s as measure_arc_length gives it: one value in the rests before and after the path.
TEST(MakeProfile, RestsBeforeAndAfterAddNoLengthAndMoveNothing) {
  const auto height = sine(50e-6, 0.8e-3);
  for (const double rest_s : {0.0, 0.3, 3.0}) {
    std::vector<double> t, s;
    for (int i = 0; i <= static_cast<int>((2.0 + 2.0 * rest_s) * 4000.0); ++i) {
      t.push_back(i / 4000.0);
      s.push_back(0.02 * std::clamp(t.back() - rest_s, 0.0, 2.0));
    }
    Flat flat = make_flat(t, s, height);
    // The height's slow error of the rest: 30 µm and gone 50 ms before the stroke begins, or after it ends.
    for (std::size_t i = 0; i < t.size(); ++i) {
      const double away_s = std::max(rest_s - t[i], t[i] - rest_s - 2.0);
      flat.motion.p_world_tip_m[i].z() += away_s > 0.05 ? 30e-6 : 0.0;
    }
    const Profile profile = make_profile(flat.motion, flat.base, {}, {});
    ASSERT_GT(profile.size(), 1000u);
    EXPECT_NEAR(profile.s_m.back() - profile.s_m.front(), 0.04, 1e-12) << rest_s;
    // The first point may lie before the mean of the first samples.
    for (std::size_t k = 1; k < profile.size(); ++k) {
      EXPECT_NEAR(profile.height_m[k], height(profile.s_m[k]), 1.5e-6) << rest_s << " " << k;
    }
  }
}

// 250 km in two samples: 10 billion points.
TEST(MakeProfile, RefusesAPathThatJumpsBeforeItTakesMemory) {
  TipMotion motion;
  BasePath base;
  for (int i = 0; i < 2; ++i) {
    motion.t_ns.push_back(i * 1'000'000LL);
    motion.p_world_tip_m.emplace_back(250e3 * i, 0.0, 0.0);
    base.p_world_m.push_back(motion.p_world_tip_m.back());
    base.n_world.push_back(Eigen::Vector3d::UnitZ());
    base.s_m.push_back(250e3 * i);
  }
  EXPECT_THAT([&] { make_profile(motion, base, {}, {}); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("too many points")));
}

TEST(MakeProfile, WholeWayOverAFlatObjectAndAPot) {
  for (const bool pot : {false, true}) {
    // Three waves within the band; no period fits a shift.
    const auto height = [](double s) {
      return sine(30e-6, 2.5e-3)(s) + sine(20e-6, 1.1e-3)(s) + sine(8e-6, 0.37e-3)(s);
    };
    const Scan scan = make_scan(pot ? across_cylinder(0.045, 0.025, true) : arc_on_plane(0.08, 0.025), height,
                                {.duration_s = 4.0, .slow_sigma_m = 0.03e-3, .fine_sigma_m = 1e-6, .seed = 5});
    const BasePathResult base = find_base_path(scan.motion, scan.tip_in_marker_m, {});
    const Profile profile = make_profile(scan.motion, base.path, base.contact, {});
    ComparisonConfig config;
    config.high_cycles_per_mm = comparison_limit_cycles_per_mm(4000.0, 0.025);
    const ProfileComparison c = compare_profiles(profile.s_m, profile.height_m, scan.s_m, scan.height_m, config);
    EXPECT_GT(c.correlation, 0.97) << pot;
    EXPECT_NEAR(c.gain, 1.0, 0.03) << pot;
    EXPECT_NEAR(c.length_error_percent, 0.0, 0.8) << pot;
  }
}

}  // namespace
}  // namespace asperity
