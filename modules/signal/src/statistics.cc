#include "asperity/signal/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {
namespace {

void require_count(std::span<const double> x, std::size_t count, const char* what) {
  if (x.size() < count) {
    throw Error(std::string(what) + " needs at least " + std::to_string(count) + " samples, not " +
                std::to_string(x.size()));
  }
}

void check_pair(std::span<const double> x, std::span<const double> y, const char* what) {
  require_count(x, 2, what);
  if (x.size() != y.size()) {
    throw Error(std::string(what) + ": " + std::to_string(x.size()) + " and " + std::to_string(y.size()) + " samples");
  }
}

struct Moments {
  double mean_x = 0.0, mean_y = 0.0;
  double xx = 0.0, xy = 0.0, yy = 0.0;  // sums about the means
};

Moments moments(std::span<const double> x, std::span<const double> y) {
  Moments m;
  m.mean_x = mean(x);
  m.mean_y = mean(y);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double dx = x[i] - m.mean_x;
    const double dy = y[i] - m.mean_y;
    m.xx += dx * dx;
    m.xy += dx * dy;
    m.yy += dy * dy;
  }
  return m;
}

}  // namespace

double mean(std::span<const double> x) {
  require_count(x, 1, "mean");
  return std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
}

double variance(std::span<const double> x) {
  require_count(x, 2, "variance");
  const double centre = mean(x);
  double sum = 0.0;
  for (const double v : x) sum += (v - centre) * (v - centre);
  return sum / static_cast<double>(x.size() - 1);
}

double standard_deviation(std::span<const double> x) { return std::sqrt(variance(x)); }

double rms(std::span<const double> x) {
  require_count(x, 1, "root mean square");
  return std::sqrt(std::inner_product(x.begin(), x.end(), x.begin(), 0.0) / static_cast<double>(x.size()));
}

double median(std::span<const double> x) { return percentile(x, 50.0); }

double percentile(std::span<const double> x, double percent) {
  require_count(x, 1, "percentile");
  if (!(percent >= 0.0 && percent <= 100.0)) throw Error("percentile " + number_text(percent) + " is not in 0 to 100");
  std::vector<double> copy(x.begin(), x.end());
  const double place = percent / 100.0 * static_cast<double>(copy.size() - 1);
  const auto below = static_cast<std::ptrdiff_t>(std::floor(place));
  const auto it = copy.begin() + below;
  std::nth_element(copy.begin(), it, copy.end());
  const double low = *it;
  if (it + 1 == copy.end()) return low;
  const double high = *std::min_element(it + 1, copy.end());
  return low + (high - low) * (place - static_cast<double>(below));
}

double median_absolute_deviation(std::span<const double> x) {
  const double centre = median(x);
  std::vector<double> distance(x.size());
  std::transform(x.begin(), x.end(), distance.begin(), [=](double v) { return std::abs(v - centre); });
  return median(distance);
}

double correlation(std::span<const double> x, std::span<const double> y) {
  check_pair(x, y, "correlation");
  const Moments m = moments(x, y);
  const double scale = std::sqrt(m.xx) * std::sqrt(m.yy);
  return scale > 0.0 ? std::clamp(m.xy / scale, -1.0, 1.0) : 0.0;
}

LinearFit linear_regression(std::span<const double> x, std::span<const double> y) {
  check_pair(x, y, "linear regression");
  const Moments m = moments(x, y);
  if (!(m.xx > 0.0)) throw Error("linear regression: all " + std::to_string(x.size()) + " abscissae are equal");
  LinearFit fit;
  fit.slope = m.xy / m.xx;
  fit.intercept = m.mean_y - fit.slope * m.mean_x;
  const double n = static_cast<double>(x.size());
  if (x.size() == 2) {
    fit.slope_error = fit.intercept_error = fit.residual = std::numeric_limits<double>::quiet_NaN();
    return fit;
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double r = (y[i] - m.mean_y) - fit.slope * (x[i] - m.mean_x);
    sum += r * r;
  }
  fit.residual = std::sqrt(sum / (n - 2.0));
  fit.slope_error = fit.residual / std::sqrt(m.xx);
  fit.intercept_error = fit.residual * std::sqrt(1.0 / n + m.mean_x * m.mean_x / m.xx);
  return fit;
}

}  // namespace asperity
