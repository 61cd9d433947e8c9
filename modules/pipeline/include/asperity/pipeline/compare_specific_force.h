#pragma once

#include <cstddef>
#include <limits>

#include "asperity/recording/recording.h"

namespace asperity {

// The accelerometer against the tracker, over windows. nan: no window allows it.
struct SpecificForceComparison {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  std::size_t windows = 0;             // with poses and without clipped samples
  std::size_t windows_clipped = 0;     // with poses and with clipped samples
  double measured_mps2 = kUnknown;     // length of a window's mean specific force, median
  double predicted_mps2 = kUnknown;    // the same from the poses and gravity
  double ratio = kUnknown;             // measured over predicted, median
  double difference_share = kUnknown;  // |measured − predicted| over predicted, as vectors; median
  double clipped_ratio = kUnknown;     // as `ratio`, over the windows with clipped samples
  double clipped_share = 0.0;          // of the samples
  // The tracker's scale by the windows without clipped samples, less 1, and χ² of a 3×3 error of its positions
  // (motion_windows.h); nan: too few of them, or the sensor's rotation is not known.
  double tracker_scale_error = kUnknown, tracker_scale_error_sigma = kUnknown, tracker_axes_chi2 = kUnknown;
};

// Compares what the accelerometer reads with what the poses and gravity predict, without differentiating the poses.
// With a weight w(t) that vanishes with its slope at both ends of a window (Hann's, squared), integration by parts
// gives
//   ∫ w R f dt = ∫ w (p̈ − g) dt = ∫ ẅ p dt − g ∫ w dt,
// f the specific force in the marker frame, R the marker's orientation, p the accelerometer's position by the poses, g
// gravity. Motion is thereby in both sides, and only scale, signs, axes, clocks and clipping make them differ. Windows
// of 1 s, each 0.5 s, in which no pose is missing for longer than 0.15 s. Without a known rotation of the sensor
// lengths alone are compared, over windows in which the marker rotates by less than 0.5 rad. `tracker_latency_s` and
// `probe_latency_s` are taken off the times.
SpecificForceComparison compare_specific_force(const Recording& recording, double tracker_latency_s,
                                               double probe_latency_s);

}  // namespace asperity
