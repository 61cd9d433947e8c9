#pragma once

#include <cstddef>

namespace asperity {

// One pass of Stockham's transform (fourier_transform.h), of radix 2, 3, 4 or 5.

// Complex numbers as two rows, so that neighbours are in one register.
struct View {
  double* __restrict re;
  double* __restrict im;
};

struct Pass {
  std::size_t radix = 0;
  std::size_t length = 0;  // N, left to do before it
  std::size_t stride = 0;  // s
};

// Roots of one pass: the j-th of p is root[j p step].
struct Roots {
  const double* re;
  const double* im;
  std::size_t step;
};

// From x to y. Four numbers at once on processors with AVX2, by the same operations: the same bytes on all.
void run_pass(const Pass& pass, const Roots& root, View x, View y);

}  // namespace asperity
