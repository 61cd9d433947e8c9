#include "asperity/calibration/calibrate_accelerometer_field.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "asperity/algebra/solve.h"
#include "asperity/base/error.h"
#include "fit_ellipsoid.h"

namespace asperity {

namespace {

using Matrix9 = Eigen::Matrix<double, 9, 9>;

constexpr char kAxis[3] = {'i', 'j', 'k'};
constexpr int kParameters = 9;
// Half the angle between neighbouring faces and corners of a cube: a pose nearer than this covers a direction.
constexpr double kNear = 0.7;
// Above this share of gravity the readings do not fit an ellipsoid: poses alike differ by noise only.
constexpr double kNoEllipsoid = 0.1;

// "i up, k down": the directions along the sensor's axes near which there is no pose.
std::string missing_directions(const std::vector<Eigen::Vector3d>& counts, const Eigen::Vector3d& centre) {
  std::string out;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      const bool covered = std::any_of(counts.begin(), counts.end(), [&](const Eigen::Vector3d& c) {
        return sign * (c - centre).normalized()[axis] > kNear;
      });
      if (!covered) out += fmt::format("{}{} {}", out.empty() ? "" : ", ", kAxis[axis], sign > 0.0 ? "up" : "down");
    }
  }
  return out;
}

constexpr const char* kHowToHold =
    "Hold the probe still for two seconds each with every side up, and tilted between them.";

[[noreturn]] void refuse_directions(const std::vector<Eigen::Vector3d>& counts, const Eigen::Vector3d& centre,
                                    const std::string& why) {
  const std::string missing = missing_directions(counts, centre);
  throw Error(fmt::format("{}: {} poses were found, but {}. {}", why, counts.size(),
                          missing.empty() ? "too few of them are between the axes" : "none is near " + missing,
                          kHowToHold));
}

// Poses that lie in a plane, on a line or in one point leave even the ellipsoid's centre open.
void check_scatter(const std::vector<Eigen::Vector3d>& counts) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& c : counts) mean += c / static_cast<double>(counts.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& c : counts) scatter += (c - mean) * (c - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(scatter);
  constexpr double kFlat = 0.02;
  if (eigen.eigenvalues()[0] >= kFlat * eigen.eigenvalues()[2]) return;
  Eigen::Index axis = 0;
  eigen.eigenvectors().col(0).cwiseAbs().maxCoeff(&axis);
  const auto [low, high] = std::minmax_element(counts.begin(), counts.end(),
                                               [axis](const auto& a, const auto& b) { return a[axis] < b[axis]; });
  const char name = kAxis[axis];
  throw Error(
      fmt::format("the {} poses found hardly differ along the sensor's {} axis, which reads {:.6g} to {:.6g} "
                  "counts only: poses with {} up and with {} down are missing. {}",
                  counts.size(), name, (*low)[axis], (*high)[axis], name, name, kHowToHold));
}

double robust_deviation(const Eigen::VectorXd& r) {
  std::vector<double> size(static_cast<std::size_t>(r.size()));
  for (Eigen::Index i = 0; i < r.size(); ++i) size[static_cast<std::size_t>(i)] = std::abs(r[i]);
  const auto middle = size.begin() + static_cast<std::ptrdiff_t>(size.size() / 2);
  std::nth_element(size.begin(), middle, size.end());
  // 1.4826: a normal distribution's deviation over its median size; the rest: what nine parameters have absorbed.
  const auto n = static_cast<double>(r.size());
  return 1.4826 * *middle * std::sqrt(n / std::max(n - kParameters, 1.0));
}

EllipsoidFit fit_huber(const std::vector<Eigen::Vector3d>& counts, double g_mps2) {
  EllipsoidFit fit = fit_ellipsoid(counts, {}, start_ellipsoid(counts, g_mps2), g_mps2);
  constexpr int kRounds = 15;
  constexpr double kHuber = 1.345;
  for (int round = 0; round < kRounds; ++round) {
    const double edge = kHuber * robust_deviation(fit.distance_counts);
    if (!(edge > 0.0)) break;
    const Eigen::VectorXd weights = (edge / fit.distance_counts.array().abs().max(edge)).matrix();
    fit = fit_ellipsoid(counts, weights, fit.ellipsoid, g_mps2);
  }
  return fit;
}

std::vector<Eigen::Vector3d> chosen(const std::vector<Eigen::Vector3d>& counts, const std::vector<bool>& used) {
  std::vector<Eigen::Vector3d> out;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (used[i]) out.push_back(counts[i]);
  }
  return out;
}

Matrix9 cofactor(const EllipsoidFit& fit) {
  const SingularValues svd = singular_values(fit.slope, SingularVectors::kThinV);
  const Eigen::VectorXd inverse = svd.values.cwiseInverse();
  return svd.V * inverse.cwiseAbs2().asDiagonal() * svd.V.transpose();
}

double least_singular(const EllipsoidFit& fit) {
  return singular_values(fit.slope, SingularVectors::kNone).values[8] /
         std::sqrt(static_cast<double>(fit.slope.rows()));
}

// Leaves out poses that the others contradict, until the set stays.
EllipsoidFit fit_inliers(const std::vector<Eigen::Vector3d>& counts, const AccelerometerFieldConfig& config,
                         std::vector<bool>& used) {
  const double g = config.gravity_mps2;
  EllipsoidFit fit = fit_huber(counts, g);
  used.assign(counts.size(), true);
  constexpr int kRounds = 10;
  for (int round = 0; round < kRounds; ++round) {
    const EllipsoidFit all = measure_ellipsoid(counts, fit.ellipsoid, g);
    const double deviation = robust_deviation(all.distance_counts);
    const Matrix9 Q = cofactor(all);
    std::vector<bool> next(counts.size());
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const auto row = all.slope.row(static_cast<Eigen::Index>(i));
      const double own = std::clamp(1.0 - (row * Q * row.transpose()).value(), 0.05, 1.0);
      const double d = std::abs(all.distance_counts[static_cast<Eigen::Index>(i)]);
      next[i] = d <= config.outlier_sigmas * deviation * (round == 0 ? 1.0 : std::sqrt(own));
    }
    const auto inliers = chosen(counts, next);
    if (inliers.size() <= static_cast<std::size_t>(kParameters)) break;
    const bool same = next == used && round > 0;
    used = next;
    fit = fit_ellipsoid(inliers, {}, fit.ellipsoid, g);
    if (same) break;
  }
  return fit;
}

// Scales and angles of B's rows and, by their derivatives, the standard errors.
void describe_field(AccelerometerFieldResult& out, const Matrix9& covariance) {
  const Eigen::Matrix3d B = out.accelerometer.B;
  constexpr int kFirst[3] = {0, 1, 3};  // where a row of B begins among the parameters
  const auto block = [&](int a, int b) -> Eigen::MatrixXd {
    return covariance.block(kFirst[a], kFirst[b], a + 1, b + 1);
  };
  for (int a = 0; a < 3; ++a) {
    const Eigen::VectorXd row = B.row(a).head(a + 1).transpose();
    out.scale_counts_per_mps2[a] = row.norm();
    out.scale_stderr[a] = std::sqrt((row.transpose() * block(a, a) * row).value()) / row.norm();
    out.bias_stderr_counts[a] = std::sqrt(covariance(6 + a, 6 + a));
    for (int b = 0; b <= a; ++b) {
      out.accelerometer.standard_errors(a, b) = std::sqrt(covariance(kFirst[a] + b, kFirst[a] + b));
    }
    out.accelerometer.standard_errors(a, 3) = out.bias_stderr_counts[a];
  }
  int pair = 0;
  for (const auto& [a, b] : {std::pair{0, 1}, {0, 2}, {1, 2}}) {
    const double la = out.scale_counts_per_mps2[a];
    const double lb = out.scale_counts_per_mps2[b];
    const Eigen::Vector3d ua = B.row(a).transpose() / la;
    const Eigen::Vector3d ub = B.row(b).transpose() / lb;
    const double cosine = ua.dot(ub);
    const double sine = std::sqrt(1.0 - cosine * cosine);
    const Eigen::VectorXd da = ((ub - cosine * ua) / (la * sine)).head(a + 1);
    const Eigen::VectorXd db = ((ua - cosine * ub) / (lb * sine)).head(b + 1);
    const double variance = (da.transpose() * block(a, a) * da + db.transpose() * block(b, b) * db +
                             2.0 * da.transpose() * block(a, b) * db)
                                .value();
    out.misalignment_rad[pair] = std::asin(cosine);
    out.misalignment_stderr_rad[pair] = std::sqrt(variance);
    ++pair;
  }
}

CalibrationVerdict judge_field(const AccelerometerFieldResult& result, const AccelerometerFieldConfig& config) {
  const double g = config.gravity_mps2;
  const double scale_share = (result.scale_stderr.array() / result.scale_counts_per_mps2.array()).maxCoeff();
  const double bias_share = (result.bias_stderr_counts.array() / (g * result.scale_counts_per_mps2.array())).maxCoeff();
  const double residual_mps2 = result.residual_counts / result.scale_counts_per_mps2.mean();
  CalibrationVerdict out;
  out.text = fmt::format(
      "{} poses fit one ellipsoid to {:.2g} m/s²; scale is known to {:.2g} %, bias to {:.2g} m/s². Gravity does not "
      "determine the sensor's rotation to the marker.",
      result.used, result.rms_mps2, 100.0 * scale_share, bias_share * g);
  if (!(residual_mps2 <= config.residual_share * g)) {
    out.add(
        "gravity_missed",
        fmt::format(
            "the poses miss gravity by {:.2g} m/s² each: the probe was not still, or the accelerometer is not linear",
            residual_mps2));
  }
  const double angle_rad = result.misalignment_stderr_rad.maxCoeff();
  if (!(std::max({scale_share, bias_share, angle_rad}) <= config.uncertainty_share)) {
    out.add("accelerometer_uncertain",
            fmt::format("scale is known to {:.2g} %, bias to {:.2g} % of gravity and the axes' angles to {:.2g} mrad "
                        "only",
                        100.0 * scale_share, 100.0 * bias_share, 1e3 * angle_rad));
  }
  if (5 * (result.poses.size() - result.used) > result.poses.size()) {
    out.add("poses_contradict", fmt::format("{} of {} poses contradict the others", result.poses.size() - result.used,
                                            result.poses.size()));
  }
  return out;
}

}  // namespace

AccelerometerFieldResult calibrate_accelerometer_field(const AccelerometerSamples& samples,
                                                       const AccelerometerFieldConfig& config) {
  const StaticPoses found = find_static_poses(samples, config.poses);
  if (found.poses.size() < static_cast<std::size_t>(config.fewest_poses)) {
    throw Error(
        fmt::format("{} static poses were found, {} are needed: hold the probe still for two seconds each in a few "
                    "dozen directions, each side up once, and rotate it quickly between them",
                    found.poses.size(), config.fewest_poses));
  }
  std::vector<Eigen::Vector3d> counts;
  counts.reserve(found.poses.size());
  for (const StaticPose& pose : found.poses) counts.push_back(pose.mean_counts);
  check_scatter(counts);
  const double g = config.gravity_mps2;

  std::vector<bool> used;
  const EllipsoidFit fit = fit_inliers(counts, config, used);
  AccelerometerFieldResult out;
  out.used = static_cast<std::size_t>(std::count(used.begin(), used.end(), true));
  out.still_counts = found.still_counts;
  out.spread = least_singular(fit);
  const Eigen::Matrix3d& B = fit.ellipsoid.B;
  const double freedom = static_cast<double>(out.used) - kParameters;
  out.residual_counts = std::sqrt(fit.distance_counts.squaredNorm() / freedom);
  if (!fit.converged || !(out.spread >= config.least_spread)) {
    refuse_directions(counts, fit.ellipsoid.C, "the poses do not determine the calibration");
  }
  if (!(out.residual_counts <= kNoEllipsoid * g * B.norm() / std::sqrt(3.0))) {
    refuse_directions(counts, fit.ellipsoid.C, "the readings do not fit an ellipsoid");
  }

  out.accelerometer.model = AccelerometerModel::kLinear;
  out.accelerometer.B = Eigen::Matrix3d(B.triangularView<Eigen::Lower>());
  out.accelerometer.C = fit.ellipsoid.C;
  out.accelerometer.residual_counts.setConstant(out.residual_counts);
  out.accelerometer.standard_errors = Eigen::Matrix<double, 3, 4>::Zero();
  out.accelerometer.rotation_known = false;
  Eigen::Matrix<double, 9, 1> unit = Eigen::Matrix<double, 9, 1>::Ones();
  unit.head<6>() /= g;
  const Matrix9 covariance =
      out.residual_counts * out.residual_counts * (unit.asDiagonal() * cofactor(fit) * unit.asDiagonal()).eval();
  describe_field(out, covariance);

  const Eigen::Matrix3d inverse = B.inverse();
  double used_square = 0.0;
  double all_square = 0.0;
  for (std::size_t i = 0; i < found.poses.size(); ++i) {
    FieldPose pose;
    pose.pose = found.poses[i];
    pose.specific_force_mps2 = inverse * (counts[i] - fit.ellipsoid.C);
    pose.residual_mps2 = pose.specific_force_mps2.norm() - g;
    pose.used = used[i];
    all_square += pose.residual_mps2 * pose.residual_mps2;
    if (used[i]) used_square += pose.residual_mps2 * pose.residual_mps2;
    out.poses.push_back(pose);
  }
  out.rms_mps2 = std::sqrt(used_square / static_cast<double>(out.used));
  out.rms_all_mps2 = std::sqrt(all_square / static_cast<double>(counts.size()));
  out.verdict = judge_field(out, config);
  return out;
}

}  // namespace asperity
