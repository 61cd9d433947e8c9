#include "asperity/signal/white_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace asperity {

Eigen::Vector3d white_noise(std::span<const double> t_s,
                            const std::function<Eigen::Vector3d(std::size_t i)>& fourth_difference) {
  constexpr std::size_t kWindow = 32;
  constexpr double kGain2 = 70.0;  // 1² + 4² + 6² + 4² + 1²
  Eigen::Vector3d out = Eigen::Vector3d::Zero();
  if (t_s.size() < 2) return out;
  std::vector<double> steps_s;
  for (std::size_t i = 1; i < t_s.size(); ++i) steps_s.push_back(t_s[i] - t_s[i - 1]);
  const auto middle = steps_s.begin() + static_cast<std::ptrdiff_t>(steps_s.size() / 2);
  std::nth_element(steps_s.begin(), middle, steps_s.end());
  const double longest_s = 1.5 * *middle;
  std::array<std::vector<double>, 3> levels;
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  std::size_t count = 0;
  for (std::size_t i = 2; i + 2 < t_s.size(); ++i) {
    if (t_s[i + 2] - t_s[i - 2] > 4.0 * longest_s) continue;
    sum += fourth_difference(i).array().square() / kGain2;
    if (++count < kWindow) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      levels[axis].push_back(std::sqrt(sum[static_cast<Eigen::Index>(axis)] / static_cast<double>(count)));
    }
    sum.setZero();
    count = 0;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (levels[axis].empty()) continue;
    const auto usual = levels[axis].begin() + static_cast<std::ptrdiff_t>(levels[axis].size() / 2);
    std::nth_element(levels[axis].begin(), usual, levels[axis].end());
    out[static_cast<Eigen::Index>(axis)] = *usual;
  }
  return out;
}

Eigen::Vector3d white_noise(std::span<const double> t_s, std::span<const Eigen::Vector3d> x) {
  return white_noise(t_s, [&](std::size_t i) -> Eigen::Vector3d {
    return x[i - 2] - 4.0 * x[i - 1] + 6.0 * x[i] - 4.0 * x[i + 1] + x[i + 2];
  });
}

}  // namespace asperity
