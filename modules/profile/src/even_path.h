#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

namespace asperity {

// Vectors at evenly spaced times: the means of the samples about them, or their interpolation where the
// samples are sparser.
template <int N>
struct EvenPath {
  double start_s = 0.0;
  double step_s = 0.0;
  std::vector<Eigen::Matrix<double, N, 1>> p_m;

  std::size_t size() const { return p_m.size(); }
  double time_s(std::size_t i) const { return start_s + step_s * static_cast<double>(i); }
};

template <int N>
EvenPath<N> space_evenly(std::span<const double> t_s, std::span<const Eigen::Matrix<double, N, 1>> p_m,
                         double max_rate_hz);

// Each coordinate through the zero-phase second-order Butterworth low-pass, -3 dB at `cutoff_hz`; the
// path itself if that is beyond the rate.
template <int N>
EvenPath<N> low_pass(const EvenPath<N>& path, double cutoff_hz);

// The fraction index of time t in the path, clamped to it.
template <int N>
std::size_t index_at(const EvenPath<N>& path, double t_s) {
  const double x = (t_s - path.start_s) / path.step_s + 0.5;
  if (!(x > 0.0)) return 0;
  return std::min(static_cast<std::size_t>(x), path.size() - 1);
}

// The central difference, per second.
template <int N>
Eigen::Matrix<double, N, 1> velocity_mps(const EvenPath<N>& path, std::size_t i) {
  const std::size_t before = i == 0 ? 0 : i - 1;
  const std::size_t after = i + 1 < path.size() ? i + 1 : i;
  return (path.p_m[after] - path.p_m[before]) / (static_cast<double>(after - before) * path.step_s);
}

}  // namespace asperity
