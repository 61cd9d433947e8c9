#include "uniform_basis.h"

#include <cstddef>

namespace asperity {

namespace {

// N_0 … N_degree over one interval of uniform knots, by Cox and de Boor's recursion.
template <std::size_t kDegree>
std::array<double, kDegree + 1> splines(double share) {
  if constexpr (kDegree == 0) {
    return {1.0};
  } else {
    const std::array<double, kDegree> lower = splines<kDegree - 1>(share);
    std::array<double, kDegree + 1> out{};
    constexpr auto n = static_cast<double>(kDegree);
    for (std::size_t j = 0; j < kDegree; ++j) {
      const double way = (share + n - 1.0 - static_cast<double>(j)) / n;
      // The checker takes the array of a template's depth for an empty one.
      // cppcheck-suppress containerOutOfBounds
      out[j + 1] += way * lower[j];
      // cppcheck-suppress containerOutOfBounds
      out[j] += (1.0 - way) * lower[j];
    }
    return out;
  }
}

// The derivative of a spline of degree n is the difference of two of degree n − 1.
template <std::size_t kCount>
std::array<double, kCount + 1> difference(const std::array<double, kCount>& lower) {
  std::array<double, kCount + 1> out{};
  for (std::size_t j = 0; j < kCount; ++j) {
    out[j] -= lower[j];
    out[j + 1] += lower[j];
  }
  return out;
}

}  // namespace

QuinticBasis quintic_basis(double share) {
  return {splines<5>(share), difference(splines<4>(share)), difference(difference(splines<3>(share)))};
}

}  // namespace asperity
