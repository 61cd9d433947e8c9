#include "smooth_poses.h"

#include <algorithm>
#include <array>

#include <Eigen/LU>

namespace asperity {

namespace {

// Two numbers, and four, that are computed at once.
using Two [[gnu::vector_size(16)]] = double;
using Four [[gnu::vector_size(32)]] = double;

// What noise becomes in half of two weighted sums of poses, position and velocity: Σ w² of white noise, and
// Σ_i Σ_j w_i w_j exp(−|t_i − t_j|/time) of slow noise. The poses are added from both ends towards the middle, so that
// neither half waits for the other: the sum over pairs is that within each half and twice the product of what the two
// halves leave at the middle.
struct NoiseGains {
  Two white_square{}, slow_square{};
  Two all{};  // Σ w_j exp(−distance to the last/time)

  void add(Two weight, double decay) {
    const Two before = all * decay;
    all = before + weight;
    white_square += weight * weight;
    slow_square += weight * (weight + 2.0 * before);
  }
};

double white_gain(const NoiseGains& a, const NoiseGains& b, int sum) {
  return std::sqrt(a.white_square[sum] + b.white_square[sum]);
}

// `decay`: between the last poses of the two halves.
double slow_gain(const NoiseGains& a, const NoiseGains& b, double decay, int sum) {
  return std::sqrt(std::max(0.0, a.slow_square[sum] + b.slow_square[sum] + 2.0 * decay * a.all[sum] * b.all[sum]));
}

}  // namespace

std::vector<double> decay_between(const std::vector<double>& t_s, double time_s) {
  std::vector<double> out(t_s.size(), 0.0);
  for (std::size_t i = 1; i < t_s.size(); ++i) out[i] = std::exp(-(t_s[i] - t_s[i - 1]) / time_s);
  return out;
}

SmoothedPoses smooth_poses(const PosePath& path, double half_width_s, const std::vector<double>& decay) {
  const std::size_t n = path.t_s.size();
  SmoothedPoses out;
  std::size_t near_first = 0, near_last = 0;
  std::vector<double> weights, times;  // of the poses within reach; times from −1 to 1
  for (std::size_t i = 0; i < n; ++i) {
    while (path.t_s[i] - path.t_s[near_first] >= half_width_s) ++near_first;
    near_last = std::max(near_last, i + 1);
    while (near_last < n && path.t_s[near_last] - path.t_s[i] < half_width_s) ++near_last;
    std::size_t first = near_first, last = near_last;
    double reach_s = half_width_s;
    // A parabola needs poses, three on the average on either side.
    while (last - first < std::min<std::size_t>(5, n)) {
      reach_s *= 1.4;
      while (first > 0 && path.t_s[i] - path.t_s[first - 1] < reach_s) --first;
      while (last < n && path.t_s[last] - path.t_s[i] < reach_s) ++last;
    }
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
    const Two constant{inverse(0, 0), inverse(1, 0) / reach_s}, linear{inverse(0, 1), inverse(1, 1) / reach_s},
        square{inverse(0, 2), inverse(1, 2) / reach_s};
    const auto weight = [&](std::size_t k) {
      return weights[k] * (constant + times[k] * (linear + times[k] * square));
    };
    const std::size_t count = last - first, half = count / 2;
    NoiseGains a, b;
    for (std::size_t k = 0; k < half; ++k) {
      const std::size_t other = count - 1 - k;
      a.add(weight(k), decay[first + k]);  // of the first, of nothing
      b.add(weight(other), first + other + 1 < n ? decay[first + other + 1] : 0.0);
    }
    if (count % 2 == 1) a.add(weight(half), decay[first + half]);
    const std::size_t middle = first + count - half;  // the halves' last poses are neighbours
    const double shared = middle < n ? decay[middle] : 0.0;
    out.p_white.push_back(white_gain(a, b, 0));
    out.v_white_per_s.push_back(white_gain(a, b, 1));
    out.p_slow.push_back(slow_gain(a, b, shared, 0));
    out.v_slow_per_s.push_back(slow_gain(a, b, shared, 1));
  }
  return out;
}

}  // namespace asperity
