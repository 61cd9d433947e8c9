#pragma once

namespace asperity {

// The root mean square of a contact's compliance c, mm/N, that was measured as `measured` ± `stderr` and of which only
// the limits are known beforehand: c is positive, and its logarithm has a uniform prior (Jeffreys's for a scale)
// between the hardest contact of a tip on an object, 1000 N/mm, and the softest, 1 N/mm:
//
//   E[c²] = ∫ c² exp(−(c − measured)²/(2 stderr²)) d(ln c) / ∫ exp(−(c − measured)²/(2 stderr²)) d(ln c).
//
// For a precise measurement it is |measured|; without one (not finite) it is that of the prior, 0.27 mm/N.
double likely_compliance_mm_per_N(double measured_mm_per_N, double stderr_mm_per_N);

}  // namespace asperity
