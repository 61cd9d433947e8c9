#pragma once

#include <cstddef>
#include <limits>

#include "asperity/profile/profile.h"
#include "asperity/rig/sine_grating.h"

namespace asperity {

// A profile compared with the sine that was scanned. Values for which it is too short are nan.
struct GratingMetrics {
  double pitch_m = std::numeric_limits<double>::quiet_NaN();
  double pitch_stderr_m = std::numeric_limits<double>::quiet_NaN();
  double depth_m = std::numeric_limits<double>::quiet_NaN();  // by the fundamental's amplitude
  double depth_stderr_m = std::numeric_limits<double>::quiet_NaN();
  double along_rms_m = std::numeric_limits<double>::quiet_NaN();  // of the arc length beside the grating's, by window
  double start_m = 0.0;                                           // of the part that was compared
  double length_m = 0.0;                                          // of it
  double length_error_m = std::numeric_limits<double>::quiet_NaN();  // by how much it was measured too long
  double shape_rms_m = std::numeric_limits<double>::quiet_NaN();     // texture_m less the traced sine, after the best
                                                                     // shift and stretch
  double correlation = std::numeric_limits<double>::quiet_NaN();     // of the two
  std::size_t windows = 0;
};

// In windows of two periods without gaps, one after another, heights are a + b s + c cos ks + d sin ks by least
// squares; k belongs to `found_pitch_m`, that of find_periodicity. The line through the fundamental's phases gives the
// pitch and where the sine lies; their residuals, as lengths, are along_rms_m. The depth is twice the mean amplitude,
// over TracedSine::fundamental_share: white noise of standard deviation σ adds about σ²/(amplitude · points of a
// window) to it, where the difference of highest and lowest point would grow by some σ. Standard errors are from the
// scatter of the windows. Fewer than four windows: nothing. Throws Error as TracedSine.
GratingMetrics measure_grating(const Profile& profile, double found_pitch_m, const SineGratingConfig& sine,
                               double tip_radius_m);

}  // namespace asperity
