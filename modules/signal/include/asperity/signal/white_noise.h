#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include <Eigen/Core>

namespace asperity {

// The white noise an axis of rows at nearly even times, by their fourth differences, which a smooth motion hardly
// enters: the median over windows of 32 rows, which outliers in fewer than half of them do not move. Differences over
// gaps are left out. Zero if there are fewer than 32 differences.
Eigen::Vector3d white_noise(std::span<const double> t_s, std::span<const Eigen::Vector3d> x);

// The same from x[i-2] − 4 x[i-1] + 6 x[i] − 4 x[i+1] + x[i+2], where that is not of vectors; `i` is from 2 to two
// before the end.
Eigen::Vector3d white_noise(std::span<const double> t_s,
                            const std::function<Eigen::Vector3d(std::size_t i)>& fourth_difference);

}  // namespace asperity
