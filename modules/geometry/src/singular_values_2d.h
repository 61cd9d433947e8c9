#pragma once

#include <cmath>

#include <Eigen/Core>

namespace asperity {

// F = U diag(high, low) Vᵀ with rotations U and V; low is negative where F turns over.
struct SingularValues2d {
  Eigen::Matrix2d U;
  Eigen::Matrix2d V;
  double high = 0.0;
  double low = 0.0;
};

// By the two angles of which sum and difference turn F's conformal and anticonformal part onto the axes (Blinn 1996).
inline SingularValues2d singular_values_2d(const Eigen::Matrix2d& F) {
  const double e = 0.5 * (F(0, 0) + F(1, 1)), f = 0.5 * (F(0, 0) - F(1, 1));
  const double g = 0.5 * (F(1, 0) + F(0, 1)), h = 0.5 * (F(1, 0) - F(0, 1));
  const double conformal = std::hypot(e, h), rest = std::hypot(f, g);
  const double sum = std::atan2(h, e), difference = std::atan2(g, f);
  const double of_u = 0.5 * (difference + sum), of_v = 0.5 * (difference - sum);
  SingularValues2d out;
  out.U << std::cos(of_u), -std::sin(of_u), std::sin(of_u), std::cos(of_u);
  out.V << std::cos(of_v), -std::sin(of_v), std::sin(of_v), std::cos(of_v);
  out.high = conformal + rest;
  out.low = conformal - rest;
  return out;
}

}  // namespace asperity
