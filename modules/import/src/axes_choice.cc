#include "axes_choice.h"

#include <algorithm>

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <Eigen/LU>

namespace asperity {

std::string AxesChoice::name() const {
  std::string out;
  for (std::size_t i = 0; i < 3; ++i) {
    out += std::string(i == 0 ? "" : ",") + (sign[i] < 0 ? "-" : "") + "xyz"[axis[i]];
  }
  return out;
}

std::vector<AxesChoice> all_axes(double determinant) {
  std::vector<AxesChoice> out;
  std::array<int, 3> axis{0, 1, 2};
  do {
    for (int signs = 0; signs < 8; ++signs) {
      AxesChoice choice{axis, {}, Eigen::Matrix3d::Zero()};
      for (int i = 0; i < 3; ++i) {
        const auto at = static_cast<std::size_t>(i);
        choice.sign[at] = (signs >> i & 1) != 0 ? -1 : 1;
        choice.R(i, axis[at]) = choice.sign[at];
      }
      if (choice.R.determinant() * determinant > 0.0) out.push_back(choice);
    }
  } while (std::next_permutation(axis.begin(), axis.end()));
  return out;
}

std::string axes_text(const Eigen::Matrix3d& R) {
  for (const double determinant : {1.0, -1.0}) {
    for (const AxesChoice& choice : all_axes(determinant)) {
      if ((choice.R - R).cwiseAbs().maxCoeff() < 1e-6) return choice.name();
    }
  }
  const Eigen::Quaterniond q(R);
  return fmt::format("{:.5f},{:.5f},{:.5f},{:.5f}", q.w(), q.x(), q.y(), q.z());
}

}  // namespace asperity
