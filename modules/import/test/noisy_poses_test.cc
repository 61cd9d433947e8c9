// Poses with noise: what they are still compared by, and what is still refused.
#include <gmock/gmock.h>

#include "asperity/base/random.h"
#include "asperity/import/check_streams.h"
#include "asperity/import/pose_noise.h"
#include "known_motion.h"

namespace asperity {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing_import::known_motion;
using Q = Eigen::Quaterniond;

Eigen::Vector3d normal3(Random& random, double sigma) {
  return sigma * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
}

ImportStreams with_noise(ImportStreams streams, double sigma_rad, int seed, double sigma_m = 0.0) {
  Random random(static_cast<std::uint64_t>(seed));
  for (Pose& pose : streams.pose.T_world_body) {
    pose.rotation = exp_rotation(normal3(random, sigma_rad)) * pose.rotation;
    pose.translation_m += normal3(random, sigma_m);
  }
  return streams;
}

// 0.12 of the angles.
ImportStreams gentle_motion() {
  ImportStreams out = known_motion();
  const auto rotation = [](double t) { return exp_rotation(0.12 * log_rotation(testing_import::rotation_at(t))); };
  constexpr double h = 1e-5;
  for (std::size_t i = 0; i < out.pose.size(); ++i)
    out.pose.T_world_body[i].rotation = rotation(1e-9 * static_cast<double>(out.pose.t_ns[i]));
  for (std::size_t i = 0; i < out.rate.size(); ++i) {
    const double t = 1e-9 * static_cast<double>(out.rate.t_ns[i]);
    const Q q = rotation(t);
    out.rate.value[i] = log_rotation(rotation(t - h).conjugate() * rotation(t + h)) / (2.0 * h);
    out.specific_force.value[i] = q.conjugate() * Eigen::Vector3d(0.0, 0.0, 9.81);
  }
  for (Pose& pose : out.pose.T_world_body) pose.translation_m.setZero();
  return out;
}

template <class Change>
ImportStreams changed(ImportStreams streams, Change change) {
  for (Pose& pose : streams.pose.T_world_body) pose.rotation = change(pose.rotation);
  return streams;
}

TEST(NoisyPoses, NoiseIsEstimatedFromThem) {
  for (const double sigma : {0.2e-3, 1e-3, 6e-3}) {
    const PoseNoise noise = estimate_pose_noise(with_noise(known_motion(40.0), sigma, 3, 0.1 * sigma).pose);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(noise.rotation_rad[axis] / sigma, 1.0, 0.08) << sigma;
      EXPECT_NEAR(noise.position_m[axis] / (0.1 * sigma), 1.0, 0.08) << sigma;
    }
  }
}

TEST(NoisyPoses, ShowTheSameRotationAsTheGyroscope) {
  for (const auto& motion : {known_motion(), gentle_motion()}) {
    for (int seed = 1; seed <= 5; ++seed) {
      for (const double sigma : {0.2e-3, 1e-3, 3e-3, 6e-3}) {
        const StreamChecks checks = check_streams(with_noise(motion, sigma, seed));
        EXPECT_THAT(checks.doubts, IsEmpty()) << sigma;
        EXPECT_GT(checks.rate_cosine, 0.93) << sigma;
        EXPECT_NEAR(checks.rate_ratio, 1.0, 0.05) << sigma;
      }
    }
  }
}

TEST(NoisyPoses, AWrongConventionIsRefusedAllTheSame) {
  for (const auto& motion : {known_motion(), gentle_motion()}) {
    for (const double sigma : {0.2e-3, 6e-3}) {
      const ImportStreams right = with_noise(motion, sigma, 7);
      const auto doubts = [](const ImportStreams& streams) { return check_streams(streams).doubts.size(); };
      EXPECT_EQ(doubts(changed(right, [](const Q& q) { return q.conjugate(); })), 1u) << sigma;
      EXPECT_EQ(doubts(changed(right, [](const Q& q) { return Q(q.x(), q.y(), q.z(), q.w()); })), 1u) << sigma;
      EXPECT_EQ(doubts(changed(right, [](const Q& q) { return Q(q.z(), q.w(), q.x(), q.y()); })), 1u) << sigma;
      EXPECT_EQ(doubts(changed(right, [](const Q& q) { return Q(q.w(), q.y(), q.x(), q.z()); })), 1u) << sigma;
      // Degrees read as radians, and the other way.
      EXPECT_EQ(doubts(changed(right, [](const Q& q) { return exp_rotation(57.3 * log_rotation(q)); })), 1u) << sigma;
      // An angle in radians read as degrees: the poses stand almost still.
      EXPECT_EQ(doubts(changed(right, [](const Q& q) { return exp_rotation(log_rotation(q) / 57.3); })), 1u) << sigma;
      ImportStreams counts = right;
      for (auto& rate : counts.rate.value) rate *= 57.3;
      EXPECT_EQ(doubts(counts), 1u) << sigma;
    }
  }
}

TEST(NoisyPoses, ARotationBelowTheirNoiseIsNotJudged) {
  ImportStreams streams = gentle_motion();
  for (auto& T : streams.pose.T_world_body) T.rotation = exp_rotation(0.02 * log_rotation(T.rotation));
  for (auto& rate : streams.rate.value) rate *= 0.02;
  for (auto& f : streams.specific_force.value) f = {0.0, 0.0, 9.81};
  const StreamChecks checks = check_streams(with_noise(streams, 6e-3, 2));
  EXPECT_THAT(checks.doubts, IsEmpty());
  EXPECT_EQ(checks.rate_ratio, 0.0);
  EXPECT_THAT(checks.notes, testing::Contains(HasSubstr("not determined, for the poses' rotation is not above")));
}

// A tag's flips and a gyroscope's offset of 3 °/s.
TEST(NoisyPoses, FlipsAndAnOffsetDoNotMoveTheComparison) {
  ImportStreams streams = with_noise(gentle_motion(), 4e-3, 4, 1e-4);
  for (std::size_t i = 150; i < streams.pose.size(); i += 190) {
    for (std::size_t k = i; k < i + 2; ++k) {
      Q& q = streams.pose.T_world_body[k].rotation;
      q = q * exp_rotation({0.9, 0.1, 0.0});
    }
  }
  for (auto& rate : streams.rate.value) rate += Eigen::Vector3d(0.03, -0.05, 0.02);
  const StreamChecks checks = check_streams(streams);
  for (const ImportDoubt& doubt : checks.doubts) ADD_FAILURE() << doubt.message;
  EXPECT_GT(checks.rate_cosine, 0.93);
}

}  // namespace
}  // namespace asperity
