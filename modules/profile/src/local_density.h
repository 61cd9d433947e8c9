#pragma once

#include <span>

namespace asperity {

// The density of a random surface at one frequency, from its periodogram at others beside it.
struct LocalDensity {
  double density = 0.0;   // unit of the ordinates; 0: too few of them
  double variance = 0.0;  // of its logarithm
  std::size_t used = 0;   // ordinates
};

// The ordinates of a periodogram of a stationary random process are, at independent frequencies, exponentially
// distributed about its density. ln(density) = a + b x + c x², x in independent frequencies from the one that is asked
// for, is fitted by maximum likelihood (Whittle's: minimise Σ ln μ + P/μ; a generalised linear model, Fisher scoring),
// so that a broad peak, which is such a parabola, is not flattened. Its variance is that of the intercept by the
// information matrix. Ordinates above seven times the fit, one in 1100 of a random process, are lines of their own and
// left out. With fewer than six ordinates the density is 0.
LocalDensity fit_local_density(std::span<const double> offset, std::span<const double> power);

}  // namespace asperity
