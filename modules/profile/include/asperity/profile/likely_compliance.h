#pragma once

#include <limits>

namespace asperity {

// A contact's compliance, mm/N: mean and standard deviation.
struct LikelyCompliance {
  double mean_mm_per_N = 0.0;
  double sigma_mm_per_N = 0.0;
};

// What is expected of a contact's compliance c that was measured as `measured` ± `stderr` and of which only the limits
// are known beforehand: c is positive, and its logarithm has a uniform prior (Jeffreys's for a scale) between the
// hardest contact of a tip on an object, 10,000 N/mm (Hertz: a steel ball of 1 mm on steel at 5 N has 7,000), and the
// softest, 1 N/mm:
//
//   E[cⁿ] = ∫ cⁿ p((c − measured)/stderr) d(ln c) / ∫ p((c − measured)/stderr) d(ln c),
//
// p being Student's distribution with the degrees of freedom that the standard error has, infinity for a known
// one; they are above 0.
// A precise measurement stays what it is; without one (not finite) it is the prior's 0.109 ± 0.206 mm/N.
LikelyCompliance likely_compliance(double measured_mm_per_N, double stderr_mm_per_N,
                                   double degrees_of_freedom = std::numeric_limits<double>::infinity());

}  // namespace asperity
