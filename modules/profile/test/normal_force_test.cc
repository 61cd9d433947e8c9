#include "asperity/profile/normal_force.h"

#include <gtest/gtest.h>

#include <cmath>

#include "asperity/base/error.h"

namespace asperity {
namespace {

using Eigen::Vector3d;

// A plane z = 0 rubbed along +x at 40 mm/s with a known normal force and Coulomb's friction; the probe's axis leans
// in the plane of travel.
struct Rub {
  static constexpr double kNormal_N = 1.3;
  TipMotion motion;
  BasePath path;
  std::vector<char> contact;
  std::vector<double> axial_N;
  Vector3d axis_in_marker;

  Rub(double lean_rad, double friction, bool three_axes) {
    const Eigen::Quaterniond q(Eigen::AngleAxisd(0.7, Vector3d(1.0, -2.0, 0.5).normalized()));
    const Vector3d axis(std::sin(lean_rad), 0.0, std::cos(lean_rad));
    axis_in_marker = q.conjugate() * axis;
    const Vector3d force_N(-friction * kNormal_N, 0.0, kNormal_N);
    for (int i = 0; i < 200; ++i) {
      motion.t_ns.push_back(1'000'000 * i);
      motion.p_world_tip_m.emplace_back(4e-5 * i, 0.0, 0.0);
      motion.v_world_tip_mps.emplace_back(0.04, 0.0, 0.0);
      motion.q_world_marker.push_back(q);
      if (three_axes) motion.force_world_N.push_back(force_N);
      path.p_world_m.push_back(motion.p_world_tip_m.back());
      path.n_world.emplace_back(0.0, 0.0, 1.0);
      path.s_m.push_back(4e-5 * i);
      contact.push_back(1);
      axial_N.push_back(axis.dot(force_N));
    }
  }
};

TEST(NormalForce, ThreeAxesGiveItWhateverTheAngleAndTheFriction) {
  for (const double lean : {-0.6, 0.0, 0.6}) {
    const Rub rub(lean, 0.4, true);
    const NormalForce found =
        find_normal_force(rub.motion, rub.axial_N, rub.path, rub.contact, rub.axis_in_marker, 0.0);
    EXPECT_EQ(found.source, ForceSource::kThreeAxes);
    for (const double force : found.force_N) ASSERT_NEAR(force, Rub::kNormal_N, 1e-12);
    EXPECT_NEAR(found.tangential_share, 0.4, 1e-9);
  }
}

TEST(NormalForce, TheAxialReadingIsCorrectedByTheAngle) {
  for (const double lean : {-0.6, 0.0, 0.6}) {
    // The direction of travel counts for 40/hypot(40, 5) at 40 mm/s.
    const Rub rub(lean, FrictionAssumption{}.coefficient * 40.0 / std::hypot(40.0, 5.0), false);
    const NormalForce found =
        find_normal_force(rub.motion, rub.axial_N, rub.path, rub.contact, rub.axis_in_marker, 0.0);
    EXPECT_EQ(found.source, ForceSource::kCorrectedAxial);
    for (const double force : found.force_N) ASSERT_NEAR(force, Rub::kNormal_N, 1e-12);
  }
}

TEST(NormalForce, TheStatedErrorIsThatOfAnotherFriction) {
  const FrictionAssumption assumed;
  for (const double lean : {-0.5, 0.5}) {
    for (const double sigmas : {-1.0, 1.0}) {
      const double travel = 40.0 / std::hypot(40.0, 5.0);
      const Rub rub(lean, (assumed.coefficient + sigmas * assumed.sigma) * travel, false);
      const NormalForce found =
          find_normal_force(rub.motion, rub.axial_N, rub.path, rub.contact, rub.axis_in_marker, 0.0);
      const double relative = found.force_N.front() / Rub::kNormal_N - 1.0;
      EXPECT_NEAR(std::abs(relative), found.relative_sigma, 1e-9) << lean << " " << sigmas;
      EXPECT_GT(found.relative_sigma, 0.03);
    }
  }
}

TEST(NormalForce, AProbeThatLiesFlatKeepsItsReading) {
  const Rub rub(1.5, 0.2, false);
  const NormalForce found = find_normal_force(rub.motion, rub.axial_N, rub.path, rub.contact, rub.axis_in_marker, 0.0);
  EXPECT_EQ(found.source, ForceSource::kAxial);
  EXPECT_EQ(found.force_N, rub.axial_N);
  EXPECT_TRUE(std::isnan(found.relative_sigma));
}

TEST(NormalForce, WithoutASensorThereIsNone) {
  Rub rub(0.2, 0.2, false);
  rub.axial_N.assign(rub.axial_N.size(), kNan);
  EXPECT_EQ(find_normal_force(rub.motion, rub.axial_N, rub.path, rub.contact, rub.axis_in_marker, 0.0).source,
            ForceSource::kNone);
  rub.axial_N.pop_back();
  EXPECT_THROW(find_normal_force(rub.motion, rub.axial_N, rub.path, rub.contact, rub.axis_in_marker, 0.0), Error);
}

}  // namespace
}  // namespace asperity
