#include "asperity/live/scan_hints.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

namespace {

struct ScanHintFacts {
  double value = 0.0;
  double highest_speed_mps = 0.0;
  const ScanHintsConfig& config;
};

constexpr double kRadian_deg = 180.0 / std::numbers::pi;

// A hint's severity, numbers and sentences.
Hint describe_hint(HintKind kind, const ScanHintFacts& facts) {
  const ScanHintsConfig& config = facts.config;
  const double value = facts.value;
  Hint hint;
  hint.kind = kind;
  hint.value = value;
  switch (kind) {
    case HintKind::kNoCalibration:
      hint.severity = HintSeverity::kError;
      hint.text = "This probe has no calibration, so no profile can be shown. Calibrate it, or choose its calibration.";
      break;
    case HintKind::kProbeSilent:
      hint.severity = HintSeverity::kError;
      hint.limit = config.silent_s;
      hint.text =
          fmt::format("The probe has been silent for {:.1f} s. Check its cable and that it is switched on.", value);
      break;
    case HintKind::kRowsLost:
      hint.limit = config.rows_lost_share;
      hint.text = fmt::format(
          "{:.1f} % of the probe's rows are lost. Use another cable or port, or close programs that load this "
          "computer.",
          100.0 * value);
      break;
    case HintKind::kMarkerLost:
      hint.severity = value > config.marker_error_s ? HintSeverity::kError : HintSeverity::kWarning;
      hint.limit = config.marker_lost_s;
      hint.text = fmt::format(
          "The marker has been out of sight for {:.1f} s. Point it to the camera and keep your hand away from it.",
          value);
      break;
    case HintKind::kAccelerometerSaturating:
      hint.limit = config.saturated_share;
      hint.text = fmt::format(
          "The accelerometer is at its limit in {:.1f} % of the rows. Scan more slowly or press less.", 100.0 * value);
      break;
    case HintKind::kForceSaturating:
      hint.severity = HintSeverity::kError;
      hint.limit = config.force_headroom;
      hint.text = fmt::format("The force sensor is at {:.0f} % of its range. Press less at once: it can be damaged.",
                              100.0 * value);
      break;
    case HintKind::kTooFast:
      hint.limit = facts.highest_speed_mps;
      hint.text = fmt::format("Too fast for a texture of {:.2g} mm: {:.0f} mm/s. Stay below {:.0f} mm/s.",
                              config.finest_wavelength_mm, 1e3 * value, std::floor(1e3 * facts.highest_speed_mps));
      break;
    case HintKind::kTooLight:
      hint.limit = config.light_N;
      hint.text =
          fmt::format("Too light: {:.2f} N. Press with at least {:.2f} N, so that the tip stays on the surface.", value,
                      config.light_N);
      break;
    case HintKind::kTooHard:
      hint.limit = config.hard_N;
      hint.text = fmt::format("Too hard: {:.1f} N. Press with less than {:.1f} N, to spare the surface and the tip.",
                              value, config.hard_N);
      break;
    case HintKind::kTiltedTooFar:
      hint.limit = config.tilt_deg / kRadian_deg;
      hint.text = fmt::format(
          "The probe is tilted by {:.0f} degrees from the surface's normal. Hold it upright, within {:.0f} degrees.",
          kRadian_deg * value, config.tilt_deg);
      break;
    case HintKind::kTiltingTooFast:
      hint.limit = config.tilt_rate_degps / kRadian_deg;
      hint.text =
          fmt::format("The probe is rotating at {:.0f} degrees/s. Keep its angle steady, below {:.0f} degrees/s.",
                      kRadian_deg * value, config.tilt_rate_degps);
      break;
    case HintKind::kDoublingBack:
      hint.limit = config.doubling_back_m;
      hint.text = fmt::format(
          "The path goes back over itself by {:.1f} mm. Scan in one direction; lift the probe or begin a new segment "
          "to "
          "return.",
          1e3 * value);
      break;
  }
  return hint;
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr double kStroke_m = 10e-3;
constexpr double kStrokeBegun_m = 3e-3;  // before, a turn is only how the stroke finds its way
constexpr double kFollowPeriod = 0.02;   // a row
constexpr double kBand = 0.4;            // of the rate: what the comparison's band allows (compare_profiles.h)

double duration_s_of(std::int64_t ns) { return static_cast<double>(ns) * 1e-9; }

}  // namespace

ScanAdvisor::ScanAdvisor(const Calibration& calibration, const RecordingInfo& info, const ScanHintsConfig& config,
                         bool calibrated)
    : calibration_(calibration), info_(info), config_(config), calibrated_(calibrated) {
  configure(config);
}

void ScanAdvisor::configure(const ScanHintsConfig& config) {
  if (config.light_N > config.hard_N) {
    throw Error("hints: light_N " + number_text(config.light_N) + " is above hard_N " + number_text(config.hard_N));
  }
  config_ = config;
}

void ScanAdvisor::restart() {
  stroke_.setZero();
  stroke_m_ = back_m_ = 0.0;
  of(HintKind::kDoublingBack) = {};
}

double ScanAdvisor::highest_speed_mps() const {
  const double wave_m = 1e-3 * config_.finest_wavelength_mm;
  double limit_mps = kInfinity;
  if (info_.probe_rate_Hz > 0.0) {
    limit_mps = wave_m * info_.probe_rate_Hz / std::max(config_.samples_per_wave, 1.0 / kBand);
  }
  if (info_.tracker_rate_Hz > 0.0 && config_.wavelength_periods_of_tracker > 0.0) {
    limit_mps = std::min(limit_mps, wave_m * info_.tracker_rate_Hz / config_.wavelength_periods_of_tracker);
  }
  return limit_mps;
}

// `beyond`: worse than the limit. `better`: so far on the good side of it that the hint may go.
void ScanAdvisor::judge(HintKind kind, std::int64_t t_ns, bool beyond, bool better, double value) {
  Condition& c = of(kind);
  c.value = value;
  if (beyond) {
    if (!c.held) c.held_since_ns = t_ns;
    c.held = true;
    c.better_since_ns = 0;
  } else if (better || !c.shown) {
    if (c.held) c.better_since_ns = t_ns;
    c.held = false;
  }
}

// The probe's own period, which may differ from the nominal one, tells how many rows a step stands for.
void ScanAdvisor::count_lost(double step_s) {
  if (period_s_ == 0.0) period_s_ = info_.probe_rate_Hz > 0.0 ? 1.0 / info_.probe_rate_Hz : step_s;
  // Stamps of arrival scatter: a step within the scatter is none lost.
  const double usual_s = std::clamp(step_s, 0.5 * period_s_, 1.5 * period_s_);
  const double lost = step_s > 1.6 * period_s_ + 6.0 * scatter_s_ ? std::round(step_s / period_s_) - 1.0 : 0.0;
  scatter_s_ += kFollowPeriod * (std::abs(usual_s - period_s_) - scatter_s_);
  lost_.add(lost / (lost + 1.0), step_s, config_.window_s);
  period_s_ += kFollowPeriod * (usual_s - period_s_);
}

void ScanAdvisor::push(const ProbeSample& row) {
  if (newest_row_ns_ && row.t_ns <= *newest_row_ns_) return;
  const double step_s = newest_row_ns_ ? duration_s_of(row.t_ns - *newest_row_ns_) : 0.0;
  if (newest_row_ns_ && step_s < config_.silent_s) count_lost(step_s);
  newest_row_ns_ = row.t_ns;
  const double keep = config_.window_s;
  if (info_.adc_max > info_.adc_min) {
    const bool clipped =
        (row.accel_counts.array() <= info_.adc_min).any() || (row.accel_counts.array() >= info_.adc_max).any();
    clipped_.add(clipped ? 1.0 : 0.0, step_s, keep);
    const double limit = config_.saturated_share;
    judge(HintKind::kAccelerometerSaturating, row.t_ns, clipped_.mean > limit,
          clipped_.mean < limit * (1.0 - config_.hysteresis), clipped_.mean);
    if (std::isfinite(row.force_counts)) {
      // Of the range on the side of a growing force.
      const bool grows = calibration_.force.newton_per_count >= 0.0;
      const double zero = calibrated_ && calibration_.force.newton_per_count != 0.0
                              ? -calibration_.force.offset_newton / calibration_.force.newton_per_count
                              : 0.5 * (info_.adc_max + info_.adc_min);
      const double end = grows ? info_.adc_max : info_.adc_min;
      const double share = end != zero ? (row.force_counts - zero) / (end - zero) : 0.0;
      judge(HintKind::kForceSaturating, row.t_ns, share >= config_.force_headroom,
            share < config_.force_headroom * (1.0 - config_.hysteresis), share);
    }
  }
  const double limit = config_.rows_lost_share;
  const double share = lost_.mean;
  judge(HintKind::kRowsLost, row.t_ns, share > limit, share < limit * (1.0 - config_.hysteresis), share);
}

void ScanAdvisor::push(const TrackerSample& pose) {
  if (newest_pose_ns_ && pose.t_ns <= *newest_pose_ns_) return;
  newest_pose_ns_ = pose.t_ns;
}

void ScanAdvisor::push(const LiveEstimate& estimate) {
  for (const LiveTip& tip : estimate.tips) judge_tip(tip);
}

// What the motion alone shows.
void ScanAdvisor::judge_tip(const LiveTip& tip) {
  const double step_s = last_tip_ ? std::max(0.0, duration_s_of(tip.t_ns - last_tip_->t_ns)) : 0.0;
  const double hysteresis = config_.hysteresis;
  const bool touching = tip.contact;
  speed_.add(touching ? tip.speed_mps : 0.0, step_s, config_.window_s);
  const double fastest_mps = highest_speed_mps();
  judge(HintKind::kTooFast, tip.t_ns, speed_.mean > fastest_mps, speed_.mean < fastest_mps * (1.0 - hysteresis),
        speed_.mean);

  // A force between the two says that the tip is meant to touch; in the air there is nothing to say.
  if (std::isfinite(tip.force_N)) {
    const bool moving = touching && tip.speed_mps > kMoving_mps;
    touch_force_.add(tip.force_N, moving ? step_s : 0.0, config_.window_s);
    const double mean_N = touch_force_.mean;
    judge(HintKind::kTooLight, tip.t_ns, moving && mean_N < config_.light_N,
          !touching || mean_N > config_.light_N * (1.0 + hysteresis), mean_N);
    judge(HintKind::kTooHard, tip.t_ns, touching && mean_N > config_.hard_N,
          !touching || mean_N < config_.hard_N * (1.0 - hysteresis), mean_N);
  }
  if (std::isfinite(tip.tilt_rad)) {
    const double tilt_deg = tip.tilt_rad / kDegree;
    judge(HintKind::kTiltedTooFar, tip.t_ns, touching && tilt_deg > config_.tilt_deg,
          !touching || tilt_deg < config_.tilt_deg * (1.0 - hysteresis), tip.tilt_rad);
  }
  if (last_tip_ && step_s > 0.0) {
    const double cosine = std::clamp(tip.probe_axis_world.dot(last_tip_->probe_axis_world), -1.0, 1.0);
    turning_.add(std::acos(cosine) / step_s, step_s, config_.window_s);
    const double limit = config_.tilt_rate_degps * kDegree;
    judge(HintKind::kTiltingTooFast, tip.t_ns, touching && turning_.mean > limit,
          !touching || turning_.mean < limit * (1.0 - hysteresis), turning_.mean);
  }
  check_path(tip);
  last_tip_ = tip;
}

// How far the tip has gone back along the stroke that it began.
void ScanAdvisor::check_path(const LiveTip& tip) {
  if (tip.contact && last_tip_ && last_tip_->contact && !tip.heading_world.isZero()) {
    const double step_m = std::max(0.0, tip.heading_world.dot(tip.p_world_tip_m - last_tip_->p_world_tip_m));
    const bool back = stroke_.dot(tip.heading_world) < -0.5;
    if (stroke_.isZero() || (back && stroke_m_ < kStrokeBegun_m)) {
      stroke_ = tip.heading_world;
      stroke_m_ = back_m_ = 0.0;
    } else if (back) {
      back_m_ += step_m;
    } else {
      // The stroke's direction is that of its last centimetre.
      back_m_ = std::max(0.0, back_m_ - step_m);
      stroke_m_ += step_m;
      if (stroke_m_ > 0.0) {
        stroke_ += std::min(1.0, step_m / std::min(stroke_m_, kStroke_m)) * (tip.heading_world - stroke_);
      }
      if (stroke_.norm() > 0.0) stroke_.normalize();
    }
  } else if (!tip.contact) {
    stroke_.setZero();
    stroke_m_ = back_m_ = 0.0;
  }
  judge(HintKind::kDoublingBack, tip.t_ns, back_m_ > config_.doubling_back_m,
        back_m_ < config_.doubling_back_m * (1.0 - config_.hysteresis), back_m_);
}

std::vector<Hint> ScanAdvisor::hints(std::int64_t now_ns) {
  if (!begun_ns_) begun_ns_ = now_ns;
  judge(HintKind::kNoCalibration, now_ns, !calibrated_, calibrated_, 0.0);
  // Before the first row or pose the wait counts from the first question.
  const double row_age_s = duration_s_of(now_ns - newest_row_ns_.value_or(*begun_ns_));
  judge(HintKind::kProbeSilent, now_ns, row_age_s > config_.silent_s, row_age_s < 0.5 * config_.silent_s, row_age_s);
  const double pose_age_s = duration_s_of(now_ns - newest_pose_ns_.value_or(*begun_ns_));
  judge(HintKind::kMarkerLost, now_ns, pose_age_s > config_.marker_lost_s, pose_age_s < 0.75 * config_.marker_lost_s,
        pose_age_s);

  std::vector<Hint> out;
  for (std::size_t k = 0; k < conditions_.size(); ++k) {
    const auto kind = static_cast<HintKind>(k);
    Condition& c = conditions_[k];
    // What is judged by its own time need not hold for longer still.
    const bool timed =
        kind == HintKind::kNoCalibration || kind == HintKind::kProbeSilent || kind == HintKind::kMarkerLost;
    const double appear_s = timed ? 0.0 : config_.appear_s;
    if (!c.shown && c.held && duration_s_of(now_ns - c.held_since_ns) >= appear_s) {
      c.shown = true;
      c.shown_since_ns = now_ns;
      c.worst = c.value;
    } else if (c.shown && !c.held && duration_s_of(now_ns - c.better_since_ns) >= config_.vanish_s &&
               duration_s_of(now_ns - c.shown_since_ns) >= config_.shown_s) {
      c.shown = false;
    }
    if (!c.shown) continue;
    // A hint that is only still shown tells what it was shown for.
    if (c.held) c.worst = c.value;
    const ScanHintFacts facts{c.worst, highest_speed_mps(), config_};
    Hint hint = describe_hint(kind, facts);
    hint.since_ns = c.held_since_ns;
    out.push_back(std::move(hint));
  }
  std::stable_sort(out.begin(), out.end(), [](const Hint& a, const Hint& b) { return a.severity > b.severity; });
  return out;
}

}  // namespace asperity
