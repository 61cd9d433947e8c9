#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "asperity/base/config.h"
#include "asperity/base/nan.h"
#include "asperity/geometry/motion.h"
#include "asperity/profile/base_path.h"

namespace asperity {

struct FrictionConfig {
  double window_s = 0.1;
  double min_speed_mps = 5e-3;
  double min_force_N = 0.1;
  double offset_sigma_N = 0.01;
  double alignment_sigma_rad = 0.01;
  double stick_speed_mps = 1e-3;
  double min_stick_s = 0.02;
  double max_stderr = 0.05;
  int min_windows = 6;

  template <class V>
  void visit(V& v) {
    v.field("window_s", window_s, "length of a window, s", {0.01, 10.0});
    v.field("min_speed_mps", min_speed_mps, "a slower window does not count as sliding, m/s", {1e-6, 10.0});
    v.field("min_force_N", min_force_N, "samples with a smaller normal force do not count, N", {1e-6, 1e3});
    v.field("offset_sigma_N", offset_sigma_N, "standard deviation of the force sensor's offset along the surface, N",
            {0.0, 100.0});
    v.field("alignment_sigma_rad", alignment_sigma_rad,
            "standard deviation of the force sensor's axes and of the normal along the path, rad", {0.0, 1.0});
    v.field("stick_speed_mps", stick_speed_mps, "a tip slower than this sticks, m/s", {1e-6, 1.0});
    v.field("min_stick_s", min_stick_s, "if it does so for this time, s", {1e-3, 10.0});
    v.field("max_stderr", max_stderr,
            "largest standard error of a determined coefficient; a quarter of the coefficient where that is more",
            {1e-4, 10.0});
    v.field("min_windows", min_windows, "fewer windows give no coefficient", {3, 100000});
  }
};

// A window of the scan in which the tip slid.
struct FrictionWindow {
  double coefficient = 0.0;
  double speed_mps = 0.0;  // along the surface, mean
  double force_N = 0.0;    // normal, mean
};

// µ(v) = sliding + (at_rest − sliding) exp(−v / speed_mps).
struct StribeckLaw {
  double at_rest = kNan;
  double sliding = kNan;
  double speed_mps = kNan;
};

struct FrictionEstimate {
  bool determined = false;
  double coefficient = kNan;     // of sliding, at speed_mps and force_N; nan without three axes
  double standard_error = kNan;  // given with data, determined or not
  double low = kNan;             // 95 %
  double high = kNan;
  double speed_mps = kNan;  // median over the windows
  double force_N = kNan;
  double per_mps = kNan;  // slope of the coefficient by speed
  double per_mps_stderr = kNan;
  double per_log_force = kNan;  // slope by the logarithm of the normal force
  double per_log_force_stderr = kNan;
  std::optional<StribeckLaw> stribeck;  // where the speeds show one
  double spread_rad = kNan;             // interquartile range of the friction angle
  double sensor_delay_s = kNan;         // time constant by which the force follows the slope
  std::size_t sticks = 0;               // between two times of sliding
  double stuck_share = 0.0;             // of the time in contact, in these
  double breakaway = kNan;              // coefficient at the end of a stick, mean; of at least three
  double breakaway_stderr = kNan;
  // Coefficient of sticking over that of sliding, at least 1: by `breakaway`, or else by the law's `at_rest`. A lower
  // bound: the sensor sees the peak late. nan: not measured.
  double static_ratio = kNan;
  double static_ratio_stderr = kNan;  // by the breakaway's and the coefficient's; nan by the law
  std::string verdict;                // in words: "determined", or what is missing
  std::vector<FrictionWindow> windows;
};

// The coefficient of friction between tip and surface from a force sensor of three axes (docs/friction.md).
//
// A tip that slides over a facet which rises by the angle σ in the direction of travel feels Coulomb's friction against
// its way along the facet. With N = n·F and T = −t·F, n the outward normal of the base and t the direction of travel,
//   atan2(T, N) = atan µ + σ,
// and the way of the tip itself gives the slope: tan σ = n·v / t·v. The sum of T over the sum of N does not give µ: on
// a rough surface the tip presses harder where it climbs. The force sensor is slower than the motion; the slope is
// therefore smoothed by a pole whose time constant makes the angles' interquartile range least.
//
// The estimate is the median over windows of the median friction angle. Its standard error holds the windows' scatter
// (with their correlation), the sensor's offset and alignment, and twice the difference between medians and means of
// the windows: where the tip runs against edges the two disagree, and so do both with µ.
//
// `contact` has one entry a sample of `motion`. Throws Error if the sizes differ.
FrictionEstimate estimate_friction(const TipMotion& motion, const BasePath& path, std::span<const char> contact,
                                   const FrictionConfig& config);

}  // namespace asperity
