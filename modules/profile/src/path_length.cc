#include "asperity/profile/path_length.h"

namespace asperity {

std::vector<double> path_length_m(std::span<const Eigen::Vector3d> p_m) {
  std::vector<double> s_m(p_m.size(), 0.0);
  for (std::size_t i = 1; i < p_m.size(); ++i) s_m[i] = s_m[i - 1] + (p_m[i] - p_m[i - 1]).norm();
  return s_m;
}

}  // namespace asperity
