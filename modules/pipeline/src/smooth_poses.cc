#include "smooth_poses.h"

#include <algorithm>
#include <array>

#include <Eigen/LU>

namespace asperity {

namespace {

// What noise becomes in a weighted sum of poses, which are added in the order of time.
struct NoiseGain {
  double white_square = 0.0, slow_square = 0.0;
  double before = 0.0;  // Σ_{j<i} w_j exp(−(t_i − t_j)/time)
  double last = 0.0;

  void add(double weight, double decay) {
    before = (before + last) * decay;
    last = weight;
    white_square += weight * weight;
    slow_square += weight * (weight + 2.0 * before);
  }
  double white() const { return std::sqrt(white_square); }
  double slow() const { return std::sqrt(std::max(0.0, slow_square)); }
};

}  // namespace

std::vector<double> decay_between(const std::vector<double>& t_s, double time_s) {
  std::vector<double> out(t_s.size(), 0.0);
  for (std::size_t i = 1; i < t_s.size(); ++i) out[i] = std::exp(-(t_s[i] - t_s[i - 1]) / time_s);
  return out;
}

SmoothedPoses smooth_poses(const PosePath& path, double half_width_s, const std::vector<double>& decay) {
  const std::size_t n = path.t_s.size();
  SmoothedPoses out;
  std::size_t first = 0, last = 0;
  std::vector<double> weights, times;  // of the poses within reach; times from −1 to 1
  for (std::size_t i = 0; i < n; ++i) {
    double reach_s = half_width_s;
    // A parabola needs poses, three on the average on either side.
    do {
      first = i;
      last = i + 1;
      while (first > 0 && path.t_s[i] - path.t_s[first - 1] < reach_s) --first;
      while (last < n && path.t_s[last] - path.t_s[i] < reach_s) ++last;
      reach_s *= 1.4;
    } while (last - first < std::min<std::size_t>(5, n));
    reach_s /= 1.4;
    std::array<double, 5> moment{};           // Σ w u^k
    std::array<Eigen::Vector3d, 3> products;  // Σ w u^k (q − q_i)
    products.fill(Eigen::Vector3d::Zero());
    weights.resize(last - first);
    times.resize(last - first);
    for (std::size_t j = first; j < last; ++j) {
      const double u = (path.t_s[j] - path.t_s[i]) / reach_s;
      const double w = (1.0 - u * u) * (1.0 - u * u), wu = w * u, wuu = wu * u;
      times[j - first] = u;
      weights[j - first] = w;
      moment[0] += w;
      moment[1] += wu;
      moment[2] += wuu;
      moment[3] += wuu * u;
      moment[4] += wuu * u * u;
      const Eigen::Vector3d apart = path.p_world_tip_m[j] - path.p_world_tip_m[i];
      products[0] += w * apart;
      products[1] += wu * apart;
      products[2] += wuu * apart;
    }
    Eigen::Matrix3d moments;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) moments(row, column) = moment[static_cast<std::size_t>(row + column)];
    }
    const Eigen::Matrix3d inverse = moments.inverse();
    const auto fitted = [&](int power) -> Eigen::Vector3d {
      return inverse(power, 0) * products[0] + inverse(power, 1) * products[1] + inverse(power, 2) * products[2];
    };
    out.p_m.emplace_back(path.p_world_tip_m[i] + fitted(0));
    out.v_mps.emplace_back(fitted(1) / reach_s);
    NoiseGain of_p, of_v;
    for (std::size_t j = first; j < last; ++j) {
      const double u = times[j - first], w = weights[j - first], shared = j > first ? decay[j] : 0.0;
      of_p.add(w * (inverse(0, 0) + u * (inverse(0, 1) + u * inverse(0, 2))), shared);
      of_v.add(w * (inverse(1, 0) + u * (inverse(1, 1) + u * inverse(1, 2))) / reach_s, shared);
    }
    out.p_white.push_back(of_p.white());
    out.v_white_per_s.push_back(of_v.white());
    out.p_slow.push_back(of_p.slow());
    out.v_slow_per_s.push_back(of_v.slow());
  }
  return out;
}

}  // namespace asperity
