#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "asperity/base/config.h"
#include "asperity/geometry/motion.h"

namespace asperity {

struct ComplianceConfig {
  double window_s = 0.25;
  double min_speed_mps = 0.005;
  double min_force_N = 0.1;
  int min_windows = 5;

  template <class V>
  void visit(V& v) {
    v.field("window_s", window_s, "length of a window, s", {1e-3, 1e3});
    v.field("min_speed_mps", min_speed_mps, "a slower window does not count, m/s", {1e-6, 10.0});
    v.field("min_force_N", min_force_N, "nor does one with less force, N", {0.0, 1e3});
    v.field("min_windows", min_windows, "fewer give no coefficient", {2, 100000});
  }
};

// One window of the scan.
struct ComplianceWindow {
  double force_N = 0.0;         // mean
  double amplitude_mps2 = 0.0;  // standard deviation of the normal acceleration
  double speed_mps = 0.0;       // along the surface
  double ratio = 0.0;           // force · speed² / amplitude, over its mean
};

struct Compliance {
  double sigma_r2 = std::numeric_limits<double>::quiet_NaN();  // variance of the windows' ratios
  double k_c = std::numeric_limits<double>::quiet_NaN();       // exp(-sigma_r2): 1 stiff, towards 0 soft
  std::vector<ComplianceWindow> windows;                       // those that count
};

// exp(−σ_r²) (seed §5.3, Table 1).
double compliance_coefficient(double sigma_r2);

// The seed's heuristic compliance of a scan whose force goes from light to firm (seed §5.3, erratum 15):
// the unscaled acceleration along the normals `n_world` (one a motion sample) is cut into windows; the
// ratio of a window's mean force to its amplitude of acceleration divided by the squared speed, divided by
// the mean ratio, has the variance σ_r². sigma_r2 and k_c are nan if fewer than min_windows windows are
// fast and firm enough. Throws Error if the sizes differ.
Compliance estimate_compliance(const TipMotion& motion, std::span<const Eigen::Vector3d> n_world,
                               const ComplianceConfig& config);

}  // namespace asperity
