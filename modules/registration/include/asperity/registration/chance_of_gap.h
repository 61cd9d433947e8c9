#pragma once

#include <vector>

namespace asperity {

// The probability that the largest of several like values exceeds the next by as much as `best` exceeds the largest of
// `others` (Likeš, Metrika 11, 1966). Beyond a high value most distributions fall exponentially; there the spacings
// k (x_k − x_{k+1}) of the ordered values x_1 ≥ x_2 ≥ … are independent and exponential with one scale β, whatever it
// is (Rényi, Acta Math. Hung. 4, 1953). The ten largest of the others give the estimate of β, so that the gap over it
// has an F distribution with 2 and 2 (K − 1) degrees of freedom: p = (1 + gap/((K − 1) β))^−(K − 1). 1 if `best` is not
// the largest; nan for fewer than five others or if these are all the same.
double chance_of_gap(double best, std::vector<double> others);

}  // namespace asperity
