#pragma once

namespace asperity {

// The value that a χ² variable with `freedom` degrees of freedom (any positive number) does not exceed with the
// probability p, to 1e-10 relative. By bisection of the regularized incomplete gamma function, series and continued
// fraction (Abramowitz and Stegun 1964, 6.5.29 and 6.5.31). Throws Error for p outside (0, 1) or a freedom that is not
// positive.
double chi_square_quantile(double p, double freedom);

}  // namespace asperity
