#pragma once

#include <cstddef>
#include <span>

#include "asperity/base/problem.h"
#include "asperity/texture/stochastic.h"

namespace asperity {

struct FitStochasticConfig {
  bool use_correlation_length = true;
  double tangential_ratio = 0.0;
  double offset_sigmas = 3.0;
  double stiffness_N_per_m = 300.0;

  template <class V>
  void visit(V& v) {
    v.field("use_correlation_length", use_correlation_length,
            "heights change with the distance travelled, not with every servo step");
    v.former("use_grain");
    v.field("tangential_ratio", tangential_ratio, "tangential part of the force over its normal part", {-100.0, 100.0});
    v.field("lift_sigma", offset_sigmas, "standard deviations by which the heights are lifted", {0.0, 10.0});
    v.field("stiffness_N_per_m", stiffness_N_per_m, "height to force", {0.0, 1e6});
  }
};

struct StochasticFit {
  StochasticTexture texture;
  std::size_t samples = 0;            // heights that are not gaps
  double skewness = 0.0;              // 0 for a Gaussian
  double excess_kurtosis = 0.0;       // 0 for a Gaussian
  double kolmogorov_distance = 0.0;   // largest distance of the distribution function from the Gaussian's, 0 to 1
  double correlation_length_m = 0.0;  // where the autocorrelation first falls below 1/e
  double not_white = 0.0;             // share of the power that white noise has at other frequencies, 0 to 1
  double misplaced_power = 0.0;       // the same against the fitted texture's own spectrum
  Problems problems;                  // "not_stochastic"
};

// A stochastic texture of heights `spacing_m` apart, nan in gaps (thesis §6.5: mean 0, variance that of the heights).
// How little of the profile that keeps is in the errors: distribution and spectrum, the latter of the longest gap-free
// stretch, as ½ Σ |P_k/ΣP − Q_k/ΣQ| over Welch's estimates. Above half, a Problem says that the profile is not noise.
// Throws Error for an infinite height, a spacing that is not positive, or no gap-free stretch of 64 samples.
StochasticFit fit_stochastic(std::span<const double> height_m, double spacing_m,
                             const FitStochasticConfig& config = {});

}  // namespace asperity
