#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "asperity/base/config.h"
#include "asperity/geometry/motion.h"

namespace asperity {

struct ComplianceConfig {
  double window_mm = 4.0;
  double min_cycles_per_mm = 0.5;
  double max_cycles_per_mm = 2.5;
  double min_speed_mps = 0.005;
  double min_force_N = 0.1;
  double min_force_ratio = 3.5;
  double max_stderr = 0.065;
  double softness_sigma = 0.12;
  int min_windows = 8;

  template <class V>
  void visit(V& v) {
    v.field("window_mm", window_mm, "length of a window, mm; windows overlap by half", {0.5, 100.0});
    v.field("min_cycles_per_mm", min_cycles_per_mm, "lowest frequency of the texture that counts", {0.05, 100.0});
    v.field("max_cycles_per_mm", max_cycles_per_mm, "highest frequency of the texture that counts", {0.05, 100.0});
    v.field("min_speed_mps", min_speed_mps, "a slower window does not count, m/s", {1e-6, 10.0});
    v.field("min_force_N", min_force_N, "nor does one with less force, N", {1e-6, 1e3});
    v.field("min_force_ratio", min_force_ratio, "firmest to lightest force from which k_c is always determined",
            {1.5, 1e3});
    v.field("max_stderr", max_stderr, "with less, k_c is determined if its standard error is not above this part of it",
            {1e-4, 1.0});
    v.field("softness_sigma", softness_sigma,
            "what else changes the amplitude with the force (friction, resonance), as a power of the force",
            {0.0, 1.0});
    v.field("min_windows", min_windows, "fewer give no coefficient", {4, 100000});
  }
};

// The forces for which k_c is stated: uniform between these (docs/compliance.md).
inline constexpr double kStandardLightest_N = 0.5;
inline constexpr double kStandardFirmest_N = 1.5;

// One window of the scan that counts.
struct ComplianceWindow {
  double force_N = 0.0;         // mean
  double amplitude_mps2 = 0.0;  // of the normal acceleration in the band, as a standard deviation
  double speed_mps = 0.0;       // along the surface
  double ratio = 0.0;           // force · speed² / amplitude, over the mean of all windows
};

struct Compliance {
  bool determined = false;
  double k_c = std::numeric_limits<double>::quiet_NaN();         // 1 stiff, towards 0 soft, at the standard forces
  double k_c_stderr = std::numeric_limits<double>::quiet_NaN();  // given with data, determined or not
  double k_c_low = std::numeric_limits<double>::quiet_NaN();     // 95 %
  double k_c_high = std::numeric_limits<double>::quiet_NaN();
  double sigma_r2 = std::numeric_limits<double>::quiet_NaN();        // -ln k_c
  double exponent = std::numeric_limits<double>::quiet_NaN();        // of the ratio as a power of the force, at 1 N
  double exponent_error = std::numeric_limits<double>::quiet_NaN();  // its standard error
  double ratio_variance = std::numeric_limits<double>::quiet_NaN();  // of the windows' ratios, scatter included
  double rest_amplitude_mps2 = 0.0;                                  // in the band, taken as noise
  double lightest_N = std::numeric_limits<double>::quiet_NaN();      // of the windows' forces
  double firmest_N = std::numeric_limits<double>::quiet_NaN();
  double lost_fraction = 0.0;  // of the windows, in which the tip left the surface: they do not count
  std::string verdict;         // in words: "determined", or what is missing
  std::vector<ComplianceWindow> windows;
};

// exp(−σ_r²) (seed §5.3, Table 1).
double compliance_coefficient(double sigma_r2);

// σ_r² of a surface on which the amplitude of the acceleration falls with the force as exp(−g (F^p − 1)/p): the
// variance of r = F / amplitude over its squared mean, for forces uniform over the standard range, less that of a rigid
// surface (g = 0, r = F). `softness` g of less than −1 counts as −1, at which r is constant for p towards 0.
double standard_sigma_r2(double softness, double force_power);

// The seed's heuristic compliance of a scan whose force goes from light to firm (seed §5.3, erratum 15), stated for
// standard forces so that it belongs to the surface and the tip, not to the operator's ramp: docs/compliance.md.
// `samples` has accelerations not scaled by the force, best at the probe's own rate; `normal_t_ns` and `n_world` are
// the outward normals and their rising times, each holding until the next.
//
// 1. The normal acceleration is cut into windows of window_mm. Over the squared speed (a = v² h″) its spectrum is that
//    of the curvature of the path that the tip takes; summed over the band, weighted by 1/frequency, less that at rest,
//    it is the power of the window. Windows in which the tip left the surface do not count.
// 2. The power is fitted as a law of the force, fit_force_law.h, for several p. Each p weighs as much as its
//    likelihood.
// 3. k_c = exp(−σ_r²), σ_r² = standard_sigma_r2, its mean over the laws, at most 1. The standard error holds the
//    scatter of the windows, the laws' disagreement outside of the forces that occurred, and softness_sigma.
//
// Determined if the windows' forces span min_force_ratio, or twice with a standard error of at most max_stderr (a
// ramp's ends are lost in the start, the stop and the windows' means, so that a short ramp may show less than it has);
// else `verdict` says what is missing and k_c is nan. Throws Error if sizes differ.
Compliance estimate_compliance(const TipMotion& samples, std::span<const std::int64_t> normal_t_ns,
                               std::span<const Eigen::Vector3d> n_world, const ComplianceConfig& config);

}  // namespace asperity
