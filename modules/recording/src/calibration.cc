#include "asperity/recording/calibration.h"

#include <cmath>

#include <Eigen/LU>

#include "asperity/base/error.h"

namespace asperity {

namespace {

using Features = Eigen::Matrix<double, 9, 1>;
using FeatureSlopes = Eigen::Matrix<double, 9, 3>;

Features features(const Eigen::Vector3d& f) {
  Features out;
  out << f, f.cwiseAbs2(), f.x() * f.y(), f.x() * f.z(), f.y() * f.z();
  return out;
}

FeatureSlopes feature_slopes(const Eigen::Vector3d& f) {
  FeatureSlopes out = FeatureSlopes::Zero();
  out.topRows<3>().setIdentity();
  for (int i = 0; i < 3; ++i) out(3 + i, i) = 2.0 * f[i];
  out.row(6) << f.y(), f.x(), 0.0;
  out.row(7) << f.z(), 0.0, f.x();
  out.row(8) << 0.0, f.z(), f.y();
  return out;
}

Eigen::Vector3d solve_invertible(const Eigen::Matrix3d& matrix, const Eigen::Vector3d& right) {
  const Eigen::FullPivLU<Eigen::Matrix3d> lu(matrix);
  if (!lu.isInvertible()) throw Error("accelerometer.B: its linear part is singular");
  return lu.solve(right);
}

}  // namespace

Eigen::Vector3d AccelerometerCalibration::counts(const Eigen::Vector3d& specific_force_mps2) const {
  if (B.cols() == 9) return B * features(specific_force_mps2) + C;
  return B * specific_force_mps2 + C;
}

Eigen::Vector3d AccelerometerCalibration::specific_force_mps2(const Eigen::Vector3d& counts_read) const {
  if (B.cols() == 3) {
    // The closed form, since this runs once a sample; the checked solver takes what it cannot.
    Eigen::Matrix3d inverse;
    bool invertible = false;
    Eigen::Matrix3d(B).computeInverseWithCheck(inverse, invertible);
    return invertible ? Eigen::Vector3d(inverse * (counts_read - C)) : solve_invertible(B, counts_read - C);
  }
  Eigen::Vector3d f = solve_invertible(B.leftCols<3>(), counts_read - C);
  double error = (counts(f) - counts_read).squaredNorm();
  constexpr int kMostSteps = 50;
  for (int step = 0; step < kMostSteps && error > 0.0; ++step) {
    const Eigen::FullPivLU<Eigen::Matrix3d> slope(B * feature_slopes(f));
    if (!slope.isInvertible()) break;
    const Eigen::Vector3d full = slope.solve(counts_read - counts(f));
    double fraction = 1.0;
    Eigen::Vector3d next = f + full;
    double next_error = (counts(next) - counts_read).squaredNorm();
    while (!(next_error < error) && fraction > 1e-6) {
      fraction *= 0.5;
      next = f + fraction * full;
      next_error = (counts(next) - counts_read).squaredNorm();
    }
    if (!(next_error < error)) break;
    f = next;
    error = next_error;
  }
  return f;
}

Eigen::Vector3d Calibration::force_axis_in_marker() const {
  const Eigen::Vector3d axis = force.axis_in_marker.value_or(-tip_in_marker_m);
  const double length = axis.norm();
  if (!(length > 0.0) || !std::isfinite(length)) {
    throw Error(
        "calibration: the force axis has no direction: force.axis_in_marker is needed where the tip is the marker's "
        "origin");
  }
  return axis / length;
}

Eigen::Vector3d Force3Calibration::force_N(const Eigen::Vector3d& counts) const {
  const Eigen::FullPivLU<Eigen::Matrix3d> lu(B);
  if (!lu.isInvertible()) throw Error("force3.B: it is singular");
  return lu.solve(counts - C);
}

std::optional<Eigen::Vector3d> Calibration::tip_stderr_m() const {
  const auto record = calibrated.find("tip");
  if (record == calibrated.end() || !record->second.details.is_object()) return std::nullopt;
  const Json* errors = record->second.details.find("stderr");
  const Json* list = errors != nullptr && errors->is_object() ? errors->find("tip_in_marker_m") : nullptr;
  if (list == nullptr || !list->is_array() || list->size() != 3) return std::nullopt;
  Eigen::Vector3d out;
  for (std::size_t i = 0; i < 3; ++i) {
    const Json& each = (*list)[i];
    if (!each.is_number() || !(each.get<double>() >= 0.0) || !std::isfinite(each.get<double>())) return std::nullopt;
    out[static_cast<Eigen::Index>(i)] = each.get<double>();
  }
  return out;
}

}  // namespace asperity
