// A method, as docs/architecture.md tells to add one. Its line in process_methods.h is in CMakeLists.txt here.
#include <gmock/gmock.h>
#include <cmath>
#include <string>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/units.h"
#include "asperity/pipeline/process_config.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/pipeline/write_result.h"
#include "asperity/profile/make_profile.h"
#include "asperity/simulation/simulate_recording.h"
#include "asperity/trajectory/synchronise.h"

namespace asperity {
namespace {

// modules/pipeline/src/tracker_method.cc -----------------------------------------------------------------------------

constexpr double kPeriod_s = 0.005;

TrajectoryResult trajectory_of_poses(const Recording& recording, const TrackerMethodConfig& config) {
  if (static_cast<double>(recording.tracker.size()) < config.min_poses) throw Error("tracker: too few poses");
  const Calibration& calibration = recording.calibration;
  const SynchronisedStreams streams =
      synchronise(recording.probe, Outliers{std::vector<bool>(recording.probe.size()), 0}, recording.tracker,
                  calibration.tracker.latency_s, std::llround(kPeriod_s / kNanosecond_s), true);
  TrajectoryResult result;
  TipMotion& motion = result.motion;
  motion.t_ns = streams.t_ns;
  for (const Pose& T_world_marker : streams.T_world_marker) {
    motion.p_world_tip_m.push_back(T_world_marker * calibration.tip_in_marker_m);
    motion.q_world_marker.push_back(T_world_marker.rotation);
  }
  const std::size_t n = motion.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t before = i == 0 ? 0 : i - 1, after = i + 1 < n ? i + 1 : i;
    motion.v_world_tip_mps.push_back((motion.p_world_tip_m[after] - motion.p_world_tip_m[before]) /
                                     (kPeriod_s * static_cast<double>(after - before)));
    motion.force_N.push_back(calibration.force.force_N(streams.force_counts[i]));
  }
  motion.a_world_tip_mps2.assign(n, Eigen::Vector3d::Zero());
  return result;
}

}  // namespace

ProcessMethod TrackerMethod::make_method() {
  ProcessMethod out;
  out.estimate_trajectory = [](const Recording& recording, const ProcessConfig& config, const Observer&) {
    return trajectory_of_poses(recording, config.tracker);
  };
  out.make_profile = [](const ProcessConfig& config, const TipMotion& motion, const BasePathResult& base) {
    return make_profile(motion, base.path, base.contact, config.profile);
  };
  out.estimate_compliance = [](const Recording&, const ProcessConfig&, const TipMotion&, const BasePathResult&) {
    return Compliance{};  // it has no acceleration
  };
  out.high_pass_cycles_per_mm = [](const ProcessConfig& config) { return config.profile.cutoff_cycles_per_mm; };
  out.live_config = [](const ProcessConfig&) { return LiveProfileConfig{}; };
  out.is_same_trajectory = [](const ProcessConfig& a, const ProcessConfig& b) {
    return is_same_config(a.tracker, b.tracker);
  };
  out.is_same_profile = [](const ProcessConfig& a, const ProcessConfig& b) {
    return is_same_config(a.profile, b.profile);
  };
  return out;
}

namespace {

// --------------------------------------------------------------------------------------------------------------------

TEST(AddingAMethod, ItIsAmongTheMethodsWithItsSettings) {
  ProcessConfig config;
  const std::vector<ConfigField> fields = list_fields("", config);
  EXPECT_THAT(find_field(fields, "method").choices, testing::ElementsAre("fused", "thesis", "tracker"));
  EXPECT_THAT(find_field(fields, "method").description, testing::HasSubstr("tracker (the poses alone)"));
  set_field(fields, "tracker.min_poses", "20");
  EXPECT_EQ(config.tracker.min_poses, 20.0);
}

TEST(AddingAMethod, RecordingsAreProcessedByIt) {
  SimulationConfig simulation;
  simulation.hand.length_m = 0.04;
  simulation.tracker.flip_chance = 0.0;
  const Recording recording = simulate_recording(simulation);

  ProcessConfig config;
  set_field(list_fields("", config), "method", "tracker");
  const ProcessResult result = process_recording(recording, config);
  // The stroke is 40 mm long, and the tracker's noise of some 0.5 mm lengthens no path by a tenth.
  EXPECT_NEAR(result.base.length_m, 0.04, 0.004);
  EXPECT_GT(result.profile.size(), 1000u);
  EXPECT_TRUE(std::isnan(result.compliance.k_c));
  EXPECT_THAT(format_result(result, recording, "rec"), testing::HasSubstr(R"("method": "tracker")"));

  // Fewer poses than the setting asks for.
  set_field(list_fields("", config), "tracker.min_poses", "1e6");
  EXPECT_THROW(process_recording(recording, config), Error);
}

}  // namespace
}  // namespace asperity
