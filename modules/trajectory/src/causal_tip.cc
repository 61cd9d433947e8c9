#include "asperity/trajectory/causal_tip.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/LU>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "causal_window.h"
#include "fused_problem.h"
#include "fused_setup.h"
#include "inertial_smoother.h"
#include "noise_scale.h"
#include "sample_intake.h"
#include "steady_path.h"
#include "tip_motion.h"

namespace asperity {

namespace {

using inertial_smoother::Checkpoint;
using inertial_smoother::Smoothed;
using WindowProblem = inertial_smoother::Problem;
using Eigen::Vector3d;

constexpr double kLongestWindow_s = 0.5;  // a pose later than this is not waited for
constexpr double kForget_s = 1.0;         // how late poses were
constexpr double kLongestBlind_s = 1.0;   // without a pose: dead reckoning is lost
double seconds(std::int64_t ns) { return static_cast<double>(ns) * 1e-9; }
std::int64_t nanoseconds(double s) { return std::llround(s * 1e9); }

// Where the window before had the first sample that it left open.
struct Seam {
  std::int64_t row_ns = 0;  // the stamp that the sample came with: its name
  Vector3d p_m = Vector3d::Zero();
  Vector3d v_mps = Vector3d::Zero();
};

}  // namespace

struct CausalTip::Impl {
  Calibration calibration;
  FusedConfig fused;
  CausalTipConfig config;
  SampleIntake intake;

  // The filter, from `begin_ns` on. Without a checkpoint it has not begun.
  std::optional<Checkpoint> checkpoint;
  std::int64_t begin_ns = 0;
  bool gyro_turns_too = true;
  NoiseScale process_scale;
  double rate_scale = 1.0;

  std::int64_t next_run_ns = std::numeric_limits<std::int64_t>::min();
  std::int64_t final_row_ns = std::numeric_limits<std::int64_t>::min();  // stamp of the newest final sample
  std::int64_t final_ns = std::numeric_limits<std::int64_t>::min();      // its smoothed time
  std::optional<Seam> seam;
  SteadyPath steady;
  bool broken = true;
  double accel_floor_mps2 = std::numeric_limits<double>::infinity();
  double gyro_floor_radps = std::numeric_limits<double>::infinity();
  Samples ready;
  double poses_late_s = 0.0;  // behind the rows when they came: the most of late
  std::uint64_t outlying = 0;
  std::uint64_t restarts = 0;
  CausalTipCounts counts;

  Impl(const Calibration& c, const RecordingInfo& info, const FusedConfig& f, const CausalTipConfig& t)
      : calibration(c),
        fused(f),
        config(t),
        intake(c, info),
        process_scale(f.process_noise_scale),
        steady(t.correction_Hz) {
    if (f.process_noise_scale > 0.0) rate_scale = f.process_noise_scale;
  }

  double lag_s() const;
  void add(const TrackerSample& pose);
  void run();
  void begin();
  void step(bool last);
  void forget();
  void keep_needed();
  InertialStream inertial();
  void configure(bool has_gyro, WindowProblem& problem) const;
  void collect(const InertialStream& inertial, Smoothed& smoothed, double final_s);
};

// The window's rows in SI units, with the quietest noise of all windows so far.
InertialStream CausalTip::Impl::inertial() {
  InertialConfig stage = fused.inertial;
  InertialStream out = calibrate_inertial(intake.recording(), stage);
  const bool again = out.accel_noise_mps2 > accel_floor_mps2 || out.gyro_noise_radps > gyro_floor_radps;
  accel_floor_mps2 = std::min(accel_floor_mps2, out.accel_noise_mps2);
  if (out.has_gyro) gyro_floor_radps = std::min(gyro_floor_radps, out.gyro_noise_radps);
  if (!again) return out;
  // The noise enters each sample's variance beside what else it carries.
  const auto lower = [](std::vector<double>& sigma, double from, double to) {
    for (double& s : sigma) s = std::sqrt(std::max(s * s - from * from + to * to, to * to));
  };
  lower(out.accel_sigma_mps2, out.accel_noise_mps2, accel_floor_mps2);
  if (out.has_gyro) lower(out.gyro_sigma_radps, out.gyro_noise_radps, gyro_floor_radps);
  return out;
}

void CausalTip::Impl::configure(bool has_gyro, WindowProblem& problem) const {
  inertial_smoother::set_constants(calibration, has_gyro, fused, problem);
  problem.layout = inertial_smoother::choose_layout(calibration, has_gyro, false, fused);
  problem.gravity = intake.recording().info.gravity_world_mps2;
  problem.pose_noise =
      inertial_smoother::stated_pose_noise(intake.recording().tracker, calibration, intake.recording().info);
  problem.process_scale = process_scale.factor();
  problem.factors[inertial_smoother::kRateWalk] = rate_scale;
  problem.gyro_turns_too = gyro_turns_too;
  problem.gate_innovations = true;
  problem.tip_sigma_m.setZero();  // live heights are compared with each other
}

// A sample waits for the poses shortly after it as long as poses have been on their way of late. The window reaches no
// further back.
double CausalTip::Impl::lag_s() const {
  const double late_s = std::min(poses_late_s + config.poses_after_s, config.longest_lag_s);
  return std::min(std::max(config.lag_s, late_s), kLongestWindow_s - std::min(config.hop_s, 0.5 * kLongestWindow_s));
}

void CausalTip::Impl::add(const TrackerSample& pose) {
  const std::int64_t before_ns = intake.newest_pose_ns();
  intake.add(pose);
  const std::int64_t now_ns = intake.newest_pose_ns();
  if (now_ns <= before_ns || intake.recording().probe.size() == 0) return;
  const double passed_s = std::min(seconds(now_ns - std::max(before_ns, now_ns - nanoseconds(1.0))), 1.0);
  poses_late_s = std::max(seconds(intake.newest_row_ns() - now_ns), poses_late_s * std::exp(-passed_s / kForget_s));
}

// Everything that the filter knows is given up; rows and poses that are still in hand stay.
void CausalTip::Impl::forget() {
  checkpoint.reset();
  seam.reset();
  process_scale.forget();
  broken = true;
}

// The first state, as soon as there are poses and rows enough.
void CausalTip::Impl::begin() {
  const Recording& recording = intake.recording();
  std::vector<double> pose_s = intake.pose_s(recording.probe.t_ns.front());
  const double newest_s = seconds(recording.probe.t_ns.back() - recording.probe.t_ns.front());
  const double wait_s = calibration.accelerometer.rotation_known ? config.start_s : config.mounting_s;
  std::size_t first = 0;
  while (first < pose_s.size() && pose_s[first] < 0.0) ++first;
  std::size_t inside = first;
  while (inside < pose_s.size() && pose_s[inside] <= newest_s) ++inside;
  if (inside < first + 4 || newest_s - pose_s[first] < wait_s) return;

  const InertialStream stream = inertial();
  pose_s = intake.pose_s(stream.t_ns.front());
  if (pose_s[first] < 0.0) ++first;  // by the smoothed clock it lies before the first row
  WindowProblem problem =
      inertial_smoother::make_window(stream, fused, pose_s[first], pose_s, recording.tracker.T_world_marker, true);
  configure(stream.has_gyro, problem);
  problem.start_covariance = inertial_smoother::prior(calibration, stream.has_gyro, fused, problem.layout);
  problem.start = inertial_smoother::first_guess(recording, problem);
  inertial_smoother::tie_place_to_lever(problem);
  if (!calibration.accelerometer.rotation_known) inertial_smoother::choose_mounting(problem, stream.has_gyro);
  gyro_turns_too = problem.gyro_turns_too;
  checkpoint = Checkpoint{problem.start, problem.start_covariance, 0};
  begin_ns = stream.t_ns.front() + nanoseconds(pose_s[first]);
  intake.set_begin(begin_ns);
}

// Takes the window's samples up to `final_s` after its first row: they are final.
void CausalTip::Impl::collect(const InertialStream& stream, Smoothed& smoothed, double final_s) {
  const TipMotion motion = inertial_smoother::make_tip_motion(stream, smoothed, calibration.tip_in_marker_m);
  const std::vector<std::int64_t>& stamps = intake.recording().probe.t_ns;
  const std::int64_t origin_ns = stream.t_ns.front();
  std::size_t ahead = 0;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const std::int64_t stamp = stamps[static_cast<std::size_t>(smoothed.sample[i])];
    if (stamp <= final_row_ns) continue;
    if (seconds(motion.t_ns[i] - origin_ns) > final_s) {
      // While the lag grows nothing becomes final, and what the sample was estimated first counts.
      if (!seam || seam->row_ns != stamp) seam = Seam{stamp, motion.p_world_tip_m[i], motion.v_world_tip_mps[i]};
      return;
    }
    const std::int64_t t_ns = std::max(motion.t_ns[i], final_ns + 1);
    if (broken) {
      steady.reset();  // nothing is before it that it could depart from
    } else if (seam && seam->row_ns == stamp) {
      steady.jump(motion.p_world_tip_m[i] - seam->p_m, motion.v_world_tip_mps[i] - seam->v_mps);
    }
    seam.reset();
    final_row_ns = stamp;
    final_ns = t_ns;
    ready.steady_m.push_back(steady.push(t_ns, motion.p_world_tip_m[i]));
    ready.motion.t_ns.push_back(t_ns);
    ready.motion.p_world_tip_m.push_back(motion.p_world_tip_m[i]);
    ready.motion.q_world_marker.push_back(motion.q_world_marker[i]);
    ready.motion.v_world_tip_mps.push_back(motion.v_world_tip_mps[i]);
    ready.motion.a_world_tip_mps2.push_back(motion.a_world_tip_mps2[i]);
    ready.motion.cov_world_tip_m2.push_back(motion.cov_world_tip_m2[i]);
    ready.motion.force_N.push_back(motion.force_N[i]);
    ready.broken.push_back(broken ? 1 : 0);
    broken = false;
    while (ahead + 1 < motion.size() && seconds(motion.t_ns[ahead] - motion.t_ns[i]) < config.ahead_s) ++ahead;
    const double reached_s = seconds(motion.t_ns[ahead] - motion.t_ns[i]);
    const Vector3d way = motion.p_world_tip_m[ahead] - motion.p_world_tip_m[i];
    ready.ahead_m.push_back(reached_s > 0.5 * config.ahead_s ? Vector3d(config.ahead_s / reached_s * way)
                                                             : Vector3d(config.ahead_s * motion.v_world_tip_mps[i]));
  }
}

// One estimate of the window; then its start moves on.
void CausalTip::Impl::step(bool last) {
  const Recording& recording = intake.recording();
  const InertialStream stream = inertial();
  const std::int64_t origin_ns = stream.t_ns.front();
  const double begin_s = seconds(begin_ns - origin_ns);
  const double end_s = seconds(stream.t_ns.back() - origin_ns);
  if (!(begin_s < end_s)) return;
  const std::vector<double> pose_s = intake.pose_s(origin_ns);
  WindowProblem problem =
      inertial_smoother::make_window(stream, fused, begin_s, pose_s, recording.tracker.T_world_marker, false);
  configure(stream.has_gyro, problem);
  problem.start = checkpoint->x;
  problem.start_covariance = checkpoint->P;
  problem.refused_in_a_row = checkpoint->refused_in_a_row;

  double newest_pose_s = -std::numeric_limits<double>::infinity();
  for (const double t : pose_s) {
    if (t <= end_s) newest_pose_s = t;
  }
  // Poses that are still on their way must find the window's start before them.
  const double final_s = end_s - lag_s();
  const double want_s = std::max(std::min(final_s, newest_pose_s), end_s - kLongestWindow_s);
  for (std::size_t e = 0; e < problem.epochs.size(); ++e) {
    if (problem.knots[problem.epochs[e].knot].t <= want_s) problem.checkpoint_epoch = e;
  }
  Smoothed smoothed = inertial_smoother::smooth_motion(problem, calibration.tip_in_marker_m, true, {});
  if (!smoothed.last.p.allFinite() || !smoothed.first.p.allFinite() || !smoothed.checkpoint.P.allFinite()) {
    ++restarts;
    forget();
    return;
  }
  collect(stream, smoothed, last ? std::numeric_limits<double>::infinity() : final_s);
  const double moved_s = problem.knots[problem.epochs[problem.checkpoint_epoch].knot].t;
  for (std::size_t e = 1; e <= problem.checkpoint_epoch; ++e) {
    const std::int64_t pose = problem.epochs[e].pose;
    if (pose < 0) continue;
    const auto i = static_cast<std::size_t>(pose);
    const double d2 = std::max(smoothed.position_chi2[i], smoothed.rotation_chi2[i]);
    outlying += inertial_smoother::redescending(d2, problem.gate_chi2) < 0.5;
  }
  checkpoint = process_scale.judge(problem, smoothed.checkpoint);
  begin_ns = origin_ns + nanoseconds(moved_s);
  intake.set_begin(begin_ns);
}

void CausalTip::Impl::run() {
  if (intake.recording().probe.size() < 8) return;
  if (checkpoint && seconds(intake.newest_row_ns() - intake.newest_pose_ns()) > kLongestBlind_s) {
    ++restarts;
    forget();
  }
  if (!checkpoint) begin();
  if (checkpoint) step(false);
  const double keep_s = checkpoint ? seconds(intake.newest_row_ns() - begin_ns) + config.context_s
                        : calibration.accelerometer.rotation_known ? config.start_s + kLongestWindow_s
                                                                   : config.mounting_s + kLongestWindow_s;
  intake.forget_before(intake.newest_row_ns() - nanoseconds(keep_s));
}

CausalTip::CausalTip(const Calibration& calibration, const RecordingInfo& info, const FusedConfig& fused,
                     const CausalTipConfig& config)
    : impl_(std::make_unique<Impl>(calibration, info, fused, config)) {}
CausalTip::~CausalTip() = default;
CausalTip::CausalTip(CausalTip&&) noexcept = default;
CausalTip& CausalTip::operator=(CausalTip&&) noexcept = default;

void CausalTip::push(const ProbeSample& row) {
  Impl& self = *impl_;
  const std::int64_t before_ns = self.intake.newest_row_ns();
  const SampleIntake::Row kind = self.intake.judge(row, self.config.max_row_gap_s);
  if (kind == SampleIntake::Row::kRefused) return;
  if (kind == SampleIntake::Row::kAfterHole) {
    if (self.checkpoint && self.intake.recording().probe.size() >= 8) self.step(true);
    ++self.restarts;
    self.forget();
    self.intake.clear_rows();
    if (row.t_ns < before_ns) {  // the clock was set back: poses and results of the future go
      self.intake.clear_poses();
      self.final_row_ns = self.final_ns = std::numeric_limits<std::int64_t>::min();
    }
    self.next_run_ns = row.t_ns;
  }
  self.intake.add(row);
  if (row.t_ns < self.next_run_ns) return;
  self.next_run_ns = row.t_ns + nanoseconds(self.config.hop_s);
  self.run();
}

void CausalTip::push(const TrackerSample& pose) { impl_->add(pose); }

void CausalTip::take(Samples& out) {
  const auto append_values = [](auto& to, auto& from) {
    to.insert(to.end(), from.begin(), from.end());
    from.clear();
  };
  TipMotion& from = impl_->ready.motion;
  append_values(out.motion.t_ns, from.t_ns);
  append_values(out.motion.p_world_tip_m, from.p_world_tip_m);
  append_values(out.motion.q_world_marker, from.q_world_marker);
  append_values(out.motion.v_world_tip_mps, from.v_world_tip_mps);
  append_values(out.motion.a_world_tip_mps2, from.a_world_tip_mps2);
  out.motion.cov_world_tip_m2.append(from.cov_world_tip_m2);
  from.cov_world_tip_m2.clear();
  append_values(out.motion.force_N, from.force_N);
  append_values(out.broken, impl_->ready.broken);
  append_values(out.steady_m, impl_->ready.steady_m);
  append_values(out.ahead_m, impl_->ready.ahead_m);
}

CausalTipCounts CausalTip::counts() const {
  CausalTipCounts out = impl_->intake.counts();
  out.poses_outlying = impl_->outlying;
  out.restarts = impl_->restarts;
  return out;
}

std::int64_t CausalTip::newest_row_ns() const { return impl_->intake.newest_row_ns(); }
std::int64_t CausalTip::newest_pose_ns() const { return impl_->intake.newest_pose_ns(); }
std::int64_t CausalTip::final_ns() const { return impl_->final_ns; }

std::string CausalTip::waiting() const {
  if (impl_->checkpoint) return "";
  if (impl_->intake.recording().probe.size() == 0) return "no row has come from the probe";
  if (impl_->intake.recording().tracker.size() < 4) return "the marker is not seen";
  if (!impl_->calibration.accelerometer.rotation_known) {
    return "the sensor's rotation is being found: move the probe for " + number_text(impl_->config.mounting_s) + " s";
  }
  return "the first poses are being gathered";
}

}  // namespace asperity
