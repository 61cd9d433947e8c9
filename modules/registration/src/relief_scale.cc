#include "relief_scale.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace asperity::registration {

namespace {

constexpr std::size_t kTimes = 3;  // that the moving mean is taken off
constexpr double kLongest = 2.5;   // block, and the moving mean, over the shortest block
// Of the longest in what the moving means leave. Fewer are alike by chance: then a longer block is worth more.
constexpr double kBlocks = 4.0, kFewestBlocks = 2.0;

template <class T>
std::vector<T> running_sums(const std::vector<T>& x, T zero) {
  std::vector<T> out(x.size() + 1, zero);
  for (std::size_t i = 0; i < x.size(); ++i) out[i + 1] = out[i] + x[i];
  return out;
}

// The moving mean of x over 2 half + 1 values; shorter by `half` at either end.
template <class T>
std::vector<T> moving_mean(const std::vector<T>& x, std::size_t half, T zero) {
  if (x.size() < 2 * half + 1) return {};
  const std::vector<T> sums = running_sums(x, zero);
  std::vector<T> out;
  for (std::size_t i = half; i + half < x.size(); ++i) {
    out.push_back((sums[i + half + 1] - sums[i - half]) / static_cast<double>(2 * half + 1));
  }
  return out;
}

template <class T>
std::vector<T> less_smooth(const std::vector<T>& x, std::size_t half, T zero) {
  std::vector<T> out = moving_mean(moving_mean(x, half, zero), half, zero);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = x[i + 2 * half] - out[i];
  return out;
}

template <class T>
std::vector<T> without_bends(std::vector<T> x, std::size_t half, T zero) {
  for (std::size_t k = 0; k < kTimes; ++k) x = less_smooth(x, half, zero);
  return x;
}

template <class T, class Square>
double sum_of_squared_means(const std::vector<T>& sums, std::size_t length, Square square) {
  double out = 0.0;
  for (std::size_t i = 0; i + length < sums.size(); ++i) {
    out += square((sums[i + length] - sums[i]) / static_cast<double>(length));
  }
  return out;
}

// Of the mean over `length` values of white noise of variance 1 that has gone the same way as the path.
double white_variance(std::size_t length, std::size_t half) {
  std::vector<double> impulse(8 * kTimes * half + 2 * length + 1, 0.0);
  impulse[impulse.size() / 2] = 1.0;
  const std::vector<double> response = without_bends(std::move(impulse), half, 0.0);
  return sum_of_squared_means(running_sums(response, 0.0), length, [](double x) { return x * x; });
}

}  // namespace

ReliefScale measure_relief(std::span<const Eigen::Vector3d> x_m, std::span<const double> s_m, double shortest_m) {
  constexpr double kAlike = 4.0, kAlikeOfFew = 12.0;  // variances that a longer block is not worth
  constexpr double kFewest = 4.0;                     // points of a shortest block
  ReliefScale out{shortest_m, 0.0};
  if (x_m.size() < 2 || !(s_m.back() > s_m.front())) return out;
  const double spacing_m = (s_m.back() - s_m.front()) / static_cast<double>(x_m.size() - 1);
  const double shortest = shortest_m / spacing_m;
  if (!(shortest >= kFewest)) return out;
  const auto half = static_cast<std::size_t>(std::lround(0.5 * kLongest * shortest));
  const double blocks =
      (static_cast<double>(x_m.size()) - static_cast<double>(4 * kTimes * half)) / (kLongest * shortest);
  if (blocks < kFewestBlocks) return out;
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  const std::vector<Eigen::Vector3d> r_m =
      without_bends(std::vector<Eigen::Vector3d>(x_m.begin(), x_m.end()), half, zero);
  const std::vector<Eigen::Vector3d> sums = running_sums(r_m, zero);
  const auto square = [](const Eigen::Vector3d& x) { return x.squaredNorm(); };
  std::vector<double> ratio;
  const auto first = static_cast<std::size_t>(std::lround(shortest)),
             last = static_cast<std::size_t>(std::lround(kLongest * shortest));
  for (std::size_t n = first; n <= last; ++n) {
    ratio.push_back(sum_of_squared_means(sums, n, square) / static_cast<double>(sums.size() - n) /
                    white_variance(n, half));
  }
  const auto found = std::min_element(ratio.begin(), ratio.end());
  if (!((blocks < kBlocks ? kAlikeOfFew : kAlike) * *found < ratio.front())) return out;
  out.block_m = static_cast<double>(first + static_cast<std::size_t>(found - ratio.begin())) * spacing_m;
  out.rms_m = std::sqrt(sum_of_squared_means(sums, 1, square) / static_cast<double>(r_m.size()));
  return out;
}

}  // namespace asperity::registration
