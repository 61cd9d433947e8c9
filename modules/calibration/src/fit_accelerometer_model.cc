#include "fit_accelerometer_model.h"

#include <algorithm>
#include <cmath>

#include "asperity/algebra/solve.h"

namespace asperity {

namespace {

// Least squares through the SVD of the design with columns of length one.
struct Solved {
  Eigen::VectorXd parameters;
  Eigen::MatrixXd cofactor;
  double sum = 0.0;  // of the squares left
};

Solved solve_columns(const Eigen::MatrixXd& G, const Eigen::VectorXd& counts) {
  const Eigen::VectorXd length = G.colwise().norm().transpose();
  const Eigen::VectorXd shrink = length.cwiseInverse();
  const SingularValues svd = singular_values(G * shrink.asDiagonal(), SingularVectors::kThin);
  const Eigen::VectorXd inverse = svd.values.cwiseInverse();
  const Eigen::MatrixXd root = shrink.asDiagonal() * svd.V * inverse.asDiagonal();
  Solved out;
  // About the mean, so that an offset of tens of thousands of counts costs no digits.
  const double mean = counts.mean();
  const Eigen::VectorXd about = (counts.array() - mean).matrix();
  out.parameters = root * (svd.U.transpose() * about);
  out.sum = (about - G * out.parameters).squaredNorm();
  out.parameters[out.parameters.size() - 1] += mean;
  out.cofactor = root * root.transpose();
  return out;
}

double relative_singular_value(const Eigen::MatrixXd& G) {
  const Eigen::VectorXd shrink = G.colwise().norm().transpose().cwiseInverse();
  if (!shrink.allFinite()) return 0.0;
  const SingularValues svd = singular_values(G * shrink.asDiagonal(), SingularVectors::kNone);
  return svd.values[svd.values.size() - 1] / svd.values[0];
}

}  // namespace

const char* term_name(int term) {
  constexpr const char* kNames[9] = {"x", "y", "z", "x²", "y²", "z²", "xy", "xz", "yz"};
  return kNames[term];
}

Eigen::MatrixXd design_matrix(const ForcePoses& poses, const std::vector<int>& terms) {
  Eigen::MatrixXd G(poses.size(), static_cast<Eigen::Index>(terms.size()) + 1);
  for (std::size_t k = 0; k < terms.size(); ++k) G.col(static_cast<Eigen::Index>(k)) = poses.features.col(terms[k]);
  G.col(G.cols() - 1).setOnes();
  return G;
}

Eigen::Matrix3d line_sums(const ForcePoses& poses) {
  Eigen::Matrix3d out;
  for (int axis = 0; axis < 3; ++axis) {
    for (int marker = 0; marker < 3; ++marker)
      out(axis, marker) = solve_columns(design_matrix(poses, {marker}), poses.counts.col(axis)).sum;
  }
  return out;
}

AccelerometerModelFit fit_accelerometer_terms(const ForcePoses& poses, AccelerometerModel model,
                                              const std::array<std::vector<int>, 3>& terms) {
  AccelerometerModelFit out;
  AccelerometerCalibration& accelerometer = out.accelerometer;
  const int width = model == AccelerometerModel::kQuadric ? 9 : 3;
  accelerometer.model = model;
  accelerometer.B = Eigen::MatrixXd::Zero(3, width);
  accelerometer.standard_errors = Eigen::MatrixXd::Zero(3, width + 1);
  out.parameters = static_cast<int>(terms[0].size()) + 1;
  out.degrees_of_freedom = static_cast<int>(poses.size()) - out.parameters;
  const auto n = static_cast<double>(poses.size());
  for (int axis = 0; axis < 3; ++axis) {
    const auto at = static_cast<std::size_t>(axis);
    const Eigen::VectorXd counts = poses.counts.col(axis);
    const Solved solved = solve_columns(design_matrix(poses, terms[at]), counts);
    const double sigma = std::sqrt(solved.sum / out.degrees_of_freedom);
    accelerometer.residual_counts[axis] = sigma;
    for (std::size_t k = 0; k < terms[at].size(); ++k) {
      const auto entry = static_cast<Eigen::Index>(k);
      const double error = sigma * std::sqrt(solved.cofactor(entry, entry));
      accelerometer.B(axis, terms[at][k]) = solved.parameters[entry];
      accelerometer.standard_errors(axis, terms[at][k]) = error;
      if (std::abs(solved.parameters[entry]) > 3.0 * error) ++out.significant;
    }
    const Eigen::Index last = solved.parameters.size() - 1;
    accelerometer.C[axis] = solved.parameters[last];
    accelerometer.standard_errors(axis, width) = sigma * std::sqrt(solved.cofactor(last, last));
    // Readings without any noise would have no logarithm.
    const double least = 1e-24 * n * std::max(counts.squaredNorm() / n, 1e-300);
    out.bic += n * std::log(std::max(solved.sum, least) / n) + out.parameters * std::log(n);
    if (axis == 0) out.cofactor = solved.cofactor;
  }
  return out;
}

std::vector<int> determined_quadric_terms(const ForcePoses& poses, double least_relative_singular_value) {
  constexpr Eigen::Index kFewestLeft = 4;
  std::vector<int> terms{0, 1, 2, 3, 4, 5, 6, 7, 8};
  const auto determined = [&](const std::vector<int>& chosen) {
    return relative_singular_value(design_matrix(poses, chosen)) >= least_relative_singular_value;
  };
  const auto enough = [&](const std::vector<int>& chosen) {
    return poses.size() >= static_cast<Eigen::Index>(chosen.size()) + 1 + kFewestLeft;
  };
  for (const int square : {-1, 5, 4, 3}) {
    std::vector<int> chosen = terms;
    std::erase(chosen, square);
    if (enough(chosen) && determined(chosen)) return chosen;
  }
  return {};
}

}  // namespace asperity
