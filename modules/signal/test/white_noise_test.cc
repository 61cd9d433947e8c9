#include "asperity/signal/white_noise.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "asperity/base/random.h"

namespace asperity {
namespace {

// A hand's motion of centimetres with white noise of known size.
std::vector<Eigen::Vector3d> noisy_motion(const std::vector<double>& t_s, const Eigen::Vector3d& sigma) {
  Random random(5);
  std::vector<Eigen::Vector3d> out;
  for (const double t : t_s) {
    Eigen::Vector3d noise;
    for (int axis = 0; axis < 3; ++axis) noise[axis] = sigma[axis] * random.normal();
    out.push_back(Eigen::Vector3d(0.05 * std::sin(5.0 * t), 0.03 * std::sin(9.0 * t), 0.1 * t) + noise);
  }
  return out;
}

std::vector<double> even_times(std::size_t rows) {
  std::vector<double> out;
  for (std::size_t i = 0; i < rows; ++i) out.push_back(static_cast<double>(i) / 120.0);
  return out;
}

TEST(WhiteNoise, IsThatWhichWasAddedToAMotion) {
  const Eigen::Vector3d sigma(0.15e-3, 0.13e-3, 0.54e-3);
  const std::vector<double> t_s = even_times(4000);
  const Eigen::Vector3d found = white_noise(t_s, noisy_motion(t_s, sigma));
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(found[axis] / sigma[axis], 1.0, 0.06) << axis;
}

TEST(WhiteNoise, IsNotMovedByAFewOutliersAndGaps) {
  const Eigen::Vector3d sigma = Eigen::Vector3d::Constant(1e-4);
  std::vector<double> t_s = even_times(4000);
  for (std::size_t i = 2000; i < t_s.size(); ++i) t_s[i] += 3.0;
  std::vector<Eigen::Vector3d> x = noisy_motion(t_s, sigma);
  for (std::size_t i = 300; i < x.size(); i += 500) x[i].x() += 0.1;
  EXPECT_NEAR(white_noise(t_s, x).x() / 1e-4, 1.0, 0.08);
}

TEST(WhiteNoise, IsZeroForTooFewRowsAndForNone) {
  const std::vector<double> t_s = even_times(20);
  EXPECT_EQ(white_noise(t_s, noisy_motion(t_s, Eigen::Vector3d::Ones())), Eigen::Vector3d::Zero());
  EXPECT_EQ(white_noise({}, std::vector<Eigen::Vector3d>{}), Eigen::Vector3d::Zero());
}

}  // namespace
}  // namespace asperity
