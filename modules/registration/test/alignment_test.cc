#include <limits>
#include <numbers>

#include <gmock/gmock.h>

#include "asperity/base/error.h"
#include "asperity/registration/manual_alignment.h"
#include "test_surfaces.h"

namespace asperity {
namespace {

using test::normal3;

constexpr double kRounding_m = 1e-14;  // of coordinates below 1 m

std::vector<Eigen::Vector3d> cloud(std::size_t count) {
  Random random(3);
  std::vector<Eigen::Vector3d> out;
  for (std::size_t i = 0; i < count; ++i) out.push_back(0.1 * normal3(random));
  return out;
}

TEST(AbsoluteOrientation, FindsAKnownMotion) {
  const Pose T{exp_rotation({0.4, -2.0, 1.1}), {0.1, 0.2, -0.3}};
  const auto a = cloud(20);
  std::vector<Eigen::Vector3d> b;
  for (const auto& p : a) b.push_back(T * p);
  const AbsoluteOrientation got = absolute_orientation(a, b);
  EXPECT_LT(got.rms_m, kRounding_m);
  EXPECT_LT(log_rotation(got.T_b_a.rotation * T.rotation.conjugate()).norm(), 1e-13);
  EXPECT_FALSE(got.collinear);
}

TEST(AbsoluteOrientation, IsNeverAMirrorImage) {
  const auto a = cloud(20);
  std::vector<Eigen::Vector3d> b;
  for (const auto& p : a) b.emplace_back(-p.x(), p.y(), p.z());
  const Eigen::Matrix3d r = absolute_orientation(a, b).T_b_a.rotation.toRotationMatrix();
  EXPECT_NEAR(r.determinant(), 1.0, 1e-12);
}

TEST(AbsoluteOrientation, ThreePairsInAPlaneAreEnough) {
  const Pose T{exp_rotation({0.0, 3.0, 0.5}), {0.0, 0.0, 1.0}};
  const std::vector<Eigen::Vector3d> a{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}};
  const std::vector<Eigen::Vector3d> b{T * a[0], T * a[1], T * a[2]};
  EXPECT_LT(log_rotation(absolute_orientation(a, b).T_b_a.rotation * T.rotation.conjugate()).norm(), 1e-13);
}

TEST(AbsoluteOrientation, WeightsCountAsOften) {
  auto a = cloud(6);
  auto b = cloud(12);
  b.resize(6);
  std::vector<double> weights{1, 2, 0, 1, 1, 1};
  const AbsoluteOrientation weighted = absolute_orientation(a, b, weights);
  a.push_back(a[1]);
  b.push_back(b[1] = b[1] + Eigen::Vector3d(0.01, 0, 0));
  b[6] = b[1];
  a.erase(a.begin() + 2);
  b.erase(b.begin() + 2);
  b[1] = b[5] = b[1] - Eigen::Vector3d(0.01, 0, 0);
  const AbsoluteOrientation repeated = absolute_orientation(a, b);
  EXPECT_LT(log_rotation(weighted.T_b_a.rotation * repeated.T_b_a.rotation.conjugate()).norm(), 1e-12);
  EXPECT_NEAR(weighted.rms_m, repeated.rms_m, 1e-14);
}

TEST(AbsoluteOrientation, FlagsALineAndRefusesWhatCannotBe) {
  const std::vector<Eigen::Vector3d> line{{0, 0, 0}, {1, 1, 0}, {2, 2, 0}};
  const std::vector<Eigen::Vector3d> other{{0, 0, 1}, {0, std::numbers::sqrt2, 1}, {0, 2 * std::numbers::sqrt2, 1}};
  const AbsoluteOrientation got = absolute_orientation(line, other);
  EXPECT_TRUE(got.collinear);
  EXPECT_LT(got.rms_m, kRounding_m);
  EXPECT_THROW(align_picked(line, other), Error);
  EXPECT_THROW(absolute_orientation(cloud(2), cloud(2)), Error);
  EXPECT_THROW(absolute_orientation(cloud(3), cloud(4)), Error);
  auto bad = cloud(4);
  bad[2].y() = std::numeric_limits<double>::quiet_NaN();
  try {
    absolute_orientation(bad, cloud(4));
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("pair 2"));
  }
  const std::vector<Eigen::Vector3d> same(4, Eigen::Vector3d::Ones());
  EXPECT_THROW(absolute_orientation(same, cloud(4)), Error);
}

TEST(ManualAlignment, TurnsAboutXThenTheNewYThenTheNewZ) {
  const ManualAlignment six{{1.0, 2.0, 3.0}, {30.0, -40.0, 70.0}};
  const Pose T = align_manually(six);
  constexpr double kDegree = std::numbers::pi / 180.0;
  Eigen::Matrix3d rx, ry, rz;
  rx << 1, 0, 0, 0, std::cos(30 * kDegree), -std::sin(30 * kDegree), 0, std::sin(30 * kDegree), std::cos(30 * kDegree);
  ry << std::cos(40 * kDegree), 0, -std::sin(40 * kDegree), 0, 1, 0, std::sin(40 * kDegree), 0, std::cos(40 * kDegree);
  rz << std::cos(70 * kDegree), -std::sin(70 * kDegree), 0, std::sin(70 * kDegree), std::cos(70 * kDegree), 0, 0, 0, 1;
  EXPECT_LT((T.rotation.toRotationMatrix() - rx * ry * rz).norm(), 1e-14);
  EXPECT_EQ(T.translation_m, Eigen::Vector3d(1, 2, 3));
  const ManualAlignment back = manual_alignment(T);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(back.rotation_deg[k], six.rotation_deg[k], 1e-11);
}

TEST(ManualAlignment, SixNumbersSurviveTheMiddleTurnOf90Degrees) {
  const Pose T = align_manually({{0, 0, 0}, {20.0, 90.0, 35.0}});
  const Pose again = align_manually(manual_alignment(T));
  EXPECT_LT(T.rotation.angularDistance(again.rotation), 1e-7);
  EXPECT_THROW(align_manually({{0, std::numeric_limits<double>::infinity(), 0}, {}}), Error);
}

}  // namespace
}  // namespace asperity
