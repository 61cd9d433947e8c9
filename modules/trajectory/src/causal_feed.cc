#include "causal_feed.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "asperity/base/error.h"
#include "causal_window.h"
#include "fused_problem.h"
#include "fused_setup.h"

namespace asperity::inertial_smoother {

namespace {

constexpr std::size_t kFewestPoses = 4;
constexpr std::size_t kFewestRows = 8;

std::int64_t nanoseconds(double s) { return std::llround(s * 1e9); }

template <class T>
void copy_rows(const std::vector<T>& from, std::size_t first, std::size_t last, std::vector<T>& to) {
  if (from.empty()) return;
  to.assign(from.begin() + static_cast<std::ptrdiff_t>(first), from.begin() + static_cast<std::ptrdiff_t>(last));
}

std::size_t row_at(const ProbeStream& probe, std::int64_t t_ns) {
  return static_cast<std::size_t>(std::lower_bound(probe.t_ns.begin(), probe.t_ns.end(), t_ns) - probe.t_ns.begin());
}

}  // namespace

CausalFeed::CausalFeed(const Recording& recording, const FusedConfig& fused, const CausalFeedConfig& config)
    : recording_(recording), fused_(fused), config_(config) {
  part_.calibration = recording.calibration;
  part_.info = recording.info;
  pose_noise_ = stated_pose_noise(recording.tracker, recording.calibration, recording.info);
  const std::int64_t latency_ns = nanoseconds(prior_latency_s(recording.calibration));
  for (const std::int64_t t_ns : recording.tracker.t_ns) pose_ns_.push_back(t_ns - latency_ns);
  const ProbeStream& probe = recording.probe;
  if (probe.size() < kFewestRows) throw Error("probe.csv: " + std::to_string(probe.size()) + " samples are too few");
  const auto begin = std::lower_bound(pose_ns_.begin(), pose_ns_.end(), probe.t_ns.front());
  const auto end = std::upper_bound(begin, pose_ns_.end(), probe.t_ns.back());
  if (static_cast<std::size_t>(end - begin) < kFewestPoses) {
    throw Error("tracker.csv: " + std::to_string(end - begin) +
                " poses lie within the probe's time span; at least 4 are needed");
  }
  next_pose_ = static_cast<std::size_t>(begin - pose_ns_.begin());
  last_row_ = row_at(probe, *(end - 1) + 1);
}

// The rows in hand in SI units, with the quietest noise of all blocks so far.
void CausalFeed::calibrate() {
  const ProbeStream& probe = recording_.probe;
  copy_rows(probe.t_ns, first_row_, end_row_, part_.probe.t_ns);
  copy_rows(probe.accel_counts, first_row_, end_row_, part_.probe.accel_counts);
  copy_rows(probe.force_counts, first_row_, end_row_, part_.probe.force_counts);
  copy_rows(probe.gyro_counts, first_row_, end_row_, part_.probe.gyro_counts);
  copy_rows(probe.force3_counts, first_row_, end_row_, part_.probe.force3_counts);
  InertialConfig config = fused_.inertial;
  stream_ = calibrate_inertial(part_, config);
  const bool again = stream_.accel_noise_mps2 > accel_floor_mps2_ || stream_.gyro_noise_radps > gyro_floor_radps_;
  accel_floor_mps2_ = std::min(accel_floor_mps2_, stream_.accel_noise_mps2);
  if (stream_.has_gyro) gyro_floor_radps_ = std::min(gyro_floor_radps_, stream_.gyro_noise_radps);
  if (!again) return;
  config.accel_noise_floor_mps2 = accel_floor_mps2_;
  if (stream_.has_gyro) config.gyro_noise_floor_radps = gyro_floor_radps_;
  stream_ = calibrate_inertial(part_, config);
}

void CausalFeed::configure() {
  const Calibration& calibration = recording_.calibration;
  set_constants(calibration, stream_.has_gyro, fused_, problem_);
  problem_.layout = choose_layout(calibration, stream_.has_gyro, false, fused_);
  problem_.gravity = recording_.info.gravity_world_mps2;
  problem_.gate_innovations = true;
  problem_.gyro_turns_too = gyro_turns_too_;
  if (fused_.process_noise_scale > 0.0)
    problem_.process_scale = problem_.factors[kRateWalk] = fused_.process_noise_scale;
}

bool CausalFeed::next() {
  const ProbeStream& probe = recording_.probe;
  if (started_ && end_row_ >= last_row_) return false;
  const bool first = !started_;
  if (first) {
    const bool known = recording_.calibration.accelerometer.rotation_known;
    const std::int64_t wait_ns = nanoseconds(known ? config_.start_s : config_.mounting_s);
    const std::int64_t fewest_ns = pose_ns_[next_pose_ + kFewestPoses - 1];
    begin_ns_ = pose_ns_[next_pose_];
    end_row_ = row_at(probe, std::max(begin_ns_ + wait_ns, fewest_ns));
  } else {
    end_row_ = row_at(probe, std::max(begin_ns_, probe.t_ns[end_row_ - 1]) + nanoseconds(config_.block_s)) + 1;
  }
  end_row_ = std::min(std::max(end_row_, kFewestRows), last_row_);
  first_row_ = row_at(probe, begin_ns_ - nanoseconds(config_.context_s));
  if (end_row_ - first_row_ < kFewestRows) first_row_ = end_row_ - std::min(end_row_, kFewestRows);
  calibrate();
  if (first) begin_ns_ = std::max(begin_ns_, stream_.t_ns.front());  // by the smoothed clock

  // The poses that are not used yet, up to the block's last row.
  const std::int64_t last_ns = stream_.t_ns.back();
  while (next_pose_ < pose_ns_.size() && pose_ns_[next_pose_] < begin_ns_) ++next_pose_;
  std::size_t past_pose = next_pose_;
  std::vector<double> pose_s;
  for (; past_pose < pose_ns_.size() && pose_ns_[past_pose] <= last_ns; ++past_pose) {
    pose_s.push_back(static_cast<double>(pose_ns_[past_pose] - origin_ns()) * 1e-9);
  }
  if (!(begin_ns_ < last_ns)) return next();
  problem_ =
      make_window(stream_, fused_, static_cast<double>(begin_ns_ - origin_ns()) * 1e-9, pose_s,
                  std::span(recording_.tracker.T_world_marker).subspan(next_pose_, past_pose - next_pose_), first);
  configure();
  problem_.pose_noise.assign(pose_noise_.begin() + static_cast<std::ptrdiff_t>(next_pose_),
                             pose_noise_.begin() + static_cast<std::ptrdiff_t>(past_pose));
  if (first) {
    problem_.start_covariance = prior(recording_.calibration, stream_.has_gyro, fused_, problem_.layout);
    problem_.start = first_guess(part_, problem_);
    tie_place_to_lever(problem_);
    if (!recording_.calibration.accelerometer.rotation_known) choose_mounting(problem_, stream_.has_gyro);
    gyro_turns_too_ = problem_.gyro_turns_too;
  }
  started_ = true;
  next_pose_ = past_pose;
  begin_ns_ = last_ns;
  return true;
}

}  // namespace asperity::inertial_smoother
