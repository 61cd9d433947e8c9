#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/live/live_estimate.h"
#include "asperity/live/scan_hints_config.h"
#include "asperity/recording/calibration.h"
#include "asperity/recording/recording.h"
#include "asperity/recording/recording_appender.h"

namespace asperity {

enum class HintKind {
  kNoCalibration,
  kProbeSilent,
  kRowsLost,
  kMarkerLost,
  kAccelerometerSaturating,
  kForceSaturating,
  kTooFast,
  kTooLight,
  kTooHard,
  kTiltedTooFar,
  kTiltingTooFast,
  kDoublingBack,
};
inline constexpr std::array<std::string_view, 12> kHintKindNames{
    "no_calibration", "probe_silent", "rows_lost", "marker_lost",    "accelerometer_saturating", "force_saturating",
    "too_fast",       "too_light",    "too_hard",  "tilted_too_far", "tilting_too_fast",         "doubling_back"};

// kWarning: the scan is worse than it could be. kError: what is scanned now gives no profile.
enum class HintSeverity { kWarning, kError };
inline constexpr std::array<std::string_view, 2> kHintSeverityNames{"warning", "error"};

// One thing that an operator can act on now.
struct Hint {
  HintKind kind = HintKind::kNoCalibration;
  HintSeverity severity = HintSeverity::kWarning;
  std::string text;           // a plain sentence or two: the number with its unit, and what to do
  double value = 0.0;         // measured, SI
  double limit = 0.0;         // that it is beside, SI
  std::int64_t since_ns = 0;  // data time at which it began
};

// What an operator should do differently, from the sensors' own rows and the live estimate, all in data time. Each
// hint comes after its condition has held for a minimum time, goes after it has been better than a lower threshold
// for another, and is shown for a minimum time, so that none flickers. Thread-safe: no.
class ScanAdvisor {
 public:
  // Throws Error for a config out of range. `calibrated` false: only what needs no calibration is judged.
  ScanAdvisor(const Calibration& calibration, const RecordingInfo& info, const ScanHintsConfig& config = {},
              bool calibrated = true);

  void push(const ProbeSample& row);
  void push(const TrackerSample& pose);
  void push(const LiveEstimate& estimate);

  // The hints at `now_ns`, of the clock of the rows' times (the newest row's if there is no clock); the gravest first,
  // then in the order of HintKind.
  std::vector<Hint> hints(std::int64_t now_ns);

  // The speed below which the required texture is resolved, m/s; infinite if nothing limits it.
  double highest_speed_mps() const;

  // A new stroke or segment: the direction of travel and the path behind are forgotten.
  void restart();

  void configure(const ScanHintsConfig& config);

 private:
  struct Condition {
    bool held = false;  // worse than its limit, or not yet better by the hysteresis while it is shown
    bool shown = false;
    std::int64_t held_since_ns = 0;
    std::int64_t shown_since_ns = 0;
    std::int64_t better_since_ns = 0;
    double value = 0.0;
    double worst = 0.0;  // the value that it is shown with
  };
  // A mean over the last `window_s`, exponentially weighted; while less than that has come, over all.
  struct RunningMean {
    double mean = 0.0;
    double span_s = 0.0;
    void add(double value, double step_s, double window_s) {
      span_s = std::min(span_s + step_s, window_s);
      mean += (span_s > 0.0 ? std::min(1.0, step_s / span_s) : 1.0) * (value - mean);
    }
  };

  Condition& of(HintKind kind) { return conditions_[static_cast<std::size_t>(kind)]; }
  void judge(HintKind kind, std::int64_t t_ns, bool beyond, bool better, double value);
  void count_lost(double step_s);
  void judge_tip(const LiveTip& tip);
  void check_path(const LiveTip& tip);

  static constexpr double kMoving_mps = 2e-3;

  Calibration calibration_;
  RecordingInfo info_;
  ScanHintsConfig config_;
  bool calibrated_ = true;
  std::array<Condition, kHintKindNames.size()> conditions_{};

  std::optional<std::int64_t> begun_ns_, newest_row_ns_, newest_pose_ns_;
  double period_s_ = 0.0;   // of the rows
  double scatter_s_ = 0.0;  // mean deviation of a step from it
  RunningMean clipped_, lost_, speed_, touch_force_, turning_;
  std::optional<LiveTip> last_tip_;
  Eigen::Vector3d stroke_ = Eigen::Vector3d::Zero();  // direction of the stroke under way; zero: none
  double stroke_m_ = 0.0;                             // its length so far
  double back_m_ = 0.0;
};

}  // namespace asperity
