#pragma once

namespace asperity {

// A length that is not negative, of which the square was measured.
struct Root {
  double value = 0.0;
  double standard_error = 0.0;
};

// The mean and the standard deviation of a length x ≥ 0 whose square was measured as `square` with the Gaussian
// standard error `square_stderr`; before the measurement every x is as likely as every other. Where the square is known
// well this is √square and square_stderr/(2 √square). It is also defined where noise has made the square small or
// negative. nan for a standard error that is not positive or numbers that are not finite.
Root root_of_power(double square, double square_stderr);

}  // namespace asperity
