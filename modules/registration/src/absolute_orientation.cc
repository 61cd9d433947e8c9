#include "asperity/registration/absolute_orientation.h"

#include <cmath>

#include <fmt/format.h>
#include <Eigen/SVD>

#include "asperity/base/error.h"
#include "asperity/geometry/pose.h"

namespace asperity {
namespace {

// Below this ratio of the second to the first singular value the pairs lie on a line.
constexpr double kCollinear = 1e-7;

void check_point_pairs(std::span<const Eigen::Vector3d> a_m, std::span<const Eigen::Vector3d> b_m,
                       std::span<const double> weights) {
  if (a_m.size() != b_m.size()) {
    throw Error(fmt::format("absolute orientation: {} points against {}", a_m.size(), b_m.size()));
  }
  if (!weights.empty() && weights.size() != a_m.size()) {
    throw Error(fmt::format("absolute orientation: {} weights for {} pairs", weights.size(), a_m.size()));
  }
  std::size_t used = 0;
  for (std::size_t i = 0; i < a_m.size(); ++i) {
    if (!a_m[i].allFinite() || !b_m[i].allFinite()) {
      throw Error(fmt::format("absolute orientation: pair {} is not finite", i));
    }
    const double w = weights.empty() ? 1.0 : weights[i];
    if (!(w >= 0.0) || !std::isfinite(w)) {
      throw Error(fmt::format("absolute orientation: weight {} is {}, not a finite number of at least 0", i, w));
    }
    used += w > 0.0 ? 1 : 0;
  }
  if (used < 3) throw Error(fmt::format("absolute orientation: {} pairs of positive weight; three are needed", used));
}

}  // namespace

AbsoluteOrientation absolute_orientation(std::span<const Eigen::Vector3d> a_m, std::span<const Eigen::Vector3d> b_m,
                                         std::span<const double> weights) {
  check_point_pairs(a_m, b_m, weights);
  double sum = 0.0;
  Eigen::Vector3d mean_a = Eigen::Vector3d::Zero();
  Eigen::Vector3d mean_b = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < a_m.size(); ++i) {
    const double w = weights.empty() ? 1.0 : weights[i];
    sum += w;
    mean_a += w * a_m[i];
    mean_b += w * b_m[i];
  }
  mean_a /= sum;
  mean_b /= sum;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < a_m.size(); ++i) {
    const double w = weights.empty() ? 1.0 : weights[i];
    covariance += w * (b_m[i] - mean_b) * (a_m[i] - mean_a).transpose();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector3d& s = svd.singularValues();
  if (!(s(0) > 0.0)) throw Error("absolute orientation: the points of one set all coincide");

  AbsoluteOrientation out;
  out.collinear = s(1) <= kCollinear * s(0);
  if (out.collinear) {
    // The shortest turn that lays one line on the other.
    out.T_b_a.rotation = shortest_rotation(svd.matrixV().col(0), svd.matrixU().col(0));
  } else {
    const double sign = svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0 ? -1.0 : 1.0;
    const Eigen::Matrix3d rotation =
        svd.matrixU() * Eigen::Vector3d(1.0, 1.0, sign).asDiagonal() * svd.matrixV().transpose();
    out.T_b_a.rotation = Eigen::Quaterniond(rotation).normalized();
  }
  out.T_b_a.translation_m = mean_b - out.T_b_a.rotation * mean_a;
  double square = 0.0;
  for (std::size_t i = 0; i < a_m.size(); ++i) {
    const double w = weights.empty() ? 1.0 : weights[i];
    square += w * (out.T_b_a.rotation * (a_m[i] - mean_a) - (b_m[i] - mean_b)).squaredNorm();
  }
  out.rms_m = std::sqrt(square / sum);
  return out;
}

}  // namespace asperity
