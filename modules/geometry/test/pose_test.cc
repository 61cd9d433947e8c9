#include "asperity/geometry/pose.h"

#include <gtest/gtest.h>
#include <cmath>

#include "asperity/base/random.h"

namespace asperity {
namespace {

constexpr double kTol = 1e-12;  // a few roundings of numbers near one

Eigen::Vector3d random_vector(Random& random, double scale) {
  return scale * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
}

TEST(Pose, ExpAndLogAreInverse) {
  Random random(1);
  for (const double scale : {1e-12, 1e-6, 1e-3, 0.5}) {
    for (int i = 0; i < 50; ++i) {
      const Eigen::Vector3d phi = random_vector(random, scale);
      EXPECT_NEAR((log_rotation(exp_rotation(phi)) - phi).norm(), 0.0, kTol * (1.0 + phi.norm()));
    }
  }
}

TEST(Pose, ExpAgreesWithAngleAxis) {
  const Eigen::Vector3d axis = Eigen::Vector3d(1, -2, 3).normalized();
  const Eigen::Quaterniond expected(Eigen::AngleAxisd(2.0, axis));
  EXPECT_NEAR(exp_rotation(2.0 * axis).angularDistance(expected), 0.0, kTol);
}

TEST(Pose, SlerpTurnsUniformlyByTheShorterArc) {
  const Eigen::Vector3d axis = Eigen::Vector3d(0.3, 0.4, -1.0).normalized();
  for (const double angle : {1e-9, 1e-3, 0.4, 1.5, 3.0}) {
    const Eigen::Quaterniond a(Eigen::AngleAxisd(0.2, axis));
    Eigen::Quaterniond b(Eigen::AngleAxisd(0.2 + angle, axis));
    b.coeffs() *= -1.0;
    for (const double t : {0.0, 0.25, 0.5, 0.9, 1.0}) {
      const Eigen::Quaterniond expected(Eigen::AngleAxisd(0.2 + t * angle, axis));
      EXPECT_NEAR(log_rotation(slerp(a, b, t) * expected.conjugate()).norm(), 0.0, kTol) << angle << " " << t;
    }
  }
}

TEST(Pose, InverseAndComposition) {
  Random random(2);
  const Pose T_a_b{exp_rotation(random_vector(random, 1.0)), random_vector(random, 1.0)};
  const Pose T_b_c{exp_rotation(random_vector(random, 1.0)), random_vector(random, 1.0)};
  const Eigen::Vector3d p_c = random_vector(random, 1.0);
  EXPECT_NEAR(((T_a_b * T_b_c) * p_c - T_a_b * (T_b_c * p_c)).norm(), 0.0, kTol);
  EXPECT_NEAR((T_a_b.inverse() * (T_a_b * p_c) - p_c).norm(), 0.0, kTol);
}

}  // namespace
}  // namespace asperity
