#include "asperity/registration/estimate_drift.h"

#include <cmath>

#include <gtest/gtest.h>

#include "asperity/registration/register_path.h"
#include "bumpy_ball.h"

namespace asperity {
namespace {

using Eigen::Vector3d;

const Pose kTruth{Eigen::Quaterniond(Eigen::AngleAxisd(0.4, Vector3d(1, -2, 1).normalized())),
                  Vector3d(0.05, 0.02, -0.3)};

// Means of the logarithms over strokes of 0.1 m with a drift of 20 mm, at the poses to which the strokes fit.
struct Means {
  double log_sigma = 0.0, log_length = 0.0;
};
Means estimate(double slow_m) {
  const MeshSurface surface(bumpy_ball());
  const RegistrationSurface ready = prepare_surface(surface.mesh, surface.bvh);
  constexpr int kTrials = 10;
  Means out;
  for (int trial = 0; trial < kTrials; ++trial) {
    BallStroke stroke;
    stroke.begin_rad = 0.5 * trial;
    stroke.end_rad = stroke.begin_rad + 2.5;
    stroke.slow_m = slow_m;
    MeasuredPath path = stroke_over_ball(surface, kTruth, stroke, 40 + static_cast<std::uint64_t>(trial));
    path.slow_covariance_world_m2.setZero();
    RegistrationConfig search;
    search.starts.when = OtherStarts::kNever;
    const Pose found = register_path({&path, 1}, ready, kTruth, search).T_mesh_world;
    const AssumedDrift drift = estimate_drift(path, ready, found, {}, {});
    out.log_sigma += std::log(drift.sigma_m / slow_m) / kTrials;
    out.log_length += std::log(drift.length_m / 20e-3) / kTrials;
  }
  return out;
}

// A path of five lengths has some five independent values less the pose's six over its bumps: a factor of 1.6 for one
// path, 1.17 for ten; and the size's expected square is above its square.
TEST(EstimateDrift, FindsSizeAndLength) {
  for (const double slow_m : {0.1e-3, 0.3e-3}) {
    const Means means = estimate(slow_m);
    EXPECT_GT(means.log_sigma, -0.35) << slow_m;
    EXPECT_LT(means.log_sigma, 0.6) << slow_m;
    EXPECT_GT(means.log_length, -0.7) << slow_m;
    EXPECT_LT(means.log_length, 0.7) << slow_m;
  }
}

}  // namespace
}  // namespace asperity
