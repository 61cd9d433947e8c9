#include "camera_covariance.h"

#include <cmath>
#include <utility>

#include <Eigen/Eigenvalues>

namespace asperity {

namespace {
constexpr Eigen::Index kSide = 9;
}

bool take_camera_covariance(const Json& value, CameraCalibration& camera) {
  const auto is_row = [](const Json& row) { return row.is_array() && row.size() == static_cast<std::size_t>(kSide); };
  if (!is_row(value)) return false;
  Eigen::Matrix<double, kSide, kSide> out;
  for (Eigen::Index i = 0; i < kSide; ++i) {
    const Json& row = value[i];
    if (!is_row(row)) return false;
    for (Eigen::Index j = 0; j < kSide; ++j) {
      if (!row[j].is_number()) return false;
      out(i, j) = row[j].get<double>();
    }
  }
  if (!out.allFinite() || out.diagonal().minCoeff() < 0.0) return false;
  out = (0.5 * (out + out.transpose())).eval();
  // In units of the standard errors, so that px and coefficients count alike.
  Eigen::Matrix<double, kSide, 1> scale;
  for (Eigen::Index i = 0; i < kSide; ++i) scale[i] = out(i, i) > 0.0 ? 1.0 / std::sqrt(out(i, i)) : 0.0;
  const Eigen::Matrix<double, kSide, kSide> correlation = scale.asDiagonal() * out * scale.asDiagonal();
  constexpr double kRounding = 1e-9;
  if (!correlation.allFinite()) return false;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, kSide, kSide>> eigen(correlation, Eigen::EigenvaluesOnly);
  if (!(eigen.eigenvalues().minCoeff() > -kRounding)) return false;
  camera.covariance = out;
  return true;
}

Json camera_covariance_json(const CameraCalibration& camera) {
  if (!camera.covariance) return nullptr;
  Json out = Json::array();
  for (Eigen::Index i = 0; i < kSide; ++i) {
    Json row = Json::array();
    for (Eigen::Index j = 0; j < kSide; ++j) row.push_back((*camera.covariance)(i, j));
    out.push_back(std::move(row));
  }
  return out;
}

}  // namespace asperity
