#include "asperity/trajectory/remove_gravity.h"

#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/geometry/pose.h"

namespace asperity {
namespace {

const Eigen::Vector3d kGravity_world_mps2(0.0, 9.80665, 0.0);

AccelerometerCalibration calibration() {
  AccelerometerCalibration c;
  c.B = (Eigen::Matrix3d() << 5.7, 0.3, -0.1, 0.2, -5.5, 0.4, 0.0, 0.1, 6.1).finished();
  c.C = {110.7, 120.6, 122.1};
  return c;
}

// counts made by the definition: B (a - g) + C in the marker frame (erratum 5).
TEST(RemoveGravity, GivesBackTheWorldsAcceleration) {
  Random random(1);
  const AccelerometerCalibration c = calibration();
  std::vector<Eigen::Vector3d> counts, expected;
  std::vector<Eigen::Quaterniond> q;
  for (int i = 0; i < 100; ++i) {
    q.push_back(exp_rotation({random.normal(), random.normal(), random.normal()}));
    expected.push_back(i < 10 ? Eigen::Vector3d::Zero().eval()
                              : Eigen::Vector3d(random.normal(), random.normal(), 5.0 * random.normal()));
    const Eigen::Vector3d f_marker = q.back().conjugate() * (expected.back() - kGravity_world_mps2);
    counts.push_back(c.B * f_marker + c.C);
  }
  const auto a = remove_gravity(counts, q, c, kGravity_world_mps2);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR((a[i] - expected[i]).norm(), 0.0, 1e-12);
}

// Erratum 4: at 10 degrees of roll the printed rotation of gravity is 3.4 m/s² wrong; ours is not.
TEST(RemoveGravity, RestAtTenDegreesOfRollIsZero) {
  const AccelerometerCalibration c = calibration();
  const Eigen::Quaterniond q = exp_rotation({0.0, 0.0, M_PI / 18.0});
  const Eigen::Vector3d counts = c.B * (q.conjugate() * -kGravity_world_mps2) + c.C;
  EXPECT_NEAR(remove_gravity(std::vector{counts}, std::vector{q}, c, kGravity_world_mps2)[0].norm(), 0.0, 1e-12);
  const Eigen::Vector3d printed = q * kGravity_world_mps2 - q.conjugate() * kGravity_world_mps2;
  EXPECT_NEAR(printed.norm(), 3.4, 0.02);
}

TEST(RemoveGravity, RejectsUnequalStreams) {
  EXPECT_THROW(remove_gravity(std::vector<Eigen::Vector3d>(2), std::vector<Eigen::Quaterniond>(1), calibration(),
                              kGravity_world_mps2),
               Error);
}

}  // namespace
}  // namespace asperity
