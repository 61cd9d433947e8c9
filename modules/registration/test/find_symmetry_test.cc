#include "asperity/registration/find_symmetry.h"

#include <numbers>

#include <gtest/gtest.h>

#include "symmetric_bodies.h"
#include "test_surfaces.h"

namespace asperity {
namespace {

using test::Body;
using test::prism_mesh;

Pose about_z(double angle_rad) { return {exp_rotation(angle_rad * Eigen::Vector3d::UnitZ()), Eigen::Vector3d::Zero()}; }

TEST(FindSymmetry, APrismMapsOntoItselfByAThirdOfATurn) {
  const Body prism(prism_mesh(3, 40e-3, 60e-3));
  const double third = 2.0 * std::numbers::pi / 3.0;
  // From 2° and 1 mm off, the motion itself is found.
  Pose near = about_z(third + 0.035);
  near.translation_m = Eigen::Vector3d(0.7e-3, -0.5e-3, 0.4e-3);
  const auto found = find_symmetry(prism.surface, near, 0.0);
  ASSERT_TRUE(found.has_value());
  EXPECT_LT(rotation_between_rad(*found, about_z(third)), 1e-5);
  EXPECT_LT(found->translation_m.norm(), 1e-6);
}

TEST(FindSymmetry, NoOtherAngleOfAPrismIsOne) {
  const Body prism(prism_mesh(3, 40e-3, 60e-3));
  // 60°: a triangle upside down; the fit from there ends elsewhere or finds nothing.
  const auto found = find_symmetry(prism.surface, about_z(std::numbers::pi / 3.0), 0.0);
  if (found) {
    EXPECT_GT(rotation_between_rad(*found, about_z(std::numbers::pi / 3.0)), 0.5);
  }
}

TEST(FindSymmetry, EachRotationOfASphereIsOne) {
  const Body sphere(test::sphere_mesh(35e-3, 0.0));
  const Pose any{exp_rotation({0.7, -1.1, 0.4}), Eigen::Vector3d::Zero()};
  const auto found = find_symmetry(sphere.surface, any, 0.0);
  ASSERT_TRUE(found.has_value());
  EXPECT_LT(rotation_between_rad(*found, any), 0.02);
}

TEST(FindSymmetry, ABumpOfTwoMillimetresEndsTheSpheresSymmetry) {
  const Body bumped(test::sphere_mesh(35e-3, 2e-3));
  const Pose any{exp_rotation({0.7, -1.1, 0.4}), Eigen::Vector3d::Zero()};
  const auto found = find_symmetry(bumped.surface, any, 0.0);
  if (found) {
    EXPECT_GT(rotation_between_rad(*found, any), 0.2);
  }
}

TEST(FindSymmetry, ABodyWithoutSymmetryHasTheIdentityAlone) {
  const auto found = find_symmetry(test::bumpy_body().surface, about_z(std::numbers::pi), 0.0);
  EXPECT_FALSE(found.has_value());
  const auto identity = find_symmetry(test::bumpy_body().surface, about_z(0.02), 0.0);
  ASSERT_TRUE(identity.has_value());
  EXPECT_LT(rotation_between_rad(*identity, Pose{}), 1e-4);
}

}  // namespace
}  // namespace asperity
