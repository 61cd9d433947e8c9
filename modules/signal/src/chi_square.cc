#include "asperity/signal/chi_square.h"

#include <cmath>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

namespace {

constexpr int kMostTerms = 100'000;
constexpr double kPrecision = 1e-14;

// P(a, x) of the incomplete gamma function.
double gamma_p(double a, double x) {
  if (!(x > 0.0)) return 0.0;
  const double front = std::exp(a * std::log(x) - x - std::lgamma(a));
  if (x < a + 1.0) {
    double term = 1.0 / a, sum = term;
    for (int n = 1; n < kMostTerms && term > kPrecision * sum; ++n) {
      term *= x / (a + n);
      sum += term;
    }
    return front * sum;
  }
  // Lentz's method.
  constexpr double kTiny = 1e-300;
  double b = x + 1.0 - a, c = 1.0 / kTiny, d = 1.0 / b, h = d;
  for (int n = 1; n < kMostTerms; ++n) {
    const double an = -n * (n - a);
    b += 2.0;
    d = an * d + b;
    d = 1.0 / (std::abs(d) < kTiny ? kTiny : d);
    c = b + an / c;
    if (std::abs(c) < kTiny) c = kTiny;
    h *= c * d;
    if (std::abs(c * d - 1.0) < kPrecision) break;
  }
  return 1.0 - front * h;
}

}  // namespace

double chi_square_quantile(double p, double freedom) {
  if (!(p > 0.0) || !(p < 1.0) || !(freedom > 0.0)) {
    throw Error("chi-square quantile: probability " + number_text(p) + ", degrees of freedom " + number_text(freedom));
  }
  double low = 0.0, high = freedom;
  while (gamma_p(0.5 * freedom, 0.5 * high) < p) high *= 2.0;
  for (int k = 0; k < 200 && high - low > 1e-12 * high; ++k) {
    const double middle = 0.5 * (low + high);
    (gamma_p(0.5 * freedom, 0.5 * middle) < p ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace asperity
