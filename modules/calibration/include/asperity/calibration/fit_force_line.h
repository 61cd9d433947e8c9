#pragma once

#include <cstddef>
#include <vector>

#include "asperity/base/config.h"
#include "asperity/calibration/calibration_verdict.h"
#include "asperity/recording/calibration.h"

namespace asperity {

// Readings of the force sensor under known forces, one entry a reading.
struct ForcePoints {
  std::vector<double> counts;
  std::vector<double> force_N;

  std::size_t size() const { return counts.size(); }
};

struct FitForceLineConfig {
  double slope_uncertainty = 0.2;
  double linearity_share = 0.02;
  double significance = 0.01;
  double saturation_share = 0.05;

  template <class V>
  void visit(V& v) {
    v.field("slope_uncertainty", slope_uncertainty, "half of the slope's 95 % interval, else invalid, share of it",
            {0.0, 1.0});
    v.field("linearity_share", linearity_share, "bend that a line may stand for, share of the forces' span",
            {0.0, 1.0});
    v.field("significance", significance, "probability at which a bend or an outlier is taken for chance",
            {1e-12, 0.5});
    v.field("saturation_share", saturation_share,
            "spread of the forces at the end of the counts that means saturation, share of their span", {0.0, 1.0});
  }
};

struct ForceLineFit {
  ForceCalibration force;  // newton_per_count, offset_newton, residual_newton
  double newton_per_count_stderr = 0.0;
  double offset_newton_stderr = 0.0;
  double correlation = 0.0;  // of the two errors
  std::size_t points = 0;
  std::size_t loads = 0;               // that differ by `linearity_share` of the forces' span
  int degrees_of_freedom = 0;          // points − 2
  double bend_newton = 0.0;            // greatest distance of the best parabola from the line, within the counts' range
  double bend_probability = 1.0;       // that a straight sensor shows such a bend; 1 below 4 points or 3 counts
  double counts_error_newton = 0.0;    // what rounding to whole counts adds to a residual, newton_per_count/√12
  std::vector<std::size_t> outliers;   // places of points that the others contradict
  std::vector<std::size_t> saturated;  // places of points at the end of the counts that the force does not move
  CalibrationVerdict verdict;
};

// The straight line force = newton_per_count·counts + offset_newton by least squares in the force (thesis §3.5,
// Fig. 11). The residual's standard deviation s has N − 2 degrees of freedom; the standard errors are s/√Sxx and
// s·√(1/N + x̄²/Sxx). Rounding of the counts adds newton_per_count/√12 to a residual: where that is more than s, it
// takes the place of s, and the verdict says so where it is not small beside s. Fewer than three loads are limited.
// Linearity: Student's t-test of a square term. Outliers: externally studentised residuals against Student's t with the
// significance divided by N (Bonferroni). They are named and kept: a calibration has few points, and the person who
// took them can look. Throws Error, saying what to measure, for fewer than 3 points, for counts or forces that are all
// alike, and for a number that is not finite.
ForceLineFit fit_force_line(const ForcePoints& points, const FitForceLineConfig& config = {});

}  // namespace asperity
