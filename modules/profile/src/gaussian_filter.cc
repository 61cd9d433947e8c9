#include "gaussian_filter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "gaussian_moments.h"

namespace asperity {
namespace {

// The weighted straight line through the present samples within `reach` of `i`, at `i`.
double local_line(std::span<const double> z, std::span<const double> weight, std::ptrdiff_t i, std::ptrdiff_t reach) {
  const auto n = static_cast<std::ptrdiff_t>(z.size());
  double s0 = 0.0, s1 = 0.0, s2 = 0.0, t0 = 0.0, t1 = 0.0;
  for (std::ptrdiff_t j = std::max<std::ptrdiff_t>(0, i - reach); j <= std::min(n - 1, i + reach); ++j) {
    const double height = z[static_cast<std::size_t>(j)];
    if (std::isnan(height)) continue;
    const double w = weight[static_cast<std::size_t>(std::abs(j - i))];
    const double x = static_cast<double>(j - i);
    s0 += w;
    s1 += w * x;
    s2 += w * x * x;
    t0 += w * height;
    t1 += w * x * height;
  }
  const double determinant = s0 * s2 - s1 * s1;
  // With the other samples too far off to fix a slope, the mean is all there is.
  if (determinant <= 1e-9 * s0 * s2) return t0 / s0;
  return (s2 * t0 - s1 * t1) / determinant;
}

// Heights with 0 where one is missing, and 1 or 0 for each.
struct Present {
  std::vector<double> height_m, weight;
};

Present present(std::span<const double> height_m) {
  Present out;
  for (const double z : height_m) {
    out.height_m.push_back(std::isnan(z) ? 0.0 : z);
    out.weight.push_back(std::isnan(z) ? 0.0 : 1.0);
  }
  return out;
}

// The same by Fourier transforms, in time that does not grow with the cut-off: the local line everywhere, whose slope
// is 0 to rounding where the window is whole.
std::vector<double> mean_line_by_moments(std::span<const double> height_m, double spacing_m, double width_m,
                                         const Observer& observer) {
  const auto check = [&observer] { observer.update("filter", 0.0); };  // between two transforms
  const Present of = present(height_m);
  const std::size_t n = height_m.size();
  std::vector<double> s0, s1, s2, t0, t1;
  {
    const GaussianMoments moments(n, spacing_m, width_m, 0);
    check(), s0 = moments.of(of.weight), check(), t0 = moments.of(of.height_m);
  }
  check();
  {
    const GaussianMoments moments(n, spacing_m, width_m, 1);
    check(), s1 = moments.of(of.weight), check(), t1 = moments.of(of.height_m);
  }
  check();
  s2 = GaussianMoments(n, spacing_m, width_m, 2).of(of.weight);
  std::vector<double> out(n, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < n; ++i) {
    if (of.weight[i] == 0.0) continue;
    const double determinant = s0[i] * s2[i] - s1[i] * s1[i];
    out[i] = determinant <= 1e-9 * s0[i] * s2[i] ? t0[i] / s0[i] : (s2[i] * t0[i] - s1[i] * t1[i]) / determinant;
  }
  return out;
}

constexpr double kLongWork = 2e6;  // products beyond which transforms are faster

}  // namespace

std::vector<double> gaussian_mean_line_m(std::span<const double> height_m, double spacing_m, double cutoff_m,
                                         const Observer& observer) {
  if (!(spacing_m > 0.0) || !std::isfinite(spacing_m))
    throw Error("the spacing " + number_text(spacing_m) + " m is not a positive length");
  if (!(cutoff_m > 0.0) || !std::isfinite(cutoff_m))
    throw Error("the cut-off " + number_text(cutoff_m) + " m is not a positive length");
  const auto n = static_cast<std::ptrdiff_t>(height_m.size());
  const double alpha = std::sqrt(std::numbers::ln2 / std::numbers::pi);
  // Beyond one cut-off length the weight is below 7e-7 of the centre's.
  const auto reach = static_cast<std::ptrdiff_t>(std::min(std::ceil(cutoff_m / spacing_m), static_cast<double>(n)));
  constexpr std::ptrdiff_t kShort = 64;  // summed directly by GaussianMoments too
  if (reach > kShort && static_cast<double>(n) * static_cast<double>(reach) > kLongWork)
    return mean_line_by_moments(height_m, spacing_m, alpha * cutoff_m, observer);
  std::vector<double> weight(static_cast<std::size_t>(reach) + 1);
  double total = 0.0;
  for (std::size_t k = 0; k < weight.size(); ++k) {
    const double x = static_cast<double>(k) * spacing_m / (alpha * cutoff_m);
    weight[k] = std::exp(-std::numbers::pi * x * x);
    total += k == 0 ? weight[k] : 2.0 * weight[k];
  }

  std::vector<std::ptrdiff_t> missing_before(height_m.size() + 1, 0);
  for (std::size_t i = 0; i < height_m.size(); ++i)
    missing_before[i + 1] = missing_before[i] + (std::isnan(height_m[i]) ? 1 : 0);

  std::vector<double> mean_line_m(height_m.size(), std::numeric_limits<double>::quiet_NaN());
  RowWatch watch(observer);
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    watch.next();
    const double* centre = height_m.data() + i;
    if (std::isnan(*centre)) continue;
    const bool whole =
        i >= reach && i + reach < n &&
        missing_before[static_cast<std::size_t>(i + reach + 1)] == missing_before[static_cast<std::size_t>(i - reach)];
    double& result = mean_line_m[static_cast<std::size_t>(i)];
    if (!whole) {
      result = local_line(height_m, weight, i, reach);
      continue;
    }
    double sum = weight[0] * *centre;
    for (std::ptrdiff_t k = 1; k <= reach; ++k) sum += weight[static_cast<std::size_t>(k)] * (centre[-k] + centre[k]);
    result = sum / total;
  }
  return mean_line_m;
}

}  // namespace asperity
