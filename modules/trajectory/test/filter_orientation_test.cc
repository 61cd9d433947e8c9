#include "asperity/trajectory/filter_orientation.h"

#include <gtest/gtest.h>
#include <cmath>

#include "asperity/base/error.h"
#include "asperity/geometry/pose.h"

namespace asperity {
namespace {

TEST(FilterOrientation, SignsFollowOneAnother) {
  std::vector<Eigen::Quaterniond> q;
  for (int i = 0; i < 200; ++i) {
    q.push_back(exp_rotation({0.05 * i, 0.0, 0.0}));  // through several half turns
    if (i % 3 == 0) q.back().coeffs() *= -1.0;
  }
  const auto out = make_signs_continuous(q);
  for (std::size_t i = 1; i < out.size(); ++i) {
    EXPECT_GT(out[i].dot(out[i - 1]), 0.9);
    EXPECT_NEAR(out[i].angularDistance(q[i]), 0.0, 1e-7);
  }
}

// After a small step the angle left decays by 1 - K a sample; K solves the scalar Riccati equation.
TEST(FilterOrientation, StepDecaysByTheSteadyGain) {
  const double process = 1e-6;
  const double noise = 2e-5;
  std::vector<Eigen::Quaterniond> q(1000, Eigen::Quaterniond::Identity());
  const double step_rad = 1e-3;
  for (std::size_t i = 500; i < q.size(); ++i) q[i] = exp_rotation({0.0, step_rad, 0.0});
  for (std::size_t i = 0; i < q.size(); i += 2) q[i].coeffs() *= -1.0;
  const auto out = filter_orientation(q, process, noise);
  const double predicted = 0.5 * (process + std::sqrt(process * process + 4.0 * process * noise));
  const double gain = predicted / (predicted + noise);
  for (std::size_t i = 500; i < 520; ++i) {
    const double left = step_rad * std::pow(1.0 - gain, static_cast<double>(i - 499));
    EXPECT_NEAR(out[i].angularDistance(q[i]), left, 1e-8);
    EXPECT_NEAR(out[i].norm(), 1.0, 1e-15);
  }
}

TEST(FilterOrientation, RejectsAnExactMeasurement) {
  EXPECT_THROW(filter_orientation({}, 1e-6, 0.0), Error);
  EXPECT_TRUE(filter_orientation({}, 1e-6, 1e-6).empty());
}

}  // namespace
}  // namespace asperity
