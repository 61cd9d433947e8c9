#pragma once

#include <complex>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

namespace bench {

// In place, radix 2; the size is a power of two. `sign` -1 forward, +1 back (not divided by the size).
inline void fft(std::vector<std::complex<double>>& x, int sign) {
  const std::size_t n = x.size();
  for (std::size_t i = 1, j = 0; i < n; ++i) {
    std::size_t bit = n >> 1;
    for (; (j & bit) != 0; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) std::swap(x[i], x[j]);
  }
  for (std::size_t length = 2; length <= n; length <<= 1) {
    const double angle = sign * 2.0 * std::numbers::pi / static_cast<double>(length);
    for (std::size_t k = 0; k < length / 2; ++k) {
      const std::complex<double> turn = std::polar(1.0, angle * static_cast<double>(k));
      for (std::size_t start = k; start < n; start += length) {
        const std::complex<double> odd = turn * x[start + length / 2];
        x[start + length / 2] = x[start] - odd;
        x[start] += odd;
      }
    }
  }
}

}  // namespace bench
