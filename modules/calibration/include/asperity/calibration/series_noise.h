#pragma once

#include <limits>
#include <span>
#include <vector>

namespace asperity {

// The scatter of one quantity in a static interval: a white part, independent from sample to sample, and a drift, an
// Ornstein–Uhlenbeck process of variance slow² and correlation exp(−|Δt|/time_s). In the quantity's unit.
struct SeriesNoise {
  std::size_t samples = 0;
  double white = 0.0;
  double white_error = 0.0;  // standard errors
  bool has_slow = false;     // whether the data show a drift at all; else the next four are 0
  double slow = 0.0;
  double slow_error = 0.0;
  double slow_time_s = 0.0;
  double slow_time_error_s = 0.0;
  double total = 0.0;  // the root of the sum of both variances
  double total_error = 0.0;
  double effective_samples = 0.0;  // independent ones whose variance would be known as well

  // Of the innovations, which are independent and of unit variance if the model holds: a Gaussian test on the
  // samples themselves would take their correlation for a wrong shape.
  double skewness = 0.0;
  double excess_kurtosis = 0.0;
  double anderson_darling = 0.0;  // A*², for mean and variance from the data (Stephens, 1974)
  double gaussian_probability = std::numeric_limits<double>::quiet_NaN();  // of an A*² as large, if Gaussian
};

// Both parts by restricted maximum likelihood (the mean is free) through a scalar Kalman filter, exact for uneven
// times; standard errors from the curvature of the likelihood. The drift is kept where it raises the log-likelihood
// by more than 4.5 (three standard errors). Linear in the number of samples. Throws Error for fewer than eight samples,
// sizes that differ, times that do not rise, or numbers that are not finite. A constant series has no noise: all zero.
SeriesNoise fit_series_noise(std::span<const double> t_s, std::span<const double> x);

}  // namespace asperity
