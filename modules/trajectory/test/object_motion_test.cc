#include "asperity/trajectory/object_motion.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/trajectory/refer_to_object.h"
#include "asperity/trajectory/smooth_object_motion.h"

namespace asperity {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kFrame_s = 1.0 / 60.0;

std::int64_t ns(double t_s) { return std::llround(t_s * 1e9); }

Vector3d normal3(Random& random) { return {random.normal(), random.normal(), random.normal()}; }

Calibration calibration_of(double sigma_m, double sigma_rad) {
  Calibration out;
  out.tracker.sigma_position_m = Vector3d::Constant(sigma_m);
  out.tracker.sigma_rotation_rad = Vector3d::Constant(sigma_rad);
  return out;
}

ObjectSmootherConfig without_slow_error() {
  ObjectSmootherConfig out;
  out.slow_share = 0.0;
  return out;
}

// A turntable that is carried: constant angular velocity about an axis, its origin on a slow wave. In closed form.
struct Turntable {
  Vector3d omega_radps{0.3, 0.5, -0.4};
  Pose start{exp_rotation({0.4, -0.2, 0.9}), {0.02, -0.01, 0.4}};
  double amplitude_m = 0.02, wave_radps = 2.0;

  Vector3d origin_m(double t) const {
    return start.translation_m + amplitude_m * Vector3d(std::sin(wave_radps * t), std::cos(wave_radps * t), 0.1 * t);
  }
  Vector3d origin_mps(double t) const {
    return amplitude_m * Vector3d(wave_radps * std::cos(wave_radps * t), -wave_radps * std::sin(wave_radps * t), 0.1);
  }
  Vector3d origin_mps2(double t) const {
    return -amplitude_m * wave_radps * wave_radps * Vector3d(std::sin(wave_radps * t), std::cos(wave_radps * t), 0.0);
  }
  Pose at(double t) const { return {exp_rotation(omega_radps * t) * start.rotation, origin_m(t)}; }

  TrackerStream poses(double length_s) const {
    TrackerStream out;
    for (double t = 0.0; t <= length_s; t += kFrame_s) {
      out.t_ns.push_back(ns(t));
      out.T_world_marker.push_back(at(t));
    }
    return out;
  }

  // A tip that moves over the object at constant velocity.
  TipMotion tip(double length_s, const Vector3d& p_object_m, const Vector3d& v_object_mps) const {
    TipMotion out;
    for (double t = 0.0; t <= length_s; t += 1e-3) {
      const Quaterniond R = at(t).rotation;
      const Vector3d arm = R * (p_object_m + t * v_object_mps), slip = R * v_object_mps;
      out.t_ns.push_back(ns(t));
      out.p_world_tip_m.push_back(origin_m(t) + arm);
      out.q_world_marker.push_back(R * exp_rotation({0.1, 0.2, 0.3}));
      out.v_world_tip_mps.push_back(origin_mps(t) + omega_radps.cross(arm) + slip);
      out.a_world_tip_mps2.push_back(origin_mps2(t) + omega_radps.cross(omega_radps.cross(arm)) +
                                     2.0 * omega_radps.cross(slip));
      out.cov_world_tip_m2.push_back(1e-10 * Matrix3d::Identity());
      out.force_N.push_back(1.0);
      out.force_world_N.push_back(R * Vector3d(0.0, 0.0, 1.0));
    }
    return out;
  }
};

TEST(ReferToObject, ATipThatRestsOnATurningObjectRests) {
  const Turntable object;
  const ObjectMotion motion =
      smooth_object_motion(object.poses(4.0), calibration_of(1e-5, 1e-4), {}, 0.0, without_slow_error());
  const Vector3d place(0.03, -0.02, 0.05);
  const TipMotion tip = refer_to_object(object.tip(3.9, place, Vector3d::Zero()), motion);
  ASSERT_GT(tip.size(), 3800u);
  for (std::size_t i = 200; i + 200 < tip.size(); ++i) {
    // The cubic between poses 17 ms apart: 0.02 m·2⁴/s⁴ over 384 times the step to the fourth is below 1e-10 m; the
    // smoother, which weighs the poses as if they had the stated noise of 10 µm, leaves a little of the wave.
    ASSERT_LT((tip.p_world_tip_m[i] - place).norm(), 1e-6) << i;
    ASSERT_LT(tip.v_world_tip_mps[i].norm(), 5e-5) << i;
    ASSERT_LT(tip.a_world_tip_mps2[i].norm(), 5e-3) << i;
    ASSERT_LT(log_rotation(tip.q_world_marker[i] * exp_rotation({0.1, 0.2, 0.3}).conjugate()).norm(), 1e-5) << i;
    ASSERT_LT((tip.force_world_N[i] - Vector3d::UnitZ()).norm(), 1e-5) << i;
  }
}

TEST(ReferToObject, AStraightStrokeOnATurningObjectIsStraight) {
  const Turntable object;
  const ObjectMotion motion =
      smooth_object_motion(object.poses(4.0), calibration_of(1e-5, 1e-4), {}, 0.0, without_slow_error());
  const Vector3d place(0.03, -0.02, 0.05), velocity(0.04, 0.01, -0.02);
  const TipMotion tip = refer_to_object(object.tip(3.9, place, velocity), motion);
  for (std::size_t i = 200; i + 200 < tip.size(); ++i) {
    const double t = static_cast<double>(tip.t_ns[i]) * 1e-9;
    ASSERT_LT((tip.p_world_tip_m[i] - place - t * velocity).norm(), 1e-6) << i;
    ASSERT_LT((tip.v_world_tip_mps[i] - velocity).norm(), 5e-5) << i;
    ASSERT_LT(tip.a_world_tip_mps2[i].norm(), 5e-3) << i;
  }
}

// The covariance of a tip relative to an object, against drawn errors of both.
TEST(ReferToObject, CovarianceIsThatOfDrawnErrors) {
  Random random(3);
  const ObjectState mean{{exp_rotation({0.3, 0.1, -0.7}), {0.1, 0.2, 0.3}}, {}, {}, {}, {}, {}, {}};
  const Vector3d tip_m(0.15, 0.22, 0.27), sigma_tip_m(2e-4, 1e-4, 3e-4), sigma_m(1e-4, 2e-4, 5e-4),
      sigma_rad(4e-3, 2e-3, 6e-3);
  // Two knots with those covariances and no time between them to speak of.
  ObjectMotion object;
  object.t_ns = {0, 1000};
  object.T_world_object.assign(2, mean.T_world_object);
  ObjectKnot position, rotation;
  position.covariance.topLeftCorner<3, 3>() = sigma_m.cwiseAbs2().asDiagonal();
  rotation.covariance.topLeftCorner<3, 3>() = sigma_rad.cwiseAbs2().asDiagonal();
  position.with_next = position.covariance;
  rotation.with_next = rotation.covariance;
  object.position.assign(2, position);
  object.rotation.assign(2, rotation);
  object.longest_gap_s = 1.0;
  TipMotion motion;
  motion.t_ns = {500};
  motion.p_world_tip_m = {tip_m};
  motion.q_world_marker = {Quaterniond::Identity()};
  motion.v_world_tip_mps = motion.a_world_tip_mps2 = {Vector3d::Zero()};
  motion.cov_world_tip_m2 = {Matrix3d(sigma_tip_m.cwiseAbs2().asDiagonal())};
  motion.force_N = {0.0};
  const Matrix3d stated_m2 = refer_to_object(motion, object).cov_world_tip_m2.at(0);

  constexpr int kDraws = 20'000;
  Matrix3d drawn_m2 = Matrix3d::Zero();
  const Vector3d middle_m = mean.T_world_object.inverse() * tip_m;
  for (int i = 0; i < kDraws; ++i) {
    Pose pose = mean.T_world_object;
    pose.translation_m += sigma_m.cwiseProduct(normal3(random));
    pose.rotation = exp_rotation(sigma_rad.cwiseProduct(normal3(random))) * pose.rotation;
    const Vector3d error_m = pose.inverse() * (tip_m + sigma_tip_m.cwiseProduct(normal3(random))) - middle_m;
    drawn_m2 += error_m * error_m.transpose() / kDraws;
  }
  // 20000 draws know a variance to 1 %.
  EXPECT_LT((drawn_m2 - stated_m2).norm(), 0.04 * stated_m2.norm());
}

// A motion as the model has it: white acceleration, and poses with white noise.
struct DrawnMotion {
  std::vector<double> t_s;
  std::vector<Pose> truth;  // a finer step than the poses
  TrackerStream poses;
};

constexpr int kFiner = 8;

DrawnMotion draw_motion(std::uint64_t seed, double length_s, const Vector3d& accel_m2ps3,
                        const Vector3d& angular_rad2ps3, const Vector3d& sigma_m, const Vector3d& sigma_rad) {
  Random random(seed);
  DrawnMotion out;
  const double step_s = kFrame_s / kFiner;
  Pose pose{exp_rotation(normal3(random)), {0.0, 0.0, 0.4}};
  Vector3d v_mps = 0.05 * normal3(random), omega_radps = 0.3 * normal3(random);
  for (int i = 0; i * step_s < length_s; ++i) {
    out.t_s.push_back(i * step_s);
    out.truth.push_back(pose);
    if (i % kFiner == 0) {
      out.poses.t_ns.push_back(ns(i * step_s));
      out.poses.T_world_marker.push_back(
          {(exp_rotation(sigma_rad.cwiseProduct(normal3(random))) * pose.rotation).normalized(),
           pose.translation_m + sigma_m.cwiseProduct(normal3(random))});
    }
    const Vector3d kick_mps = (step_s * accel_m2ps3).cwiseSqrt().cwiseProduct(normal3(random));
    const Vector3d turn_radps = (step_s * angular_rad2ps3).cwiseSqrt().cwiseProduct(normal3(random));
    pose.translation_m += step_s * (v_mps + 0.5 * kick_mps);
    pose.rotation = (exp_rotation(step_s * (omega_radps + 0.5 * turn_radps)) * pose.rotation).normalized();
    v_mps += kick_mps;
    omega_radps += turn_radps;
  }
  return out;
}

TEST(SmoothObjectMotion, LearnsTheNoiseAndStatesItsError) {
  const Vector3d accel(2e-3, 5e-3, 1e-2), angular(0.05, 0.1, 0.4), sigma_m(1e-4, 2e-4, 4e-4),
      sigma_rad(3e-3, 2e-3, 1e-3);
  Vector3d accel_ratio = Vector3d::Zero(), angular_ratio = Vector3d::Zero(), noise_ratio = Vector3d::Zero();
  Vector3d position_chi2 = Vector3d::Zero(), rotation_chi2 = Vector3d::Zero();
  double raw_m2 = 0.0, smoothed_m2 = 0.0, points = 0.0;
  constexpr int kRuns = 12;
  for (int run = 0; run < kRuns; ++run) {
    const DrawnMotion drawn =
        draw_motion(100 + static_cast<std::uint64_t>(run), 12.0, accel, angular, sigma_m, sigma_rad);
    // Stated as 0.2 mm and 2 mrad on all axes, wrong by a factor of two on two of them: that weighs ten poses of 720.
    const ObjectMotion motion =
        smooth_object_motion(drawn.poses, calibration_of(2e-4, 2e-3), {}, 0.0, without_slow_error());
    accel_ratio += motion.noise.accel_m2ps3.cwiseQuotient(accel) / kRuns;
    angular_ratio += motion.noise.angular_rad2ps3.cwiseQuotient(angular) / kRuns;
    noise_ratio += motion.noise.pose_m.cwiseQuotient(sigma_m) / kRuns;
    for (std::size_t i = 0; i < drawn.t_s.size(); i += 3) {  // at the poses and between them
      if (!motion.is_seen(ns(drawn.t_s[i]))) continue;
      const ObjectState state = motion.at(ns(drawn.t_s[i]));
      const Vector3d error_m = drawn.truth[i].translation_m - state.T_world_object.translation_m;
      const Vector3d error_rad = log_rotation(drawn.truth[i].rotation * state.T_world_object.rotation.conjugate());
      position_chi2 += error_m.cwiseAbs2().cwiseQuotient(Vector3d(state.position_m2.diagonal()));
      rotation_chi2 += error_rad.cwiseAbs2().cwiseQuotient(Vector3d(state.rotation_rad2.diagonal()));
      smoothed_m2 += error_m.squaredNorm();
      points += 1.0;
    }
    for (std::size_t i = 0; i < drawn.poses.size(); ++i)
      raw_m2 += (drawn.poses.T_world_marker[i].translation_m - drawn.truth[kFiner * i].translation_m).squaredNorm();
  }
  for (int axis = 0; axis < 3; ++axis) {
    // The density is known to some 15 % a run; twelve runs to 5 %.
    EXPECT_NEAR(accel_ratio[axis], 1.0, 0.15) << axis;
    EXPECT_NEAR(angular_ratio[axis], 1.0, 0.15) << axis;
    EXPECT_NEAR(noise_ratio[axis], 1.0, 0.05) << axis;
    // Of some 1000 independent errors: 1 ± 0.05.
    EXPECT_NEAR(position_chi2[axis] / points, 1.0, 0.12) << axis;
    EXPECT_NEAR(rotation_chi2[axis] / points, 1.0, 0.12) << axis;
  }
  EXPECT_LT(smoothed_m2 / points, 0.5 * raw_m2 * kFiner / 3.0 / points);
}

TEST(SmoothObjectMotion, WildPosesLoseTheirWeight) {
  const Vector3d sigma_m = Vector3d::Constant(2e-4), sigma_rad = Vector3d::Constant(2e-3);
  DrawnMotion drawn = draw_motion(7, 10.0, Vector3d::Constant(5e-3), Vector3d::Constant(0.1), sigma_m, sigma_rad);
  const ObjectMotion clean = smooth_object_motion(drawn.poses, calibration_of(2e-4, 2e-3), {}, 0.0);
  std::size_t wild = 0;
  for (std::size_t i = 0; i < drawn.poses.size(); i += 23, ++wild) {  // the very first among them
    drawn.poses.T_world_marker[i].rotation = exp_rotation({0.9, 0.0, 0.3}) * drawn.poses.T_world_marker[i].rotation;
    drawn.poses.T_world_marker[i].translation_m.z() += 0.006;
  }
  const ObjectMotion motion = smooth_object_motion(drawn.poses, calibration_of(2e-4, 2e-3), {}, 0.0);
  EXPECT_NEAR(static_cast<double>(motion.outlying), static_cast<double>(wild), 4.0);
  EXPECT_LE(clean.outlying, 3u);
  for (double t = 0.1; t < 9.8; t += 0.013) {
    const Pose a = clean.at(ns(t)).T_world_object, b = motion.at(ns(t)).T_world_object;
    ASSERT_LT((a.translation_m - b.translation_m).norm(), 3e-4) << t;  // a pose fewer, and no more
    ASSERT_LT(rotation_between_rad(a, b), 4e-3) << t;
  }
}

TEST(SmoothObjectMotion, TheErrorGrowsWhereItWasNotSeen) {
  DrawnMotion drawn = draw_motion(9, 6.0, Vector3d::Constant(5e-3), Vector3d::Constant(0.1), Vector3d::Constant(2e-4),
                                  Vector3d::Constant(2e-3));
  TrackerStream seen;
  for (std::size_t i = 0; i < drawn.poses.size(); ++i) {
    const double t_s = static_cast<double>(drawn.poses.t_ns[i]) * 1e-9;
    if ((t_s > 2.0 && t_s < 2.15) || (t_s > 4.0 && t_s < 4.5)) continue;
    seen.t_ns.push_back(drawn.poses.t_ns[i]);
    seen.T_world_marker.push_back(drawn.poses.T_world_marker[i]);
  }
  const ObjectMotion motion = smooth_object_motion(seen, calibration_of(2e-4, 2e-3), {}, 0.0);
  EXPECT_TRUE(motion.is_seen(ns(2.07)));
  EXPECT_FALSE(motion.is_seen(ns(4.2)));
  EXPECT_FALSE(motion.is_seen(ns(-0.001)));
  EXPECT_FALSE(motion.is_seen(ns(6.1)));
  EXPECT_GT(motion.at(ns(2.07)).position_m2.trace(), 3.0 * motion.at(ns(1.0)).position_m2.trace());

  const Turntable any;
  const TipMotion tip = refer_to_object(any.tip(5.9, Vector3d::Zero(), Vector3d::Zero()), motion);
  for (const std::int64_t t_ns : tip.t_ns) EXPECT_TRUE(t_ns < ns(4.01) || t_ns > ns(4.49));
}

TEST(SmoothObjectMotion, TheLatencyIsTakenOff) {
  const Turntable object;
  TrackerStream late = object.poses(2.0);
  for (std::int64_t& t_ns : late.t_ns) t_ns += ns(0.02);
  const ObjectMotion motion = smooth_object_motion(late, calibration_of(1e-5, 1e-4), {}, 0.02);
  EXPECT_LT((motion.at(ns(1.0)).T_world_object.translation_m - object.origin_m(1.0)).norm(), 1e-6);
}

TEST(SmoothObjectMotion, NeedsFourPoses) {
  TrackerStream few = Turntable().poses(0.04);
  EXPECT_THROW(smooth_object_motion(few, calibration_of(1e-4, 1e-3), {}, 0.0), Error);
}

// An object that was turned over by hand: no chart of rotations holds all of it.
TEST(SmoothObjectMotion, MayTurnByMoreThanHalfARevolution) {
  Turntable object;
  object.omega_radps = {0.0, 1.5, 0.0};
  const ObjectMotion motion =
      smooth_object_motion(object.poses(6.0), calibration_of(1e-5, 1e-4), {}, 0.0, without_slow_error());
  for (double t = 0.3; t < 5.7; t += 0.01)
    ASSERT_LT(rotation_between_rad(motion.at(ns(t)).T_world_object, object.at(t)), 1e-4);
}

}  // namespace
}  // namespace asperity
