#pragma once

#include <vector>

#include "asperity/profile/estimate_friction.h"

namespace asperity {

// Independent values among n whose residuals are correlated from one to the next (Bartlett 1946, first lag).
double independent_count(const std::vector<double>& residual);

// How the coefficient goes with speed and force: `per_mps`, `per_log_force` and their errors. A plane through three
// windows has no residual, and so no error.
void fit_slopes(FrictionEstimate& out);

// Stribeck's law where the speeds span a factor of three and the data ask for it: Schwarz's criterion against a
// constant, by the independent windows less the law's three parameters: few windows are followed by any law.
void fit_stribeck(FrictionEstimate& out);

}  // namespace asperity
