#include "whitening.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace asperity::registration {

namespace {

// The heights less their moving mean over usable neighbours of the same stretch.
std::vector<double> without_long_waves(const PathChain& chain, const FacetHeights& heights, std::size_t smooth) {
  const std::size_t n = heights.d_m.size();
  std::vector<double> out(n, 0.0);
  std::size_t begin = 0;
  while (begin < n) {
    std::size_t end = begin + 1;
    while (end < n && chain.begins[end] == 0) ++end;
    std::vector<double> sum(end - begin + 1, 0.0), count(end - begin + 1, 0.0);
    for (std::size_t i = begin; i < end; ++i) {
      const double use = heights.usable[i] != 0 ? 1.0 : 0.0;
      sum[i - begin + 1] = sum[i - begin] + use * heights.d_m[i];
      count[i - begin + 1] = count[i - begin] + use;
    }
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t a = i - begin > smooth ? i - begin - smooth : 0,
                        b = std::min(i - begin + smooth + 1, end - begin);
      const double neighbours = count[b] - count[a];
      out[i] = neighbours > 0.0 ? heights.d_m[i] - (sum[b] - sum[a]) / neighbours : 0.0;
    }
    begin = end;
  }
  return out;
}

std::vector<double> autocovariance(const PathChain& chain, const PathChain::Part& part, const FacetHeights& heights,
                                   const std::vector<double>& d_m, std::size_t order) {
  std::vector<double> r(order + 1, 0.0);
  std::size_t count = 0;
  const std::size_t end = part.first_point + part.points;
  for (std::size_t i = part.first_point; i < end; ++i) count += heights.usable[i] != 0 ? 1 : 0;
  for (std::size_t lag = 0; lag <= order; ++lag) {
    double sum = 0.0;
    std::size_t reach = 0;  // neighbours before this point without a break
    for (std::size_t i = part.first_point; i < end; ++i) {
      reach = chain.begins[i] != 0 ? 0 : reach + 1;
      if (reach >= lag && heights.usable[i] != 0 && heights.usable[i - lag] != 0) {
        sum += d_m[i] * d_m[i - lag];
      }
    }
    const double x = static_cast<double>(lag) / static_cast<double>(order + 1);
    const double parzen = x < 0.5 ? 1.0 - 6.0 * x * x * (1.0 - x) : 2.0 * std::pow(1.0 - x, 3);
    r[lag] = parzen * sum / static_cast<double>(std::max<std::size_t>(1, count));
  }
  return r;
}

ReliefLevel level_of(const PathChain& chain, const PathChain::Part& part, const FacetHeights& heights,
                     double window_m) {
  std::vector<double> d_m, u_m;
  double place_m = 0.0;
  for (std::size_t i = part.first_point; i < part.first_point + part.points; ++i) {
    if (i > part.first_point) {
      const Eigen::Vector3d step_m = heights.p_mesh_m[i] - heights.p_mesh_m[i - 1];
      const double up_m = heights.normal[i].dot(step_m);
      place_m += chain.begins[i] != 0 ? window_m : std::sqrt(std::max(0.0, step_m.squaredNorm() - up_m * up_m));
    }
    if (heights.usable[i] == 0) continue;
    d_m.push_back(heights.d_m[i]);
    u_m.push_back(place_m);
  }
  return measure_relief_level(d_m, u_m, window_m);
}

// Levinson's and Durbin's recursion.
Whitening from_autocovariance(const std::vector<double>& r, std::size_t order) {
  Whitening out;
  out.variance_m2 = r[0];
  for (std::size_t m = 1; m <= order && out.variance_m2 > 0.0; ++m) {
    double sum = r[m];
    for (std::size_t k = 1; k < m; ++k) sum += out.a[k - 1] * r[m - k];
    const double reflection = -sum / out.variance_m2;
    if (!(std::abs(reflection) < 1.0)) break;
    const std::vector<double> before = out.a;
    for (std::size_t k = 1; k < m; ++k) out.a[k - 1] += reflection * before[m - k - 1];
    out.a.push_back(reflection);
    out.variance_m2 *= 1.0 - reflection * reflection;
  }
  return out;
}

}  // namespace

std::vector<Whitening> make_whitenings(const PathChain& chain, const FacetHeights& heights, std::size_t order,
                                       std::size_t smooth) {
  const std::vector<double> d_m = without_long_waves(chain, heights, smooth);
  std::vector<Whitening> out;
  for (const PathChain::Part& part : chain.parts) {
    Whitening& filter = out.emplace_back(from_autocovariance(autocovariance(chain, part, heights, d_m, order), order));
    filter.level = level_of(chain, part, heights, static_cast<double>(2 * smooth + 1) * chain.spacing_m);
  }
  return out;
}

}  // namespace asperity::registration
