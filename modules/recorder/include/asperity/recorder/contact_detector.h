#pragma once

#include <cstdint>
#include <optional>

#include "asperity/recorder/touch_config.h"
#include "asperity/recording/calibration.h"

namespace asperity {

struct ContactChange {
  bool touching = false;
  std::int64_t t_ns = 0;  // of the first sample of the touch, or of its last
};

// Whether the probe touches, sample by sample (thesis §3.3, "Auto"): it does once the force has stayed above the
// upper threshold for `on_hold_s`, and no longer once it has been below the lower one for `off_hold_s`; time above
// the lower threshold takes four times as much off that again.
// With a force calibration the thresholds are in newton. Without one they are multiples of the idle level's
// noise, on either side of it; level and noise are taken from the first `idle_s`, in which the probe must not
// touch; the level follows a drift while it does not.
class ContactDetector {
 public:
  // Throws Error if a lower threshold is above its upper one.
  ContactDetector(const TouchConfig& config, const std::optional<ForceCalibration>& force);

  // The next sample of the force; nan is passed over, and a time that does not rise. What has changed by it.
  std::optional<ContactChange> push(std::int64_t t_ns, double force_counts);

  bool touching() const { return touching_; }
  // False while the idle level is still being taken.
  bool ready() const;

 private:
  enum class Level { kLow, kBetween, kHigh };  // against the two thresholds
  Level level(std::int64_t t_ns, double counts);
  void learn_idle(std::int64_t t_ns, double counts);

  TouchConfig config_;
  std::optional<ForceCalibration> force_;
  bool touching_ = false;
  std::optional<std::int64_t> above_since_ns_;  // while it does not touch
  std::int64_t last_above_ns_ = 0;              // while it touches: when it surely did last
  std::int64_t off_evidence_ns_ = 0;            // while it touches: time below the lower threshold since

  std::optional<std::int64_t> first_ns_;
  std::int64_t last_ns_ = 0;
  std::int64_t idle_count_ = 0;
  double idle_mean_ = 0.0;
  double idle_square_ = 0.0;  // sum of squares about the mean while it is first taken
  double idle_noise_ = 0.0;
  bool idle_known_ = false;
};

}  // namespace asperity
