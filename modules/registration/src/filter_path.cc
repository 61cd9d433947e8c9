#include "filter_path.h"

#include <algorithm>
#include <cmath>

namespace asperity::registration {

namespace {

constexpr double kOutlier2 = 16.0;  // squared standard deviations that a block costs at most

}  // namespace

template <int kRows>
void filter_path(const PathBlocks& blocks, std::size_t path_number, std::span<const BlockHeight> heights,
                 double slow_ratio, double noise_m, const WeighConfig& config, FilterSums<kRows>& out) {
  const PathBlocks::Path& path = blocks.paths[path_number];
  constexpr int kColumns = kRows + 1;
  using Columns = Eigen::Matrix<double, kColumns, 1>;
  const double noise_m2 = noise_m * noise_m;
  const double mean_m2 = std::pow(config.relief_mean_ratio * noise_m, 2) + std::pow(path.relief.rms_m, 2);
  const Eigen::Matrix3d C_m2 = slow_ratio * slow_ratio * path.covariance_m2;
  Eigen::Matrix4d P = Eigen::Matrix4d::Zero();
  P.topLeftCorner<3, 3>() = C_m2;
  P(3, 3) = mean_m2;
  Eigen::Matrix<double, 4, kColumns> X = Eigen::Matrix<double, 4, kColumns>::Zero();
  for (std::size_t b = path.first; b < path.first + path.count; ++b) {
    const BlockHeight& height = heights[b];
    if (b > path.first) {
      const double keep = config.slow_length_m > 0.0
                              ? std::exp(-(blocks.blocks[b].s_m - blocks.blocks[b - 1].s_m) / config.slow_length_m)
                              : 0.0;
      P.topLeftCorner<3, 3>() = keep * keep * P.topLeftCorner<3, 3>() + (1.0 - keep * keep) * C_m2;
      P.topRightCorner<3, 1>() *= keep;
      P.bottomLeftCorner<1, 3>() *= keep;
      X.template topRows<3>() *= keep;
    }
    if (!height.usable) {
      out.cost += kOutlier2 + std::log(noise_m2 + C_m2.trace() / 3.0);
      ++out.outlying;
      continue;
    }
    const Eigen::Vector4d h(height.n_world.x(), height.n_world.y(), height.n_world.z(), 1.0);
    const Eigen::Vector4d Ph = P * h;
    const double S = h.dot(Ph) + noise_m2;
    Columns z = -(X.transpose() * h);
    z[0] += height.d_m;
    const double square = z[0] * z[0] / S;
    out.cost += std::min(square, kOutlier2) + std::log(S);
    if (square > kOutlier2) {
      ++out.outlying;
      continue;
    }
    if constexpr (kRows > 0) {
      z.template tail<kRows>() += height.row.template head<kRows>();
      const Eigen::Matrix<double, kRows, 1> row = z.template tail<kRows>();
      out.information += row * row.transpose() / S;
      out.gradient += z[0] / S * row;
    }
    const Eigen::Vector4d gain = Ph / S;
    X += gain * z.transpose();
    P -= gain * Ph.transpose();
  }
}

template void filter_path<0>(const PathBlocks&, std::size_t, std::span<const BlockHeight>, double, double,
                             const WeighConfig&, FilterSums<0>&);
template void filter_path<6>(const PathBlocks&, std::size_t, std::span<const BlockHeight>, double, double,
                             const WeighConfig&, FilterSums<6>&);
template void filter_path<7>(const PathBlocks&, std::size_t, std::span<const BlockHeight>, double, double,
                             const WeighConfig&, FilterSums<7>&);
template void filter_path<10>(const PathBlocks&, std::size_t, std::span<const BlockHeight>, double, double,
                              const WeighConfig&, FilterSums<10>&);

}  // namespace asperity::registration
