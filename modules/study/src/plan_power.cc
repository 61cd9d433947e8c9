#include "asperity/study/plan_power.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "asperity/base/error.h"

namespace asperity {

namespace {

// The power falls at the numbers at which the critical count stays behind: no longer than this above the first number
// that suffices.
constexpr int kSawMargin = 20, kSawPart = 20;

void check_share(double value, const char* what) {
  if (!(value > 0.0 && value < 1.0)) throw Error(std::string(what) + ": must be between 0 and 1");
}

double ln_binomial(int n, int k, double p) {
  return std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0) + k * std::log(p) +
         (n - k) * std::log1p(-p);
}

// P(K <= k) for K of a binomial distribution.
double lower_tail(int n, int k, double p) {
  double sum = 0.0;
  for (int i = 0; i <= k; ++i) sum += std::exp(ln_binomial(n, i, p));
  return std::min(1.0, sum);
}

// The largest count that the test rejects at the lower side; -1: it rejects none. By symmetry n - it at the upper.
int critical_count(int n, double alpha) {
  double sum = 0.0;
  for (int k = 0; 2 * k < n; ++k) {
    sum += std::exp(ln_binomial(n, k, 0.5));
    if (sum > 0.5 * alpha) return k - 1;
  }
  return (n - 1) / 2;
}

}  // namespace

double power_of_trials(int trials, double share, double alpha) {
  check_share(share, "the expected share");
  check_share(alpha, "alpha");
  if (trials < 1 || trials > kMostPlannedTrials) {
    throw Error("trials: must be from 1 to " + std::to_string(kMostPlannedTrials));
  }
  const int low = critical_count(trials, alpha);
  return low < 0 ? 0.0 : std::min(1.0, lower_tail(trials, low, share) + lower_tail(trials, low, 1.0 - share));
}

int trials_for_power(const PowerConfig& config) {
  check_share(config.share, "the expected share");
  check_share(config.alpha, "alpha");
  check_share(config.power, "the power");
  if (config.share == 0.5) throw Error("the expected share is that of chance, 0.5: no number of trials finds it");
  const int most = kMostPlannedTrials / 2;
  const auto suffices = [&](int n) { return power_of_trials(n, config.share, config.alpha) >= config.power; };
  int low = 0, high = 1;
  while (!suffices(high)) {
    if (high == most) {
      throw Error("more than " + std::to_string(most) + " trials are needed; expect a share further from 0.5");
    }
    low = high;
    high = std::min(2 * high, most);
  }
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    (suffices(middle) ? high : low) = middle;
  }
  // Somewhere on the saw; the last number that does not suffice is not far.
  for (int n = high + kSawMargin + high / kSawPart; n >= 1; --n) {
    if (!suffices(n)) return n + 1;
  }
  return 1;
}

}  // namespace asperity
