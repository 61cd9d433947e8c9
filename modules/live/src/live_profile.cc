#include "asperity/live/live_profile.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <limits>
#include <utility>

#include "asperity/base/nan.h"
#include "asperity/profile/causal_base.h"
#include "asperity/profile/causal_contact.h"
#include "asperity/profile/causal_grid.h"
#include "asperity/profile/causal_high_pass.h"
#include "live_heading.h"

namespace asperity {

// The causal counterpart of force_scale.h: 1 - (f - mean)/(max - min), f after an exponential average and mean, maximum
// and minimum of what has come so far.
class RunningForceScale {
 public:
  explicit RunningForceScale(double window_s) : window_s_(window_s) {}

  // 1 without a force, and while the force has not changed.
  double factor(double force_N, std::int64_t t_ns) {
    if (!std::isfinite(force_N)) return 1.0;
    if (count_ == 0.0) smooth_N_ = low_N_ = high_N_ = force_N;
    const double step_s = count_ == 0.0 ? 0.0 : std::max(0.0, static_cast<double>(t_ns - last_ns_) * 1e-9);
    last_ns_ = t_ns;
    smooth_N_ += (window_s_ > 0.0 ? 1.0 - std::exp(-step_s / window_s_) : 1.0) * (force_N - smooth_N_);
    count_ += 1.0;
    mean_N_ += (smooth_N_ - mean_N_) / count_;
    low_N_ = std::min(low_N_, smooth_N_);
    high_N_ = std::max(high_N_, smooth_N_);
    return high_N_ > low_N_ ? 1.0 - (smooth_N_ - mean_N_) / (high_N_ - low_N_) : 1.0;
  }

 private:
  double window_s_;
  double count_ = 0.0;
  std::int64_t last_ns_ = 0;
  double smooth_N_ = 0.0, mean_N_ = 0.0, low_N_ = 0.0, high_N_ = 0.0;
};

namespace {

using Eigen::Vector3d;

constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::min() / 2;
constexpr double kBandOverCutoff = 4.0;  // where the high-pass' group delay is stated

CausalBaseConfig base_config(const LiveProfileConfig& config) {
  return {config.base, config.base_history_s, config.base_period_s, config.base_settle_m};
}

CausalTipConfig tip_config(const LiveProfileConfig& config) {
  CausalTipConfig out = config.tip;
  out.ahead_s = 0.5 * config.heading_span_s;
  return out;
}

double seconds(std::int64_t ns) { return static_cast<double>(ns) * 1e-9; }

}  // namespace

struct LiveProfile::Impl {
  Calibration calibration;
  RecordingInfo info;
  LiveProfileConfig config;
  CausalTip tip;
  CausalContact contact;
  CausalBase base;
  LiveHeading heading;
  CausalGrid grid;
  CausalHighPass high_pass;
  RunningForceScale force_scale;

  CausalTip::Samples samples;             // of the last take
  std::vector<CausalGrid::Sample> cells;  // scratch
  LiveEstimate ready;
  double s_m = 0.0;
  bool any = false;  // a sample has been in contact: the arc length runs
  bool in_run = false;
  Vector3d last_p_m = Vector3d::Zero();
  std::int64_t last_tip_ns = kNever;
  std::int64_t last_row_ns = kNever;
  std::int64_t moved_ns = 0;  // when the arc length last grew noticeably
  double moved_s_m = 0.0;

  Impl(const Calibration& c, const RecordingInfo& i, const LiveProfileConfig& k)
      : calibration(c),
        info(i),
        config(k),
        tip(c, i, k.fused, tip_config(k)),
        contact(k.base.contact),
        base(base_config(k), c.tip_in_marker_m),
        heading(k.heading_span_s, k.base.arc_length.rest_speed_mps, k.base.arc_length.rest_fraction),
        grid(k.profile.spacing_m, k.profile.max_hole_m),
        high_pass(k.profile.spacing_m, k.profile.cutoff_cycles_per_mm, k.profile.bridge_m),
        force_scale(k.force_window_s) {}

  void begin_profile();
  void advance();
  void add(std::size_t i);
  void cut();
  void take_cells();
  void clock_set_back();
};

void LiveProfile::Impl::begin_profile() {
  base = CausalBase(base_config(config), calibration.tip_in_marker_m);
  grid = CausalGrid(config.profile.spacing_m, config.profile.max_hole_m);
  high_pass = CausalHighPass(config.profile.spacing_m, config.profile.cutoff_cycles_per_mm, config.profile.bridge_m);
  force_scale = RunningForceScale(config.force_window_s);
  heading.forget_direction();
  s_m = moved_s_m = 0.0;
  any = in_run = false;
}

// Points that the grid has completed get their texture.
void LiveProfile::Impl::take_cells() {
  for (const CausalGrid::Sample& cell : cells) {
    LivePoint point;
    point.t_ns = cell.t_ns;
    point.s_m = cell.s_m;
    point.height_m = cell.height_m;
    point.sigma_m = cell.sigma_m;
    point.force_N = cell.force_N;
    point.speed_mps = cell.speed_mps;
    point.texture_m = high_pass.push(cell.height_m);
    if (config.scale_by_force) point.texture_m *= force_scale.factor(cell.force_N, cell.t_ns);
    ready.points.push_back(point);
  }
  cells.clear();
}

// What remembers times begins anew.
void LiveProfile::Impl::clock_set_back() {
  cut();
  high_pass.cut();
  contact.reset();
  base.reset();
  last_tip_ns = moved_ns = kNever;
}

void LiveProfile::Impl::cut() {
  if (!in_run) return;
  grid.cut(cells);
  take_cells();
  in_run = false;
}

// One final sample of the motion: where it is along and above the base.
void LiveProfile::Impl::add(std::size_t i) {
  const TipMotion& motion = samples.motion;
  const std::int64_t t_ns = motion.t_ns[i];
  const Vector3d& p = motion.p_world_tip_m[i];
  const bool broken = samples.broken[i] != 0;
  if (broken) {
    cut();
    high_pass.cut();
    heading.forget_path();
    last_p_m = p;
  }
  bool touching = contact.touching_at(t_ns);
  const Vector3d normal = base.begun() ? base.normal_at(p) : Vector3d::Zero();
  const Vector3d direction = heading.push(t_ns, p, samples.ahead_m[i], normal);
  const double speed_mps = heading.speed_mps();
  double step_m = 0.0;
  if (any && !broken) step_m = direction.dot(p - last_p_m);
  last_p_m = p;
  if (touching && contact.measured()) any = true;
  if (!contact.measured()) any = true;
  base.push(t_ns, p, motion.q_world_marker[i], motion.force_N[i], touching, step_m);
  s_m += step_m;

  LiveTip out;
  out.t_ns = t_ns;
  out.p_world_tip_m = p;
  out.v_world_tip_mps = motion.v_world_tip_mps[i];
  out.heading_world = direction;
  const Vector3d axis = motion.q_world_marker[i] * Vector3d(-calibration.tip_in_marker_m);
  if (axis.norm() > 0.0) out.probe_axis_world = axis.normalized();
  const Eigen::Matrix3d cov = motion.cov_world_tip_m2[i];
  out.sigma_m = std::sqrt(std::max(0.0, cov.diagonal().maxCoeff()));
  out.speed_mps = speed_mps;
  out.force_N = motion.force_N[i];
  out.s_m = s_m;
  if (base.begun()) {
    const Vector3d n = base.normal_at(p);
    // Along the path the best position; above it the one that is steadiest over a few millimetres.
    const double height_m = base.height_m(p) + n.dot(samples.steady_m[i] - p);
    const double sigma_m = std::sqrt(std::max(0.0, n.dot(cov * n)));
    if (!contact.measured()) touching = std::abs(height_m) <= config.base.max_height_m;
    if (base.fitted()) out.tilt_rad = std::acos(std::clamp(n.dot(out.probe_axis_world), -1.0, 1.0));
    out.usable = touching && sigma_m <= config.max_sigma_m && speed_mps >= config.min_speed_mps;
    // After a long rest the slow error has moved on.
    if (s_m > moved_s_m + config.profile.spacing_m || s_m < moved_s_m - 0.3e-3) {
      if (in_run && seconds(t_ns - moved_ns) > config.profile.max_stop_s) {
        cut();
        high_pass.cut();
      }
      moved_ns = t_ns;
      moved_s_m = s_m;
    }
    if (out.usable) {
      grid.push({t_ns, s_m, height_m, sigma_m, motion.force_N[i], speed_mps}, cells);
      in_run = true;
      take_cells();
    } else {
      cut();
    }
  }
  out.contact = touching;
  if (broken || last_tip_ns == kNever || seconds(t_ns - last_tip_ns) >= config.tip_period_s) {
    ready.tips.push_back(out);
    last_tip_ns = t_ns;
  }
}

void LiveProfile::Impl::advance() {
  tip.take(samples);
  for (std::size_t i = 0; i < samples.motion.size(); ++i) add(i);
  if (samples.motion.size() > 0) contact.forget_before(samples.motion.t_ns.back());
  samples = {};
}

LiveProfile::LiveProfile(const Calibration& calibration, const RecordingInfo& info, const LiveProfileConfig& config)
    : impl_(std::make_unique<Impl>(calibration, info, config)) {}
LiveProfile::~LiveProfile() = default;
LiveProfile::LiveProfile(LiveProfile&&) noexcept = default;
LiveProfile& LiveProfile::operator=(LiveProfile&&) noexcept = default;

void LiveProfile::push(const ProbeSample& row) {
  Impl& self = *impl_;
  const std::uint64_t refused = self.tip.counts().rows_refused;
  self.tip.push(row);
  if (self.tip.counts().rows_refused == refused) {
    if (row.t_ns <= self.last_row_ns) self.clock_set_back();
    self.last_row_ns = row.t_ns;
    self.contact.push(row.t_ns, self.calibration.force.force_N(row.force_counts));
  }
  self.advance();
}

void LiveProfile::push(const TrackerSample& pose) { impl_->tip.push(pose); }

LiveEstimate LiveProfile::estimate() {
  Impl& self = *impl_;
  LiveEstimate out = std::exchange(self.ready, {});
  out.base.known = self.base.fitted();
  out.base.shape = self.base.shape();
  if (self.base.begun()) out.base.normal_world = self.base.normal_at(self.last_p_m);
  out.base.normal_sigma_deg = self.base.normal_sigma_deg();
  out.base.radius_m = self.base.radius_m();
  out.base.settled = self.base.settled();
  const CausalTipCounts counts = self.tip.counts();
  out.counts = {counts.rows,          counts.rows_refused, counts.rows_lost,      counts.poses,
                counts.poses_refused, counts.poses_late,   counts.poses_outlying, counts.restarts};
  out.waiting = self.tip.waiting();
  out.newest_row_ns = self.tip.newest_row_ns();
  out.newest_pose_ns = self.tip.newest_pose_ns();
  out.motion_ns = self.tip.final_ns();
  out.age_s = out.motion_ns > 0 ? seconds(out.newest_row_ns - out.motion_ns) : kNan;
  out.texture_group_delay_m = self.high_pass.group_delay_m(kBandOverCutoff * self.config.profile.cutoff_cycles_per_mm);
  return out;
}

void LiveProfile::restart() { impl_->begin_profile(); }

void LiveProfile::configure(const LiveProfileConfig& config) {
  Impl& self = *impl_;
  Impl(self.calibration, self.info, config);  // throws what there is to be thrown, before anything has changed
  const LiveProfileConfig before = std::exchange(self.config, config);
  if (!is_same_config(before.tip, config.tip) || !is_same_config(before.fused, config.fused) ||
      before.heading_span_s != config.heading_span_s) {
    self.tip = CausalTip(self.calibration, self.info, config.fused, tip_config(config));
    self.heading =
        LiveHeading(config.heading_span_s, config.base.arc_length.rest_speed_mps, config.base.arc_length.rest_fraction);
  }
  if (!is_same_config(before.base.contact, config.base.contact)) self.contact = CausalContact(config.base.contact);
  if (before.profile.spacing_m != config.profile.spacing_m || !is_same_config(before.base, config.base)) {
    self.begin_profile();
    return;
  }
  if (!is_same_config(before.profile, config.profile)) {
    self.cut();
    self.high_pass =
        CausalHighPass(config.profile.spacing_m, config.profile.cutoff_cycles_per_mm, config.profile.bridge_m);
  }
}

const LiveProfileConfig& LiveProfile::config() const { return impl_->config; }

}  // namespace asperity
