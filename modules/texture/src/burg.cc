#include "burg.h"

#include <cstddef>

namespace asperity {

BurgResult burg(const std::vector<std::span<const double>>& segments, int order) {
  struct Errors {
    std::vector<double> forward, backward;
  };
  std::vector<Errors> errors;
  double power = 0.0;
  double count = 0.0;
  for (const auto& s : segments) {
    if (s.size() < static_cast<std::size_t>(order) + 2) continue;
    errors.push_back({{s.begin(), s.end()}, {s.begin(), s.end()}});
    for (const double x : s) power += x * x;
    count += static_cast<double>(s.size());
  }
  BurgResult result;
  result.variance.push_back(count > 0.0 ? power / count : 0.0);
  for (int m = 1; m <= order; ++m) {
    double product = 0.0;
    double square = 0.0;
    for (const auto& e : errors) {
      for (std::size_t n = static_cast<std::size_t>(m); n < e.forward.size(); ++n) {
        product += e.forward[n] * e.backward[n - 1];
        square += e.forward[n] * e.forward[n] + e.backward[n - 1] * e.backward[n - 1];
      }
    }
    const double k = square > 0.0 ? -2.0 * product / square : 0.0;
    for (auto& e : errors) {
      for (std::size_t n = e.forward.size(); n-- > static_cast<std::size_t>(m);) {
        const double f = e.forward[n];
        const double b = e.backward[n - 1];
        e.forward[n] = f + k * b;
        e.backward[n] = b + k * f;
      }
    }
    result.k.push_back(k);
    result.variance.push_back(result.variance.back() * (1.0 - k * k));
  }
  return result;
}

}  // namespace asperity
