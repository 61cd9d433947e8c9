#pragma once

#include <vector>

#include "asperity/base/nan.h"
#include "asperity/profile/time_line.h"

namespace asperity {

// What one axis of the motion of an object that moves leaves in the heights (docs/moving-object.md): a smoothed path of
// white acceleration, from poses with white noise, and the tracker's slow error.
struct ObjectAxisError {
  double weight = 0.0;      // mean square of the height's error over the axis' own; m²/rad² for a rotation
  double pose_psd = 0.0;    // m²/Hz or rad²/Hz, one-sided
  double motion_psd = 0.0;  // of the acceleration, (m/s²)²/Hz or (rad/s²)²/Hz, one-sided
  double slow_sigma = 0.0;  // m or rad
};

// The errors of a motion that go into heights, as densities over time frequency, one-sided and white. What is 0 is not
// known.
struct HeightErrors {
  double accel_psd_m2ps3 = 0.0;        // of the acceleration along the normal, (m/s²)²/Hz
  double tracker_psd_m2ps = 0.0;       // of the tracker along the normal, m²/Hz
  double accel_own_psd_m2ps3 = 0.0;    // of the first, the sensor's own; the rest comes with the contact
  double along_accel_psd_m2ps3 = 0.0;  // the same two along the path
  double along_tracker_psd_m2ps = 0.0;
  double scale_sigma = 0.0;        // relative, of all heights
  double along_scale_sigma = 0.0;  // relative, of the arc length
  double stretch_sigma = 0.0;      // likewise, what of it moves heights from their positions
  double along_sigma_m = 0.0;      // of a place along the path, by the motion's covariance; 0: not known
  double length_ends_m = 0.0;      // of the arc length, by the places of its ends (measure_length_error.h)
  // What is not white (height_error_density.h).
  double accel_corner_Hz = 0.0;        // below it the acceleration's noise grows as 1/f
  double accel_corner_sigma_Hz = 0.0;  // where rests have shown it (noise_at_rest.h)
  double accel_walk_psd_m2ps5 = 0.0;   // of its offset's random walk: density of the offset's rate
  double tracker_slow_sigma_m = 0.0;   // of the tracker's slow error along the normal, first order
  double tracker_slow_time_s = 0.0;
  // Of the orientation, rad²/Hz: the tracker's, the gyroscope's (rad/s)²/Hz, or without one that of the angular
  // acceleration; with the specific force across the normal and the lever from sensor to tip, which it turns.
  double rotation_tracker_psd_rad2ps = 0.0;
  double rotation_rate_psd_rad2ps3 = 0.0;
  double rotation_accel_psd_rad2ps5 = 0.0;
  double force_across_mps2 = 0.0;
  double lever_m = 0.0;
  // What a base that is fitted to the same path takes of the error: a polynomial of this degree (a circle's radius: 2).
  int base_degree = 1;
  std::vector<ObjectAxisError> object;        // empty: the object is at rest in the world
  std::vector<ObjectAxisError> along_object;  // of places along the path
  double object_slow_time_s = 1.0;
  std::vector<double> crosstalk_Hz;  // of the density of what calibration errors carry from the motion into the height
  std::vector<double> crosstalk_m2ps;
  // Of the sway across the path times the variance of the normals' lean, at the same frequencies. All of it comes from
  // one angle that is not known: the error is one draw of it times the sway.
  std::vector<double> leaning_m2ps;
};

// What of a profile's texture is expected to be error and not surface (docs/texture-noise.md). Nothing is determined
// (nan, empty) where the method gives no noise.
struct TextureNoise {
  std::vector<double> frequency_cycles_per_mm;
  // One-sided densities of the error of texture_m, m²/(cycles/mm), means over the profile: of noise that is added to
  // the heights, and of heights at a wrong place along the path.
  std::vector<double> added_psd_m2_mm;
  std::vector<double> misplaced_psd_m2_mm;
  // Of the first, what the normals' lean carries from the sway across the path: an unknown angle times a known motion.
  // The angle's mean is 0 (estimate_lean), so this part is in the error but not expected in the heights. Empty: none.
  std::vector<double> carried_psd_m2_mm;
  // The same two point by point, standard deviations; empty: the same everywhere.
  std::vector<double> added_sigma_m;
  std::vector<double> misplaced_sigma_m;
  // Of height_m less its straight line, without what is in the texture: it remains where the texture's noise is
  // removed.
  std::vector<double> slow_sigma_m;
  // Of texture_m as it is given, over the points that have a height: of both, or what the removal of noise has left of
  // it (apply_wiener_filter.h).
  double noise_rms_m = kNan;
  double noise_rms_stderr_m = kNan;
  double added_rms_m = kNan;  // of the first alone: what biases Rq upwards
  double added_rms_stderr_m = kNan;
  double place_sigma_m = kNan;    // standard deviation of the place along the path
  double texture_rms_m = kNan;    // as measured: surface and noise, none removed
  double length_stderr_m = kNan;  // of the profile's length, from first to last height
  // The part of the added noise that comes with the contact, RMS: it may go with the surface or against it.
  double contact_rms_m = 0.0;
  double stretch_sigma = 0.0;  // relative, of the texture's power: what heights at a wrong place do to it
  double scale_sigma = 0.0;    // relative error of all heights: calibration, the normal's direction
  double along_sigma = 0.0;    // relative error of lengths along the path
  // Of that, the part that lasts along the path, which moves the ends against each other by `end_place_sigma_m` from
  // their positions; and the correlation that it leaves of the expected texture with the true one
  // (correlation_under_stretch.h).
  double end_place_sigma_m = kNan;
  double stretch_correlation = kNan;
  // Without the tenth of the path where the noise is largest, as at slow ends and rests; the two densities have these
  // powers: of the measured texture, of added noise, of misplaced heights.
  double typical_texture_rms_m = kNan;
  double typical_added_rms_m = kNan;
  double typical_misplaced_rms_m = kNan;
  // Power of the surface over power of the noise, of those: typical_texture² − typical_added² over the noise's; 0 where
  // negative. A correlation of the texture with the true one of about √(snr/(1 + snr)) goes with it, also where noise
  // was removed.
  double snr = kNan;
  double snr_low = kNan;           // with the largest noise that is possible, 97.5 %
  double measured_snr_low = kNan;  // the same, none removed, the added noise alone
  // Where noise was removed: the correlation with the surface that the expected texture has by its own RMS t and its
  // noise e, t/√(t² + e²), times `stretch_correlation`. It counts frequency by frequency, so a line that stands out of
  // noise which is as strong in all is seen.
  double expected_correlation = kNan;
  std::vector<TimeLine> time_lines;  // vibrations of one frequency (find_time_lines.h), in the added noise
  // The RMS that the surface's texture has at most, with 97.5 % of the noises that are possible.
  double at_most_m = kNan;
};

}  // namespace asperity
