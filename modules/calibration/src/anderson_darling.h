#pragma once

#include <vector>

namespace asperity {

struct GaussianTest {
  double skewness = 0.0;
  double excess_kurtosis = 0.0;
  double anderson_darling = 0.0;  // A*²
  double probability = 1.0;       // that a Gaussian sample has an A*² as large
};

// Whether independent samples are Gaussian with any mean and variance (Anderson and Darling, 1952, with the factor and
// the probabilities of D'Agostino and Stephens, 1986, table 4.9). At least eight samples, not all alike.
GaussianTest test_gaussian(std::vector<double> x);

}  // namespace asperity
