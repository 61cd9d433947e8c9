// Which stretches of a recording its noise is learnt from first.

#include "../src/learning_stretches.h"

#include <gtest/gtest.h>
#include <cmath>

#include "asperity/base/random.h"

namespace asperity {
namespace {

using Eigen::Vector3d;
using inertial_smoother::Knot;
using inertial_smoother::Stretch;
using SmootherProblem = inertial_smoother::Problem;

// Samples at 100 Hz and poses at 20 Hz; the force moves between `moves` and `rests`, the poses have ten times the noise
// from `rough` for 14 s.
SmootherProblem recording_of(double length_s, double moves_s, double rests_s, double rough_s) {
  Random random(7);
  SmootherProblem out;
  for (int i = 0; i < static_cast<int>(100.0 * length_s); ++i) {
    Knot knot;
    knot.t = 0.01 * i;
    knot.f = Vector3d(0.0, 0.0, 9.81);
    if (knot.t > moves_s && knot.t < rests_s) knot.f.x() += 3.0 * std::sin(4.0 * knot.t);
    out.knots.push_back(knot);
    if (i % 5 != 0) continue;
    const double sigma_m = knot.t > rough_s && knot.t < rough_s + 14.0 ? 3e-3 : 0.3e-3;
    Pose pose;
    pose.translation_m = Vector3d(random.normal(), random.normal(), random.normal()) * sigma_m;
    out.epochs.push_back({out.knots.size() - 1, static_cast<std::int64_t>(out.poses.size())});
    out.poses.push_back(pose);
  }
  return out;
}

double time_in(const std::vector<Stretch>& stretches, double begin_s, double end_s) {
  double sum = 0.0;
  for (const Stretch& s : stretches) sum += std::max(0.0, std::min(s.end, end_s) - std::max(s.begin, begin_s));
  return sum;
}

TEST(LearningStretches, AShortRecordingHasNone) {
  EXPECT_TRUE(choose_stretches(recording_of(50.0, 10.0, 45.0, 20.0)).empty());
}

TEST(LearningStretches, RestMotionAndAWorseTrackerAreAllInThem) {
  // Of 100 s 40 are at rest, 14 have another noise, wherever these are.
  for (const double rough_s : {3.0, 30.0, 61.0, 84.0}) {
    const std::vector<Stretch> stretches = choose_stretches(recording_of(100.0, 40.0, 100.0, rough_s));
    EXPECT_NEAR(time_in(stretches, 0.0, 101.0), 27.0, 1e-9);
    EXPECT_GE(time_in(stretches, rough_s, rough_s + 14.0), 2.0) << rough_s;
    EXPECT_GE(time_in(stretches, 0.0, 40.0), 6.0) << rough_s;
    EXPECT_GE(time_in(stretches, 40.0, 100.0), 9.0) << rough_s;
  }
}

}  // namespace
}  // namespace asperity
