#include "root_of_power.h"

#include <algorithm>
#include <cmath>

#include "asperity/base/nan.h"

namespace asperity {

Root root_of_power(double square, double square_stderr) {
  constexpr double kReach = 7.0;  // standard errors of the square: beyond it there is nothing
  constexpr int kSteps = 400;
  if (!std::isfinite(square) || !std::isfinite(square_stderr) || !(square_stderr > 0.0)) return {kNan, kNan};
  const double low = std::sqrt(std::max(0.0, square - kReach * square_stderr));
  // With a square far below zero what is left is near zero: exp(−square x²/σ²).
  const double width =
      square < 0.0 ? std::min(square_stderr, kReach * square_stderr * square_stderr / -square) : square_stderr;
  const double high = std::sqrt(std::max(square, 0.0) + kReach * width);
  const double nearest = std::max(square, 0.0);
  double sum = 0.0, first = 0.0, second = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double x = low + (high - low) * (i + 0.5) / kSteps;
    const double off = (x * x - square) / square_stderr, least = (nearest - square) / square_stderr;
    const double weight = std::exp(-0.5 * (off * off - least * least));
    sum += weight;
    first += weight * x;
    second += weight * x * x;
  }
  const double mean = first / sum;
  return {mean, std::sqrt(std::max(0.0, second / sum - mean * mean))};
}

}  // namespace asperity
