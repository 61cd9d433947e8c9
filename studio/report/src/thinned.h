#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "asperity/studio/block.h"

namespace asperity::studio {

// Every k-th of `count` indices.
struct Chosen {
  std::size_t every = 1;
  std::vector<std::size_t> index;
};

inline Chosen choose_samples(std::size_t count, std::size_t at_most) {
  Chosen out;
  out.every = std::max<std::size_t>(1, (count + at_most - 1) / at_most);
  for (std::size_t i = 0; i < count; i += out.every) out.index.push_back(i);
  return out;
}

template <class Value>
std::vector<float> gather_values(const Chosen& chosen, Value value) {
  std::vector<float> out;
  out.reserve(chosen.index.size());
  for (const std::size_t i : chosen.index) out.push_back(static_cast<float>(value(i)));
  return out;
}

// An array [n, 3] of points from `origin_m`.
inline void add_points(BlockWriter& block, std::string_view name, const Chosen& chosen,
                       const std::vector<Eigen::Vector3d>& points_m, const Eigen::Vector3d& origin_m) {
  std::vector<float> out;
  for (const std::size_t i : chosen.index) {
    for (int axis = 0; axis < 3; ++axis) out.push_back(static_cast<float>(points_m[i][axis] - origin_m[axis]));
  }
  block.add(name, out, {chosen.index.size(), 3});
}

}  // namespace asperity::studio
