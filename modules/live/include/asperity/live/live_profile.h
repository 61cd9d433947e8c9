#pragma once

#include <memory>

#include "asperity/live/live_config.h"
#include "asperity/live/live_estimate.h"
#include "asperity/recording/calibration.h"
#include "asperity/recording/recording.h"
#include "asperity/recording/recording_appender.h"

namespace asperity {

// The surface profile while it is scanned (thesis §7.2): the causal counterpart of process_recording.h. Rows and poses
// come in the order in which they arrive, poses later than the rows of their time by the tracker's latency; either may
// be lost, repeated, out of order or not finite. The motion is that of the batch's filter, smoothed over a fixed lag
// (docs/live-profile.md), so a point is known at most about 0.2 s after the tip was there, and never changes again.
//
// Memory is bounded by the config's windows but for what estimate() has not yet taken. The same calls give the same
// bytes. Thread-safe: no.
class LiveProfile {
 public:
  // Of `info`: gravity, the converter's range and the nominal rates. Throws Error for a config out of range or a
  // calibration that is singular.
  LiveProfile(const Calibration& calibration, const RecordingInfo& info, const LiveProfileConfig& config = {});
  ~LiveProfile();
  LiveProfile(LiveProfile&&) noexcept;
  LiveProfile& operator=(LiveProfile&&) noexcept;

  // The next row or pose as it arrived. Never throws for what the data hold.
  void push(const ProbeSample& row);
  void push(const TrackerSample& pose);

  // What is new since the last call.
  LiveEstimate estimate();

  // Begins a new profile: s from 0, a new base. The filter continues.
  void restart();

  // New settings from here on; profile and base restart only if the spacing or the base's shape have changed. Throws
  // as the constructor does, and nothing has changed then.
  void configure(const LiveProfileConfig& config);

  const LiveProfileConfig& config() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace asperity
