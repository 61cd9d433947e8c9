#include "asperity/calibration/calibrate_tip.h"

#include <gmock/gmock.h>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "coverage.h"

namespace asperity {
namespace {

constexpr int kTrials = 200;

using testing::HasSubstr;

constexpr double kRate_Hz = 45.0;

// The tracker's errors of one coordinate: half of the variance remembers, for 0.15 s, half is new in every frame.
class FrameNoise {
 public:
  double next(Random& random) {
    const double memory = std::exp(-1.0 / (0.15 * kRate_Hz));
    state_ = first_ ? random.normal() : memory * state_ + std::sqrt(1.0 - memory * memory) * random.normal();
    first_ = false;
    return std::sqrt(0.5) * (state_ + random.normal());
  }

 private:
  double state_ = 0.0;
  bool first_ = true;
};

struct Swing {
  Eigen::Vector3d tip_m{0.002, -0.004, -0.115};
  Eigen::Vector3d dimple_m{0.05, 0.1, 0.35};
  Eigen::Vector3d amplitude_rad{0.5, 0.45, 0.3};
  double duration_s = 20.0;
  double rest_s = 0.0;       // on the table before
  double slip_m = 0.0;       // out of the dimple for 1.5 s half-way
  double noise_scale = 1.0;  // true noise over the stated one
  double bad_frames = 0.0;   // share of frames far off
  Eigen::Vector3d phase{0.3, 1.9, 4.0};
};

TrackerStream simulate(const Swing& swing, const TrackerCalibration& tracker, Random& random) {
  TrackerStream out;
  std::array<FrameNoise, 6> noise;
  const double total_s = swing.rest_s + 1.0 + swing.duration_s;
  const Eigen::Quaterniond across(Eigen::AngleAxisd(1.4, Eigen::Vector3d::UnitX()));
  for (int frame = 0; frame < static_cast<int>(total_s * kRate_Hz); ++frame) {
    const double t_s = frame / kRate_Hz;
    const double s_s = std::max(t_s - swing.rest_s - 1.0, 0.0);
    const Eigen::Vector3d turn(swing.amplitude_rad.x() * std::sin(2.8 * s_s + swing.phase.x()),
                               swing.amplitude_rad.y() * std::sin(1.9 * s_s + swing.phase.y()),
                               swing.amplitude_rad.z() * std::sin(1.1 * s_s + swing.phase.z()));
    Pose pose;
    pose.rotation = across * exp_rotation(turn);
    Eigen::Vector3d tip_world_m = swing.dimple_m;
    const double since_slip_s = s_s - 0.5 * swing.duration_s;
    if (since_slip_s > 0.0 && since_slip_s < 1.5) tip_world_m.x() += swing.slip_m * std::sin(2.0944 * since_slip_s);
    pose.translation_m = tip_world_m - pose.rotation * swing.tip_m;
    const double raised = std::clamp(t_s - swing.rest_s, 0.0, 1.0);
    if (swing.rest_s > 0.0 && raised < 1.0) {
      const Pose lying{Eigen::Quaterniond(Eigen::AngleAxisd(2.7, Eigen::Vector3d::UnitY())), {-0.1, 0.15, 0.5}};
      pose.rotation = slerp(lying.rotation, pose.rotation, raised);
      pose.translation_m = lerp(lying.translation_m, pose.translation_m, raised);
    }
    Eigen::Vector3d shift_m;
    Eigen::Vector3d tilt_rad;
    for (int axis = 0; axis < 3; ++axis) {
      const auto at = static_cast<std::size_t>(axis);
      shift_m[axis] = swing.noise_scale * tracker.sigma_position_m[axis] * noise[at].next(random);
      tilt_rad[axis] = swing.noise_scale * tracker.sigma_rotation_rad[axis] * noise[at + 3].next(random);
    }
    if (random.chance(swing.bad_frames)) shift_m += Eigen::Vector3d(0.02, -0.01, 0.08);
    pose.translation_m += shift_m;
    pose.rotation = exp_rotation(tilt_rad) * pose.rotation;
    out.t_ns.push_back(static_cast<std::int64_t>(t_s * 1e9));
    out.T_world_marker.push_back(pose);
  }
  return out;
}

std::string message_of(const TrackerStream& poses, const TrackerCalibration& tracker) {
  try {
    calibrate_tip(poses, tracker);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

void recover(const std::string& name, const Swing& kind) {
  test::Coverage coverage;
  const TrackerCalibration tracker;
  CalibrateTipConfig config;
  config.trials = 150;
  for (int trial = 0; trial < kTrials; ++trial) {
    Random random(41, static_cast<std::uint64_t>(trial));
    Swing swing = kind;
    for (int axis = 0; axis < 3; ++axis) {
      swing.tip_m[axis] += random.uniform(-0.01, 0.01);
      swing.phase[axis] = random.uniform(0.0, 6.28);
      swing.dimple_m[axis] += random.uniform(-0.05, 0.05);
    }
    const TipCalibration tip = calibrate_tip(simulate(swing, tracker, random), tracker, config);
    for (int axis = 0; axis < 3; ++axis) {
      const std::string letter(1, "xyz"[axis]);
      coverage.add("tip " + letter, tip.tip_in_marker_m[axis], swing.tip_m[axis], tip.stderr_m[axis]);
      coverage.add("dimple " + letter, tip.dimple_world_m[axis], swing.dimple_m[axis], tip.dimple_stderr_m[axis]);
    }
  }
  coverage.expect(name, kTrials);
}

TEST(CalibrateTip, TwoHundredSwingsWithRestSlipAndBadFramesKeepTheirErrors) {
  Swing swing;
  swing.rest_s = 3.0;
  swing.slip_m = 0.01;
  swing.bad_frames = 0.01;
  recover("tip by pivoting, 20 s at 45 Hz with a rest, a slip and bad frames", swing);
}

TEST(CalibrateTip, TwoHundredSmallSwingsWithMoreNoiseThanStatedKeepTheirErrors) {
  Swing swing;
  swing.amplitude_rad = {0.25, 0.25, 0.1};
  swing.noise_scale = 1.5;
  recover("tip by pivoting, 14° swings, noise 1.5 times as stated", swing);
}

TEST(CalibrateTip, IsExactWithoutNoise) {
  Swing swing;
  swing.noise_scale = 0.0;
  swing.rest_s = 5.0;
  Random random(1);
  const TrackerCalibration tracker;
  CalibrateTipConfig config;
  const TipCalibration tip = calibrate_tip(simulate(swing, tracker, random), tracker, config);
  EXPECT_LT((tip.tip_in_marker_m - swing.tip_m).norm(), 1e-7);
  EXPECT_LT((tip.dimple_world_m - swing.dimple_m).norm(), 1e-7);
}

TEST(CalibrateTip, ALongRestDoesNotOutvoteTheSwing) {
  Swing swing;
  swing.rest_s = 60.0;
  Random random(2);
  const TrackerCalibration tracker;
  const TipCalibration tip = calibrate_tip(simulate(swing, tracker, random), tracker);
  EXPECT_LT((tip.tip_in_marker_m - swing.tip_m).norm(), 5e-4);
  EXPECT_LT(tip.used, tip.poses / 3);
  // Most of the recording is no swing; the tip that came of the rest is right, as the line above says.
  EXPECT_EQ(verdict_word(tip.verdict.verdicts), "limited");
  EXPECT_TRUE(tip.verdict.trustworthy);
  EXPECT_THAT(tip.verdict.text, HasSubstr("record the swing alone"));
}

TEST(CalibrateTip, ASlidingTipIsNotTrusted) {
  Swing swing;
  Random random(3);
  const TrackerCalibration tracker;
  TrackerStream poses = simulate(swing, tracker, random);
  // The tip wanders over 20 mm all the while.
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double t_s = static_cast<double>(poses.t_ns[i]) * 1e-9;
    poses.T_world_marker[i].translation_m += 0.01 * Eigen::Vector3d(std::sin(1.3 * t_s), std::cos(0.9 * t_s), 0.0);
  }
  const TipCalibration tip = calibrate_tip(poses, tracker);
  EXPECT_FALSE(tip.verdict.trustworthy);
}

TEST(CalibrateTip, RefusesSwingsThatLeaveADirectionOpen) {
  const TrackerCalibration tracker;
  Random random(4);
  Swing one_axis;
  one_axis.amplitude_rad = {0.0, 0.6, 0.0};
  const std::string about_y = message_of(simulate(one_axis, tracker, random), tracker);
  EXPECT_THAT(about_y, HasSubstr("one axis only"));
  EXPECT_THAT(about_y, HasSubstr("nearly its y axis"));
  Swing small;
  small.amplitude_rad = {0.05, 0.05, 0.02};
  EXPECT_THAT(message_of(simulate(small, tracker, random), tracker), HasSubstr("swing the probe"));
  Swing still;
  still.amplitude_rad.setZero();
  EXPECT_THAT(message_of(simulate(still, tracker, random), tracker), HasSubstr("hardly rotated"));
  EXPECT_THAT(message_of({}, tracker), HasSubstr("0 poses"));
}

}  // namespace
}  // namespace asperity
