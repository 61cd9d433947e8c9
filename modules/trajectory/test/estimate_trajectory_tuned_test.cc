#include "asperity/trajectory/estimate_trajectory_tuned.h"

#include <gmock/gmock.h>
#include <cmath>
#include <vector>

#include "asperity/trajectory/estimate_trajectory_raw.h"
#include "hand_motion.h"

namespace asperity {
namespace {

using testing_motion::HandMotion;
using testing_motion::record;
using testing_motion::Sensors;

// A point driven by white acceleration of a known density, seen at uneven times: the model itself.
struct Wanderer {
  std::vector<std::int64_t> t_ns;
  std::vector<Eigen::Vector3d> measured_m;

  Wanderer(double psd, double sigma_m, std::size_t poses, std::uint64_t seed) {
    Random random(seed);
    constexpr int kSteps = 20;  // of the integration, an interval
    Eigen::Vector3d p = Eigen::Vector3d::Zero(), v = Eigen::Vector3d::Zero();
    std::int64_t now_ns = 0;
    const auto three = [&]() -> Eigen::Vector3d { return {random.normal(), random.normal(), random.normal()}; };
    for (std::size_t i = 0; i < poses; ++i) {
      t_ns.push_back(now_ns);
      measured_m.push_back(p + sigma_m * three());
      const std::int64_t interval_ns = 22'000'000 + static_cast<std::int64_t>(4e6 * random.uniform(-1.0, 1.0));
      const double dt = 1e-9 * static_cast<double>(interval_ns) / kSteps;
      for (int k = 0; k < kSteps; ++k) {
        p += dt * v;
        v += std::sqrt(psd * dt) * three();
      }
      now_ns += interval_ns;
    }
  }
};

double nees(const TipMotion& motion, const HandMotion& hand) {
  double sum = 0.0;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const Eigen::Vector3d e = motion.p_world_tip_m[i] - hand.tip(static_cast<double>(motion.t_ns[i]) * 1e-9);
    sum += e.dot(motion.cov_world_tip_m2[i].inverse() * e) / 3.0;
  }
  return sum / static_cast<double>(motion.size());
}

// The likelihood's width: three axes of 1500 poses tell log10 of the density to some 0.05.
TEST(ThesisTuned, FindsTheWhiteAcceleration) {
  for (const double psd : {1e-4, 1e-2, 1.0}) {
    const Wanderer wanderer(psd, 0.3e-3, 1500, 3);
    const double found =
        likeliest_white_acceleration(wanderer.t_ns, wanderer.measured_m, Eigen::Vector3d::Constant(0.3e-3 * 0.3e-3));
    EXPECT_NEAR(std::log10(found), std::log10(psd), 0.15);
  }
}

TEST(ThesisTuned, TheLikelihoodFallsToBothSidesOfTheTruth) {
  const Wanderer wanderer(1e-2, 0.3e-3, 1500, 4);
  const auto at = [&](double psd) {
    return white_acceleration_likelihood(wanderer.t_ns, wanderer.measured_m, Eigen::Vector3d::Constant(0.09e-6), psd);
  };
  EXPECT_GT(at(1e-2), at(1e-3) + 10.0);
  EXPECT_GT(at(1e-2), at(1e-1) + 10.0);
}

TEST(ThesisTuned, LowersTheTrackersNoiseAndStatesWhatIsLeft) {
  HandMotion hand;
  hand.texture_m = 0.0;  // it is not white
  Sensors sensors;
  sensors.rate_Hz = 400.0;
  sensors.latency_prior_s = sensors.latency_s;
  double square = 0.0, tuned_m2 = 0.0, raw_m2 = 0.0;
  for (sensors.seed = 1; sensors.seed <= 3; ++sensors.seed) {
    const Recording recording = record(hand, sensors);
    const TrajectoryResult tuned = estimate_trajectory_tuned(recording, {});
    const TipMotion raw = estimate_trajectory_raw(recording, {}).motion;
    ASSERT_EQ(tuned.motion.cov_world_tip_m2.size(), tuned.motion.size());
    for (const auto* one : {&tuned.motion, &raw}) {
      double sum = 0.0;
      for (std::size_t i = 0; i < one->size(); ++i) {
        sum += (one->p_world_tip_m[i] - hand.tip(static_cast<double>(one->t_ns[i]) * 1e-9)).squaredNorm();
      }
      (one == &raw ? raw_m2 : tuned_m2) += sum / static_cast<double>(one->size());
    }
    square += nees(tuned.motion, hand) / 3.0;
    EXPECT_GT(tuned.metrics.at("white_acceleration_psd"), 1e-7);
  }
  EXPECT_LT(tuned_m2, raw_m2);
  EXPECT_THAT(square, testing::AllOf(testing::Gt(0.5), testing::Lt(1.6)));  // some hundred independent errors
}

TEST(Raw, StatesItsError) {
  HandMotion hand;
  for (const double rate_Hz : {120.0, 45.0, 15.0}) {
    Sensors sensors;
    sensors.rate_Hz = 400.0;
    sensors.tracker_rate_Hz = rate_Hz;
    double square = 0.0;
    for (sensors.seed = 1; sensors.seed <= 3; ++sensors.seed) {
      square += nees(estimate_trajectory_raw(record(hand, sensors), {}).motion, hand) / 3.0;
    }
    // The latency's error of 2 ms is stated with a σ of 4 ms, and poses 22 ms apart give some 100 independent errors.
    EXPECT_THAT(square, testing::AllOf(testing::Gt(0.7), testing::Lt(1.3))) << rate_Hz;
  }
}

TEST(Raw, PassesThroughThePoses) {
  HandMotion hand;
  Sensors sensors;
  sensors.rate_Hz = 400.0;
  const Recording recording = record(hand, sensors);
  const TipMotion motion = estimate_trajectory_raw(recording, {}).motion;
  // At a sample half way between two poses the mean of both.
  const std::int64_t latency_ns = std::llround(recording.calibration.tracker.latency_s * 1e9);
  std::size_t checked = 0;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    for (std::size_t k = 0; k + 1 < recording.tracker.size(); ++k) {
      const std::int64_t a = recording.tracker.t_ns[k] - latency_ns, b = recording.tracker.t_ns[k + 1] - latency_ns;
      if (motion.t_ns[i] < a || motion.t_ns[i] >= b) continue;
      const double u = static_cast<double>(motion.t_ns[i] - a) / static_cast<double>(b - a);
      const Eigen::Vector3d& tip = recording.calibration.tip_in_marker_m;
      const Eigen::Vector3d expected =
          (1.0 - u) * (recording.tracker.T_world_marker[k] * tip) + u * (recording.tracker.T_world_marker[k + 1] * tip);
      ASSERT_LT((motion.p_world_tip_m[i] - expected).norm(), 1e-12);
      ++checked;
    }
  }
  EXPECT_GT(checked, 1000u);
}

}  // namespace
}  // namespace asperity
