#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "asperity/base/config.h"
#include "asperity/geometry/motion.h"

namespace asperity {

struct ComplianceConfig {
  double window_s = 0.5;
  double min_speed_mps = 0.005;
  double min_force_N = 0.1;
  double min_force_ratio = 2.0;
  int min_windows = 5;

  template <class V>
  void visit(V& v) {
    v.field("window_s", window_s, "length of a window, s; windows overlap by half", {1e-3, 1e3});
    v.field("min_speed_mps", min_speed_mps, "a slower window does not count, m/s", {1e-6, 10.0});
    v.field("min_force_N", min_force_N, "nor does one with less force, N", {1e-6, 1e3});
    v.field("min_force_ratio", min_force_ratio, "firmest to lightest window; with less there is no coefficient",
            {1.0, 1e3});
    v.field("min_windows", min_windows, "fewer give no coefficient", {3, 100000});
  }
};

// One window of the scan that counts.
struct ComplianceWindow {
  double force_N = 0.0;         // mean
  double amplitude_mps2 = 0.0;  // of the normal acceleration, as a standard deviation
  double speed_mps = 0.0;       // along the surface
  double ratio = 0.0;           // force · speed² / amplitude, over the mean of all windows
};

struct Compliance {
  double sigma_r2 = std::numeric_limits<double>::quiet_NaN();        // variance of the ratio that goes with the force
  double k_c = std::numeric_limits<double>::quiet_NaN();             // exp(-sigma_r2): 1 stiff, towards 0 soft
  double exponent = std::numeric_limits<double>::quiet_NaN();        // of the ratio as a power of the force
  double exponent_error = std::numeric_limits<double>::quiet_NaN();  // its standard error
  double ratio_variance = std::numeric_limits<double>::quiet_NaN();  // of the windows' ratios, scatter included
  double rest_amplitude_mps2 = 0.0;                                  // subtracted from each, in squares
  std::vector<ComplianceWindow> windows;
};

// exp(−σ_r²) (seed §5.3, Table 1).
double compliance_coefficient(double sigma_r2);

// The seed's heuristic compliance of a scan whose force goes from light to firm (seed §5.3, erratum 15).
// `samples` has accelerations not scaled by the force, best at the probe's own rate; `normal_t_ns` and
// `n_world` are the outward normals and their rising times, each holding until the next.
//
// The normal acceleration is cut into windows. A window's amplitude is half the distance of its 10th and
// 90th percentiles, as a standard deviation, less that at rest in squares; divided by the squared speed it no
// longer depends on the speed (a = v² h″). The ratio of the mean force to it, over its mean, is unitless. Its
// variance would be that of the surface's own irregularity too; the seed's hypothesis is about the ratio
// "depending on the applied force", so σ_r² is the variance of the power of the force fitted to the
// ratios by least squares of logarithms. A ratio that does not depend on the force gives k_c = 1.
// The results are nan if there are fewer than min_windows windows fast (also at least half the usual
// speed) and firm enough, or their forces differ too little. Throws Error if sizes differ.
Compliance estimate_compliance(const TipMotion& samples, std::span<const std::int64_t> normal_t_ns,
                               std::span<const Eigen::Vector3d> n_world, const ComplianceConfig& config);

}  // namespace asperity
