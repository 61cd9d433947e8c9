#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>

#include "asperity/verdict/judge_passes.h"
#include "asperity/verdict/verdict.h"

namespace asperity {

// What a processed scan shows of itself: numbers, no judgement. nan: not known, and then nothing is concluded from it.
struct ScanEvidence {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  // The recording and its calibration.
  bool calibrated = true;
  bool has_force = true;
  double force_ratio = kUnknown;             // measured over predicted, over windows without clipped samples
  double force_difference_share = kUnknown;  // |measured − predicted| over predicted, as vectors, over these
  double clipped_force_ratio = kUnknown;     // as force_ratio, over windows with clipped samples
  // Of the accelerometer's highest octave over its stated white noise, powers; and the frequency from which on it has
  // less than a quarter of it (accelerometer_floor.h).
  double accel_floor_ratio = kUnknown;
  double accel_rounding_ratio = kUnknown;  // of the same power over that of rounding; nan: not rounded to counts
  double accel_quiet_from_Hz = kUnknown;
  double accel_bias_mps2 = kUnknown;
  double latency_s = kUnknown;
  double latency_beyond_prior_s = kUnknown;  // by which the tracker is later than calibrated, from the data alone
  double latency_beyond_prior_sigma_s = kUnknown;
  double latency_change_s = kUnknown;  // by which the tracker becomes later from the first pose to the last
  double latency_change_sigma_s = kUnknown;
  double tracker_scale_error = kUnknown;  // of the tracker's positions against the inertial sensors
  double tracker_scale_error_sigma = kUnknown;
  double tracker_axes_chi2 = kUnknown;     // of a 3×3 error of its positions, 9 degrees of freedom
  double accel_axes_chi2 = kUnknown;       // likewise of the accelerometer's matrix
  double gyro_axes_chi2 = kUnknown;        // likewise of the gyroscope's
  double other_axes_log_ratio = kUnknown;  // log-likelihood that another convention of the tracker's axes gains
  double accel_motion_share = kUnknown;    // unexplained acceleration over the specific force's motion
  double tracker_noise_ratio = kUnknown;   // found over calibrated
  double departure_m = kUnknown;           // of the estimated tip from the poses' tip, median
  double departure_ratio = kUnknown;       // over what the poses' own noise makes
  std::size_t poses_used = 0;
  std::size_t poses_outlying = 0;
  double repeated_share = 0.0;  // of the poses
  double clipped_share = kUnknown;
  std::size_t rows_kept = 0;
  std::size_t rows_dropped = 0;
  std::size_t rows_changed = 0;  // whose bytes are not those that were recorded, by their checksums
  double recorded_s = 0.0;
  double used_s = 0.0;
  double tracker_gap_s = kUnknown;      // interpolated over
  double object_seen_share = kUnknown;  // of the samples, those at which the object's own body was seen
  double object_moved_m = kUnknown;     // its scanned part, from where it was at first
  double object_turned_rad = kUnknown;
  std::size_t samples_rejected = 0;
  std::size_t samples = 0;

  // What was measured. `measured`: the stages after the trajectory were run.
  bool measured = true;
  std::string no_profile;    // why not; empty: there is one
  std::string no_roughness;  // likewise
  std::string no_texture;
  double contact_s = kUnknown;  // time that the tip touched
  double tip_radius_m = 0.0;
  double force_limited_share = 0.0;  // of the force's readings, at the end of its range (force_limit.h)
  double force_limit_N = kUnknown;
  bool reads_no_contact = false;     // there is a calibrated force sensor, and its constant reading is below touching
  double probe_lean_deg = kUnknown;  // of the probe from the normals of the base
  double covered = kUnknown;         // part of the profile that has heights
  double min_coverage = 0.5;
  bool error_known = true;  // the method gives the standard deviation of its heights
  double mean_speed_mps = kUnknown;
  double length_m = kUnknown;  // of the path in contact
  double length_stderr_m = kUnknown;
  double tracker_length_m = kUnknown;  // by the poses alone, over the same times
  double tracker_length_stderr_m = kUnknown;
  double texture_rms_m = kUnknown;
  double noise_rms_m = kUnknown;           // expected in it
  double snr = kUnknown;                   // power of the surface over that of the noise
  double expected_correlation = kUnknown;  // of the texture, noise removed, with the surface
  // A pattern was found whose line stands out of the largest noise that is possible (find_periodicity_under_noise.h)
  // and is one of the path, not of the time (line_over_time.h).
  bool pattern_found = false;
  double stretch_correlation = kUnknown;  // of that, what the error of the path's length leaves
  double end_place_sigma_m = kUnknown;    // of a position at the path's ends, by that error
  double at_most_m = kUnknown;            // upper bound of the surface's RMS, 97.5 %
  // A vibration of one frequency that is not of the surface (find_time_lines.h): the strongest, and the RMS of all.
  double vibration_Hz = kUnknown;
  double vibration_rms_m = 0.0;
  double may_be_hum_Hz = kUnknown;  // a line that could be of the surface, at a multiple of the mains' frequency
  // Passes of the path over one line: that line which contradicts the stated noise the most.
  PassEvidence passes{kUnknown, kUnknown, kUnknown};
  std::size_t sticks = 0;    // times that the tip was held between two slides
  double stuck_share = 0.0;  // of the time in contact
};

// The verdicts on a scan, the worst first; a nothing-touched scan has no other on its surface. The only place that
// decides over one; docs/verdicts.md has the criteria.
Verdicts judge_scan(const ScanEvidence& evidence);

}  // namespace asperity
