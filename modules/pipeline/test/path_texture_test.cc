#include "asperity/pipeline/path_texture.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/texture/evaluate_fourier1d.h"

namespace asperity {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

double relief_m(double s_m) {
  return 20e-6 * std::sin(2.0 * std::numbers::pi * s_m / 3.1e-3) +
         10e-6 * std::cos(2.0 * std::numbers::pi * s_m / 0.7e-3);
}

// 40 mm of relief, a rest of 1 mm before it in which the height wanders, and a gap of 1.5 mm.
Profile profile_with_rest() {
  Profile profile;
  for (int i = -40; i <= 1600; ++i) {
    const double s_m = profile.spacing_m * i;
    const bool gap = i > 800 && i < 860, rest = i < 0;
    profile.s_m.push_back(s_m);
    profile.texture_m.push_back(gap ? kNan : rest ? 5e-4 * i / 40.0 : relief_m(s_m));
    profile.speed_mps.push_back(rest ? 1e-4 : 0.025);
  }
  return profile;
}

TEST(PathTexture, HasAtEachPlaceOfThePathWhatWasMeasuredThere) {
  const PathTexture texture = fit_path_texture(profile_with_rest(), {});
  EXPECT_NEAR(texture.start_m, 0.0, 1e-12);
  // The series is fitted with a ridge of 1e-4 and closed over gap and seam: half a micrometre of 31.
  for (double s_m = 0.2e-3; s_m < 39.8e-3; s_m += 0.1e-3) {
    if (s_m > 19.8e-3 && s_m < 21.7e-3) continue;
    EXPECT_NEAR(evaluate_height(texture.series.fit.texture, s_m).height_m, relief_m(s_m), 0.5e-6) << s_m;
  }
  // In the gap it stays within what surrounds it.
  for (double s_m = 20e-3; s_m < 21.5e-3; s_m += 0.05e-3) {
    EXPECT_LT(std::abs(evaluate_height(texture.series.fit.texture, s_m).height_m), 45e-6) << s_m;
  }
}

TEST(PathTexture, ItsPlaceIsTheProfilesAlsoWhereTheStrokeBeginsLater) {
  Profile profile = profile_with_rest();
  for (double& s_m : profile.s_m) s_m += 7.3e-3;
  const PathTexture texture = fit_path_texture(profile, {});
  EXPECT_NEAR(texture.start_m, 7.3e-3, 1e-12);
  for (double s_m = 1e-3; s_m < 19e-3; s_m += 0.1e-3) {
    EXPECT_NEAR(evaluate_height(texture.series.fit.texture, s_m + 7.3e-3).height_m, relief_m(s_m), 0.5e-6) << s_m;
  }
}

TEST(PathTexture, AProfileWithoutHeightsIsRefused) {
  Profile profile = profile_with_rest();
  for (double& height : profile.texture_m) height = kNan;
  EXPECT_THROW(fit_path_texture(profile, {}), Error);
}

}  // namespace
}  // namespace asperity
