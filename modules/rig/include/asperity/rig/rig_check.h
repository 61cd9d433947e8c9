#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "asperity/recording/inspection.h"
#include "asperity/rig/measure_grating.h"
#include "asperity/verdict/verdict.h"

namespace asperity {

// One stroke over the grating, processed as `process` does.
struct RigStroke {
  std::string name;
  bool measured = false;  // false: `why_not` states why
  std::string why_not;
  Verdicts verdicts;  // of the stroke as a scan (judge_scan.h); empty if not measured
  GratingMetrics grating;
  double median_depth_m = std::numeric_limits<double>::quiet_NaN();  // find_periodicity's, of highest and lowest points
  double Rq_m = std::numeric_limits<double>::quiet_NaN();
  double speed_mps = std::numeric_limits<double>::quiet_NaN();
  double latency_s = std::numeric_limits<double>::quiet_NaN();  // as the stroke has it, less the calibrated one
  double accel_bias_mps2 = std::numeric_limits<double>::quiet_NaN();
  double tracker_noise_ratio = std::numeric_limits<double>::quiet_NaN();  // found over calibrated
  double outlying_share = std::numeric_limits<double>::quiet_NaN();       // of the poses
  double gravity_share = std::numeric_limits<double>::quiet_NaN();  // static: the accelerometer's reading over gravity
  double gravity_angle_rad = std::numeric_limits<double>::quiet_NaN();  // static: of its up to the world's
  Inspection inspection;
};

// A value over the strokes that have it.
struct RepeatedMeasurement {
  std::size_t count = 0;
  double mean = std::numeric_limits<double>::quiet_NaN();
  double deviation = std::numeric_limits<double>::quiet_NaN();   // standard, with n − 1; nan below two
  double half_width = std::numeric_limits<double>::quiet_NaN();  // of the mean's 95 % interval by Student's t
};

struct RigCheck {
  std::vector<RigStroke> strokes;
  RepeatedMeasurement pitch_m, depth_m, Rq_m, shape_rms_m, along_rms_m, correlation, latency_s;
  RepeatedMeasurement gravity_share, gravity_angle_rad;  // static: length over gravity, angle to up
  RepeatedMeasurement tracker_noise_ratio, outlying_share, lost_share;
  double median_gravity_angle_rad = std::numeric_limits<double>::quiet_NaN();
  double median_noise_ratio = std::numeric_limits<double>::quiet_NaN();
  double true_Rq_m = 0.0;  // of the traced sine
  Verdicts verdicts;       // the worst first (judge_rig.h)
  bool right = false;      // none is invalid
  std::string verdict;     // the list as one sentence
};

}  // namespace asperity
