#pragma once

#include <span>

namespace asperity {

// All throw Error for too few samples; samples must be finite.
double mean(std::span<const double> x);
double variance(std::span<const double> x);            // with n - 1
double standard_deviation(std::span<const double> x);  // with n - 1
double rms(std::span<const double> x);
double median(std::span<const double> x);
double percentile(std::span<const double> x, double percent);  // linear between order statistics, 0 to 100

// The median of |x - median(x)|. Times kSigmaPerMad it is the standard deviation of normal samples.
double median_absolute_deviation(std::span<const double> x);
inline constexpr double kSigmaPerMad = 1.482602218505602;

// Pearson's, in [-1, 1]; 0 if either side is constant.
double correlation(std::span<const double> x, std::span<const double> y);

struct LinearFit {
  double slope = 0.0;
  double intercept = 0.0;
  double slope_error = 0.0;  // standard errors; nan for two points
  double intercept_error = 0.0;
  double residual = 0.0;  // standard deviation with n - 2 degrees of freedom; nan for two points
};

// Least squares of y = slope x + intercept. Throws Error if the sizes differ, for fewer than two points,
// or if x is constant.
LinearFit linear_regression(std::span<const double> x, std::span<const double> y);

}  // namespace asperity
