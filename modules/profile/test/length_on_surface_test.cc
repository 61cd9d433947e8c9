#include "asperity/profile/length_on_surface.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "asperity/base/error.h"

namespace asperity {
namespace {

constexpr double kRadius_m = 0.03;

// `turn` radians round a cylinder and, if `back`, the same way back, s growing on; outside of it or in it.
BasePath round_path(double turn, bool outside, bool back) {
  BasePath out;
  const int n = back ? 4000 : 2000;
  for (int i = 0; i <= n; ++i) {
    const double way = static_cast<double>(i) / 2000.0, share = way <= 1.0 ? way : 2.0 - way;
    const Eigen::Vector3d radial(std::cos(turn * share), std::sin(turn * share), 0.0);
    out.p_world_m.emplace_back(kRadius_m * radial);
    out.n_world.emplace_back(outside ? radial : -radial);
    out.s_m.push_back(way * turn * kRadius_m);
  }
  return out;
}

double length_of(const BasePath& path, double indentation_m) {
  const std::vector<char> contact(path.size(), 1);
  const std::vector<double> indentation(path.size(), indentation_m);
  const std::vector<double> s_m = length_on_surface(path, contact, indentation);
  for (std::size_t i = 1; i < s_m.size(); ++i) EXPECT_GT(s_m[i], s_m[i - 1]) << i;
  EXPECT_EQ(s_m.front(), path.s_m.front());
  return s_m.back();
}

// The tip goes round the radius R, the surface has R + δ; the last step, shorter than 1 mm, is not lengthened, and a
// chord of 1 mm leans by 1/(2 R) from its end's direction: δ/R of 1 mm and (1 mm/R)²/24 of all.
TEST(LengthOnSurface, OfACylinderIsThatOfItsRadius) {
  constexpr double kDeep_m = 0.4e-3;
  for (const bool back : {false, true}) {
    const double turned = (back ? 2.0 : 1.0) * 2.0;
    const double missing_m = (back ? 2.0 : 1.0) * 1e-3 * kDeep_m / kRadius_m + 1e-4 * turned * kDeep_m;
    EXPECT_NEAR(length_of(round_path(2.0, true, back), kDeep_m), turned * (kRadius_m + kDeep_m), missing_m);
    EXPECT_NEAR(length_of(round_path(2.0, false, back), kDeep_m), turned * (kRadius_m - kDeep_m), missing_m);
  }
}

TEST(LengthOnSurface, IsThatOfThePathOnAPlane) {
  BasePath path;
  for (int i = 0; i < 500; ++i) {
    path.p_world_m.emplace_back(1e-4 * i, 0.0, 0.0);
    path.n_world.emplace_back(0.0, 0.0, 1.0);
    path.s_m.push_back(1e-4 * i);
  }
  EXPECT_NEAR(length_of(path, 1e-3), path.s_m.back(), 1e-12);
}

// A force that rises: ∫ δ dθ.
TEST(LengthOnSurface, FollowsTheIndentation) {
  const BasePath path = round_path(2.0, true, false);
  const std::vector<char> contact(path.size(), 1);
  std::vector<double> indentation_m(path.size());
  for (std::size_t i = 0; i < path.size(); ++i) indentation_m[i] = 0.5e-3 * static_cast<double>(i) / 2000.0;
  const std::vector<double> s_m = length_on_surface(path, contact, indentation_m);
  EXPECT_NEAR(s_m[1000] - path.s_m[1000], 0.5 * 1.0 * 0.25e-3, 1e-3 * 0.25e-3 / kRadius_m);
  EXPECT_NEAR(s_m.back() - path.s_m.back(), 0.5 * 2.0 * 0.5e-3, 1e-3 * 0.5e-3 / kRadius_m);
}

TEST(LengthOnSurface, DoesNotTurnBackInsideANarrowHole) {
  EXPECT_NEAR(length_of(round_path(2.0, false, false), 2.0 * kRadius_m), kRadius_m * 2.0 * 0.5, 1e-3);
}

TEST(LengthOnSurface, SizesMustAgree) {
  const BasePath path = round_path(1.0, true, false);
  const std::vector<double> indentation_m(path.size(), 0.0);
  const std::vector<char> contact(path.size() - 1, 1);
  EXPECT_THROW(length_on_surface(path, contact, indentation_m), Error);
}

}  // namespace
}  // namespace asperity
