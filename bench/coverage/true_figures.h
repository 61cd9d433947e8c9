#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "asperity/pipeline/process_result.h"
#include "asperity/recording/recording.h"

namespace bench {

// The truth's own profile, point by point beside the measured one. Nothing here is the product's code: heights by a
// spline over the true arc length, the high-pass in the frequency domain.
struct TrueProfile {
  double length_m = 0.0;          // true way between the times of the first and the last measured height
  std::vector<double> height_m;   // true height under each point of the measured profile; nan where either has none
  std::vector<double> texture_m;  // the same after the high-pass
  std::vector<double> error_m;    // measured less true heights at the same place of the path, less their common line
  std::vector<double> texture_error_m;         // the result's less the true texture when the tip passed
  std::vector<double> measured_error_m;        // the same before the expected noise was taken out of the texture
  std::vector<double> placed_texture_error_m;  // and at the same place of the path
  double shift_m = 0.0;                        // of the measured arc length, which made both lie best on each other
};

// Each point of the measured profile was passed at a time; the truth is asked for its arc length then. One shift (at
// most 1 mm) for delays of clocks, that of the highest correlation of the textures. Empty heights if the truth has
// none. `measured_texture_m`: the result's texture, point by point, before noise was taken out of it.
TrueProfile find_true_profile(const asperity::Recording& recording, const asperity::ProcessResult& result,
                              std::span<const double> measured_texture_m);

// Zero-phase second-order Butterworth high-pass, gain 1/(1 + (√2 − 1)(cutoff/f)⁴), of each run of finite heights (gaps
// up to bridge_m bridged by straight lines), less its straight line and mirrored at both ends. By FFT.
std::vector<double> high_pass(std::span<const double> height_m, double spacing_m, double cutoff_cycles_per_mm,
                              double bridge_m);

// RMS of error over stated standard deviation of the tip's position, all axes and true times together; nan without.
double position_error_over_sigma(const asperity::Recording& recording, const asperity::TipMotion& motion);
// RMS of error_m over sigma_m where both are.
double error_over_sigma(std::span<const double> error_m, std::span<const double> sigma_m);

// Roughness of heights whose missing ones are nan, straight from the definitions of docs/roughness.md.
struct PlainRoughness {
  double Ra_m = 0.0, Rq_m = 0.0, Rz_m = 0.0, Rt_m = 0.0, Rsk = 0.0, Rku = 0.0;
};
PlainRoughness measure_plain_roughness(std::span<const double> texture_m);

// The period near `pitch_m` (within 8 %) whose first four harmonics hold most of the power; nan without three periods.
double find_true_pitch_m(std::span<const double> texture_m, double spacing_m, double pitch_m);
// The median over whole periods of highest less lowest height; periods with more than 30 % missing do not count.
double measure_depth_m(std::span<const double> height_m, double spacing_m, double pitch_m);

}  // namespace bench
