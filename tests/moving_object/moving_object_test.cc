#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/pipeline/process_session.h"
#include "asperity/pipeline/result_json.h"
#include "asperity/recording/format_recording.h"
#include "asperity/recording/read_recording.h"
#include "asperity/recording/write_recording.h"
#include "asperity/simulation/simulate_recording.h"
#include "asperity/testkit/temp_dir.h"

namespace asperity {
namespace {

// Sandpaper under a slow short stroke, seen by a tracker of several tags (docs/tracking.md: hundredths of a
// millimetre).
SimulationConfig held_sandpaper(SimulatedObjectMotion motion) {
  SimulationConfig out = make_simulation_config("sandpaper", "open");
  out.seed = 5;
  out.hand.length_m = 0.05;
  out.tracker.noise_m = {0.02e-3, 0.02e-3, 0.06e-3};
  out.tracker.noise_rad = {0.6e-3, 0.6e-3, 0.2e-3};
  out.object.motion = motion;
  return out;
}

std::vector<std::string> codes(const ProcessResult& result, Severity severity) {
  std::vector<std::string> out;
  for (const Verdict& verdict : result.verdicts) {
    if (verdict.severity == severity) out.push_back(verdict.code);
  }
  return out;
}

class HeldObject : public testing::TestWithParam<SimulatedObjectMotion> {};

TEST_P(HeldObject, IsScannedAsIfItLayStill) {
  const ProcessResult still =
      process_recording(simulate_recording(held_sandpaper(SimulatedObjectMotion::kNone)), ProcessConfig{});
  const Recording recording = simulate_recording(held_sandpaper(GetParam()));
  const ProcessResult held = process_recording(recording, ProcessConfig{});
  EXPECT_FALSE(still.trajectory.object);
  ASSERT_TRUE(held.trajectory.object);
  EXPECT_THAT(codes(held, Severity::kNote), testing::Contains("object_moved"));
  EXPECT_THAT(codes(held, Severity::kInvalid), testing::IsEmpty());
  EXPECT_EQ(result_json(held, recording, "x")["frame"].text(), "object");
  EXPECT_FALSE(result_json(still, recording, "x").contains("frame"));

  // The stroke is the same one: on the object it is as long, within what is stated.
  const double allowed_m = 3.0 * std::hypot(held.noise.length_stderr_m, still.noise.length_stderr_m);
  EXPECT_NEAR(held.coverage.length_m, still.coverage.length_m, allowed_m + 2e-4);
  const ProfileComparison& p = held.accuracy->profile.value();
  EXPECT_LT(std::abs(p.length_error_percent), 0.5);
  EXPECT_GT(p.correlation, 0.8);
  // The error is as large as it is said to be: one scan's estimate of it, of some ten independent errors.
  EXPECT_GT(held.accuracy->position_error_over_sigma, 0.5);
  EXPECT_LT(held.accuracy->position_error_over_sigma, 1.7);
}

INSTANTIATE_TEST_SUITE_P(Motions, HeldObject,
                         testing::Values(SimulatedObjectMotion::kHeld, SimulatedObjectMotion::kTurned));

TEST(MovingObject, RelativeToTheWorldTheSameScanIsWrong) {
  const Recording recording = simulate_recording(held_sandpaper(SimulatedObjectMotion::kTurned));
  ProcessConfig config;
  config.reference = Reference::kWorld;
  const ProcessResult world = process_recording(recording, config);
  EXPECT_FALSE(world.trajectory.object);
  EXPECT_EQ(world.trajectory.metrics.count("object_moved_m"), 0u);
  config.reference = Reference::kAuto;
  const ProcessResult object = process_recording(recording, config);
  const std::vector<double>& s_m = recording.truth->s_m;
  const double true_m = s_m.back() - s_m.front();
  const double world_m = std::abs(world.base.length_m - true_m), object_m = std::abs(object.base.length_m - true_m);
  EXPECT_GT(world_m, 3.0 * object_m);
}

TEST(MovingObject, AnObjectAtRestInTheCameraIsTheWorldInAnotherFrame) {
  const Recording recording = simulate_recording(held_sandpaper(SimulatedObjectMotion::kNone));
  const ProcessResult world = process_recording(recording, ProcessConfig{});
  // A body that nobody touches, seen without error, in a pose of its own.
  Recording with = recording;
  const Pose T_world_object{exp_rotation({0.3, -0.8, 0.4}), {0.02, 0.05, 0.36}};
  with.info.bodies = {{"object", {}}};
  with.body_poses.emplace_back();
  with.body_poses[0].t_ns = recording.tracker.t_ns;
  with.body_poses[0].T_world_marker.assign(recording.tracker.size(), T_world_object);
  with.truth->T_world_object.assign(with.truth->size(), T_world_object);
  const ProcessResult object = process_recording(with, ProcessConfig{});
  ASSERT_TRUE(object.trajectory.object);
  EXPECT_LT(object.trajectory.metrics.at("object_moved_m"), 1e-6);
  EXPECT_NEAR(object.base.length_m, world.base.length_m, 2e-5);  // that of the profile has steps of 25 µm
  EXPECT_NEAR(object.accuracy->profile->correlation, world.accuracy->profile->correlation, 0.01);
  for (std::size_t i = 0; i < object.trajectory.motion.size(); i += 500) {
    const auto& t_ns = world.trajectory.motion.t_ns;
    const auto k = static_cast<std::size_t>(
        std::lower_bound(t_ns.begin(), t_ns.end(), object.trajectory.motion.t_ns[i]) - t_ns.begin());
    EXPECT_LT(
        (T_world_object * object.trajectory.motion.p_world_tip_m[i] - world.trajectory.motion.p_world_tip_m[k]).norm(),
        1e-6);
  }
}

TEST(MovingObject, ThatIsHiddenOrNeverSeenIsSaid) {
  const Recording whole = simulate_recording(held_sandpaper(SimulatedObjectMotion::kHeld));
  const auto keep = [&](double from, double to) {
    Recording out = whole;
    TrackerStream& poses = out.body_poses[0];
    const auto first = static_cast<std::ptrdiff_t>(from * static_cast<double>(poses.size()));
    const auto last = static_cast<std::ptrdiff_t>(to * static_cast<double>(poses.size()));
    poses.t_ns.erase(poses.t_ns.begin() + first, poses.t_ns.begin() + last);
    poses.T_world_marker.erase(poses.T_world_marker.begin() + first, poses.T_world_marker.begin() + last);
    return out;
  };
  EXPECT_THAT(codes(process_recording(keep(0.6, 0.8), ProcessConfig{}), Severity::kLimited),
              testing::Contains("object_hidden"));
  EXPECT_THAT(codes(process_recording(keep(0.2, 0.95), ProcessConfig{}), Severity::kInvalid),
              testing::Contains("object_unseen"));
  const ProcessResult never = process_recording(keep(0.0, 1.0), ProcessConfig{});
  EXPECT_FALSE(never.trajectory.object);
  EXPECT_THAT(codes(never, Severity::kInvalid), testing::Contains("object_unseen"));
}

TEST(MovingObject, ATrackerThatJittersMakesNoValidTexture) {
  Recording recording = simulate_recording(held_sandpaper(SimulatedObjectMotion::kHeld));
  Random random(1);
  for (Pose& pose : recording.body_poses[0].T_world_marker) {
    pose.translation_m += 3e-3 * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
    pose.rotation =
        exp_rotation(0.05 * Eigen::Vector3d(random.normal(), random.normal(), random.normal())) * pose.rotation;
  }
  const ProcessResult result = process_recording(recording, ProcessConfig{});
  EXPECT_FALSE(result.trustworthy) << result.verdict;
}

TEST(MovingObject, WithoutItsBodyNothingChanges) {
  const Recording recording = simulate_recording(held_sandpaper(SimulatedObjectMotion::kNone));
  EXPECT_TRUE(recording.info.bodies.empty());
  ProcessConfig config;
  config.reference = Reference::kObject;
  EXPECT_THROW(process_recording(recording, config), Error);
}

TEST(MovingObject, ARecordingOfItReadsBackAndProcessesAlike) {
  const testkit::TempDir dir;
  const Recording recording = simulate_recording(held_sandpaper(SimulatedObjectMotion::kHeld));
  write_recording(dir.path(), recording);
  const Recording read = read_recording(dir.path());
  EXPECT_TRUE(read.problems.empty());
  ASSERT_EQ(read.body_poses.size(), 1u);
  EXPECT_EQ(format_tracker_csv(read.body_poses[0]), format_tracker_csv(recording.body_poses[0]));
  EXPECT_EQ(format_truth_csv(*read.truth), format_truth_csv(*recording.truth));

  // A session that is asked twice, and for the world in between, gives what one call gives.
  ProcessSession session(read);
  ProcessConfig world;
  world.reference = Reference::kWorld;
  const std::string once = result_json(process_recording(recording, ProcessConfig{}), recording, "x").dump();
  EXPECT_EQ(result_json(session.process(ProcessConfig{}), read, "x").dump(), once);
  EXPECT_FALSE(session.process(world).trajectory.object);
  EXPECT_EQ(result_json(session.process(ProcessConfig{}), read, "x").dump(), once);
}

}  // namespace
}  // namespace asperity
