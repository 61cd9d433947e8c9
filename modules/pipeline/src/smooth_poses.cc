#include "smooth_poses.h"

#include <algorithm>
#include <array>

#include <Eigen/LU>

namespace asperity {

namespace {

// Two numbers, and four, that are computed at once.
using Two [[gnu::vector_size(16)]] = double;
using Four [[gnu::vector_size(32)]] = double;

// What noise becomes in two weighted sums of poses, which are added in the order of time.
struct NoiseGains {
  Two white_square{}, slow_square{};
  Two before{};  // Σ_{j<i} w_j exp(−(t_i − t_j)/time)
  Two last{};

  void add(Two weight, double decay) {
    before = (before + last) * decay;
    last = weight;
    white_square += weight * weight;
    slow_square += weight * (weight + 2.0 * before);
  }
  double white(int sum) const { return std::sqrt(white_square[sum]); }
  double slow(int sum) const { return std::sqrt(std::max(0.0, slow_square[sum])); }
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
    std::array<double, 5> moment{};  // Σ w u^k
    Four sum0{}, sum1{}, sum2{};     // Σ w u^k (q − q_i), and of w u^k itself
    const Eigen::Vector3d& here = path.p_world_tip_m[i];
    weights.resize(last - first);
    times.resize(last - first);
    for (std::size_t j = first; j < last; ++j) {
      const double u = (path.t_s[j] - path.t_s[i]) / reach_s;
      const double w = (1.0 - u * u) * (1.0 - u * u), wu = w * u, wuu = wu * u;
      times[j - first] = u;
      weights[j - first] = w;
      moment[3] += wuu * u;
      moment[4] += wuu * u * u;
      const Eigen::Vector3d& there = path.p_world_tip_m[j];
      const Four apart{there.x() - here.x(), there.y() - here.y(), there.z() - here.z(), 1.0};
      sum0 += w * apart;
      sum1 += wu * apart;
      sum2 += wuu * apart;
    }
    moment[0] = sum0[3];
    moment[1] = sum1[3];
    moment[2] = sum2[3];
    Eigen::Matrix3d moments;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) moments(row, column) = moment[static_cast<std::size_t>(row + column)];
    }
    const Eigen::Matrix3d inverse = moments.inverse();
    const auto fitted = [&](int power) -> Eigen::Vector3d {
      const Four sum = inverse(power, 0) * sum0 + inverse(power, 1) * sum1 + inverse(power, 2) * sum2;
      return {sum[0], sum[1], sum[2]};
    };
    out.p_m.emplace_back(path.p_world_tip_m[i] + fitted(0));
    out.v_mps.emplace_back(fitted(1) / reach_s);
    NoiseGains gains;  // of position and velocity
    const Two constant{inverse(0, 0), inverse(1, 0) / reach_s}, linear{inverse(0, 1), inverse(1, 1) / reach_s},
        square{inverse(0, 2), inverse(1, 2) / reach_s};
    for (std::size_t j = first; j < last; ++j) {
      const double u = times[j - first], shared = j > first ? decay[j] : 0.0;
      gains.add(weights[j - first] * (constant + u * (linear + u * square)), shared);
    }
    out.p_white.push_back(gains.white(0));
    out.v_white_per_s.push_back(gains.white(1));
    out.p_slow.push_back(gains.slow(0));
    out.v_slow_per_s.push_back(gains.slow(1));
  }
  return out;
}

}  // namespace asperity
