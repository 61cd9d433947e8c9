#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "asperity/base/nan.h"
#include "asperity/pipeline/process_result.h"
#include "asperity/recording/calibration.h"

namespace asperity {

// What was measured of one stroke, one value a sample of its motion. Heights, velocities and accelerations are those of
// the tip along the outward normal of the base.
struct StrokeSignals {
  std::string name;
  std::vector<double> t_s;               // from 0
  std::vector<double> s_m;               // along the base path
  std::vector<double> speed_mps;         // along it, mean over 0.1 s
  std::vector<double> travel_mps;        // the same, at the sample: a tip lags and springs along the path too
  std::vector<double> height_m;          // over the base
  std::vector<double> climb_mps;         // its rate
  std::vector<double> accel_mps2;        // gravity removed
  std::vector<double> force_N;           // the reading that is compared; nan between two readings
  std::vector<double> normal_N;          // force along the normal (normal_force.h), bridged between readings
  std::vector<double> tangential_N;      // against the travel, of a sensor with three axes; empty: there is none
  std::vector<double> reads_normal;      // the reading is this times the normal force
  std::vector<double> reads_tangential;  // less this times the tangential one
  std::vector<char> usable;              // in contact, and at half the usual speed at least
  double usual_mps = kNan;               // median speed of these
  double rate_Hz = kNan;                 // of the samples
  double force_rate_Hz = kNan;           // of the readings

  std::size_t size() const { return t_s.size(); }
};

// The signals of a processed stroke. The reading that is compared is the force along the normal where the sensor has
// three axes, else the axial reading f = N a·n − T a·t, a the sensor's axis, n the normal, t the direction of travel,
// T the tangential force against it. Throws Error if the result has no base path or no force.
StrokeSignals measure_stroke(const ProcessResult& result, const Calibration& calibration, std::string name);

}  // namespace asperity
