#include "asperity/calibration/fit_accelerometer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "asperity/algebra/solve.h"
#include "asperity/base/error.h"
#include "asperity/signal/student.h"
#include "fit_accelerometer_model.h"

namespace asperity {

namespace {

constexpr int kLinearParameters = 4;
// A pose nearer to an axis than this (cosine) covers that direction.
constexpr double kNear = 0.7;

void check_samples(const AccelerometerSamples& samples) {
  if (samples.counts.size() != samples.size() || samples.specific_force_mps2.size() != samples.size()) {
    throw Error(fmt::format("accelerometer: {} times, {} readings, {} specific forces", samples.size(),
                            samples.counts.size(), samples.specific_force_mps2.size()));
  }
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!samples.counts[i].allFinite() || !samples.specific_force_mps2[i].allFinite()) {
      throw Error(fmt::format("accelerometer: row {} is not finite", i + 1));
    }
  }
}

double mean_force(const ForcePoses& poses) { return std::sqrt(poses.features.middleCols<3>(3).rowwise().sum().mean()); }

std::string missing_directions(const ForcePoses& poses) {
  constexpr char kAxis[3] = {'x', 'y', 'z'};
  const double size = mean_force(poses);
  std::string out;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      if ((sign * poses.features.col(axis)).maxCoeff() > kNear * size) continue;
      out += fmt::format("{}{} {}", out.empty() ? "" : ", ", kAxis[axis], sign > 0.0 ? "up" : "down");
    }
  }
  return out;
}

// The singular values of (f/|f|, 1), the least of which over √poses tells how far the directions spread.
SingularValues directions_of(const ForcePoses& poses) {
  Eigen::MatrixXd G = design_matrix(poses, {0, 1, 2});
  const double size = mean_force(poses);
  G.leftCols<3>() /= size > 0.0 ? size : 1.0;
  return singular_values(G, SingularVectors::kThinV);
}

double spread_of(const ForcePoses& poses, const SingularValues& directions) {
  return directions.values[3] / std::sqrt(static_cast<double>(poses.size()));
}

// The spread; refuses directions that do not determine the linear model.
double check_directions(const ForcePoses& poses, const FitAccelerometerConfig& config) {
  if (poses.size() < config.fewest_poses) {
    throw Error(
        fmt::format("{} poses of known specific force, {} are needed: place the probe in a dozen directions, "
                    "every side up once, and hold each for two seconds",
                    poses.size(), config.fewest_poses));
  }
  const SingularValues svd = directions_of(poses);
  const double spread = spread_of(poses, svd);
  if (spread >= config.least_spread) return spread;
  Eigen::Index axis = 0;
  svd.V.col(3).head<3>().cwiseAbs().maxCoeff(&axis);
  const std::string missing = missing_directions(poses);
  throw Error(fmt::format(
      "the {} poses do not determine the accelerometer's model, least of all along the marker's {} axis, where the "
      "specific force goes from {:.3g} to {:.3g} m/s² only: {}",
      poses.size(), "xyz"[axis], poses.features.col(axis).minCoeff(), poses.features.col(axis).maxCoeff(),
      missing.empty() ? "add poses in other directions" : "add poses with " + missing));
}

AccelerometerModelFit fit_linear(const ForcePoses& poses) {
  return fit_accelerometer_terms(poses, AccelerometerModel::kLinear, {{{0, 1, 2}, {0, 1, 2}, {0, 1, 2}}});
}

// Of the linear model's residuals from pose to pose, the mean over the axes.
double neighbour_correlation(const ForcePoses& poses, const AccelerometerModelFit& fit) {
  const Eigen::MatrixXd left = poses.counts - poses.features.leftCols<3>() * fit.accelerometer.B.transpose();
  double out = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::ArrayXd r = left.col(axis).array() - fit.accelerometer.C[axis];
    const Eigen::Index n = r.size();
    const double square = r.square().sum();
    if (square > 0.0) out += (r.head(n - 1) * r.tail(n - 1)).sum() / square / 3.0;
  }
  return out;
}

// How likely chance alone lowers the sums of squares from `before` to `after` as much, by Fisher's F on each axis; the
// least of three, times three.
double improvement_probability(const AccelerometerModelFit& before, const AccelerometerModelFit& after) {
  double least = 1.0;
  const double more = after.parameters - before.parameters;
  for (int axis = 0; axis < 3; ++axis) {
    const double was = before.degrees_of_freedom * std::pow(before.accelerometer.residual_counts[axis], 2);
    const double is = after.degrees_of_freedom * std::pow(after.accelerometer.residual_counts[axis], 2);
    const double f = std::max(was - is, 0.0) / more / (is / after.degrees_of_freedom);
    least = std::min(least, fisher_tail(f, more, after.degrees_of_freedom));
  }
  return std::min(3.0 * least, 1.0);
}

const char* name_of(const AccelerometerModelFit& fit) {
  return kAccelerometerChoiceNames[1 + static_cast<std::size_t>(fit.accelerometer.model)].data();
}

std::array<int, 3> assign_axes(const ForcePoses& poses) {
  const Eigen::Matrix3d sums = line_sums(poses);
  std::array<int, 3> axes{0, 1, 2};
  std::array<int, 3> best = axes;
  double least = std::numeric_limits<double>::infinity();
  do {
    double sum = 0.0;
    for (int i = 0; i < 3; ++i) sum += sums(i, axes[static_cast<std::size_t>(i)]);
    if (sum < least) {
      least = sum;
      best = axes;
    }
  } while (std::next_permutation(axes.begin(), axes.end()));
  return best;
}

void choose_model(AccelerometerFit& out, const FitAccelerometerConfig& config) {
  if (config.model != AccelerometerChoice::kAuto) {
    const auto wanted = static_cast<AccelerometerModel>(static_cast<int>(config.model) - 1);
    const auto found = std::find_if(out.models.begin(), out.models.end(), [&](const AccelerometerModelFit& fit) {
      return fit.accelerometer.model == wanted;
    });
    if (found == out.models.end()) {
      throw Error(
          fmt::format("the quadric model was asked for, but {} poses do not determine it: add poses in many "
                      "directions, those between the axes too",
                      out.poses));
    }
    out.chosen = static_cast<std::size_t>(found - out.models.begin());
    out.reason = fmt::format("{} was asked for", name_of(*found));
    return;
  }
  for (std::size_t m = 1; m < out.models.size(); ++m) {
    if (out.models[m].bic < out.models[out.chosen].bic) out.chosen = m;
  }
  const AccelerometerModelFit& best = out.models[out.chosen];
  out.reason = fmt::format("{} has the lowest Schwarz criterion; its residual is {:.3g} counts", name_of(best),
                           best.accelerometer.residual_counts.mean());
  for (std::size_t m = 0; m < out.models.size(); ++m) {
    if (m == out.chosen) continue;
    const AccelerometerModelFit& other = out.models[m];
    out.reason += fmt::format(", that of {} {:.3g}", name_of(other), other.accelerometer.residual_counts.mean());
    if (m > out.chosen) {
      const int terms = 3 * (other.parameters - best.parameters);
      out.reason += fmt::format(" ({} more terms; by chance with probability {:.2g})", terms, other.better_probability);
    }
  }
}

void judge_accelerometer(AccelerometerFit& fit, double force_mps2, bool correlated,
                         const FitAccelerometerConfig& config) {
  const AccelerometerModelFit& chosen = fit.models[fit.chosen];
  const Eigen::Matrix3d B = chosen.accelerometer.B.leftCols<3>();
  const double scale = B.norm() / std::sqrt(3.0);
  const Eigen::MatrixXd& errors = chosen.accelerometer.standard_errors;
  const double slope_share = errors.leftCols<3>().maxCoeff() / scale;
  const double offset_share = errors.rightCols<1>().maxCoeff() / (scale * force_mps2);
  fit.verdict.text = fmt::format(
      "{} poses fit the {} model to {:.3g} counts; its factors are known to {:.2g} % of the scale.", fit.poses,
      name_of(chosen), chosen.accelerometer.residual_counts.mean(), 100.0 * std::max(slope_share, offset_share));
  if (!(std::max(slope_share, offset_share) <= config.uncertainty_share)) {
    fit.verdict.add("accelerometer_uncertain", fmt::format("the factors are known to {:.2g} % of the scale only",
                                                           100.0 * std::max(slope_share, offset_share)));
  }
  if (chosen.degrees_of_freedom < 4) {
    fit.verdict.add("too_few_poses", fmt::format("{} degrees of freedom are too few for valid standard errors",
                                                 chosen.degrees_of_freedom));
  }
  if (correlated) {
    fit.verdict.add("neighbours_alike",
                    fmt::format("the errors of neighbouring poses are alike (correlation {:.2f}), so the standard "
                                "errors are too small",
                                fit.correlation));
  }
}

}  // namespace

AccelerometerFit fit_accelerometer(const AccelerometerSamples& samples, const FitAccelerometerConfig& config) {
  check_samples(samples);
  ForcePoses poses = group_by_force(samples, config.same_pose_mps2);
  AccelerometerFit out;
  out.rows = samples.size();
  out.spread = check_directions(poses, config);
  AccelerometerModelFit linear = fit_linear(poses);
  out.correlation = neighbour_correlation(poses, linear);
  const auto correlated = [&](double sigmas) {
    return out.correlation * std::sqrt(static_cast<double>(poses.size())) > sigmas;
  };
  constexpr double kShown = 2.6;  // chance shows this once in two hundred
  constexpr double kGone = 0.5;   // once shown, averaging goes on until hardly anything is left
  constexpr Eigen::Index kFewestAveraged = 24;
  while (correlated(out.joined == 1 ? kShown : kGone) && poses.size() >= 2 * kFewestAveraged) {
    const ForcePoses pairs = average_pairs(poses);
    const double spread = spread_of(pairs, directions_of(pairs));
    if (!(spread >= config.least_spread)) break;  // neighbours face opposite ways: their mean says nothing
    poses = pairs;
    out.joined *= 2;
    out.spread = spread;
    linear = fit_linear(poses);
    out.correlation = neighbour_correlation(poses, linear);
  }
  out.poses = static_cast<std::size_t>(poses.size());
  const Eigen::VectorXd gain = singular_values(linear.accelerometer.B, SingularVectors::kNone).values;
  if (!(gain[2] > 1e-3 * gain[0])) {
    throw Error("the readings do not follow the specific force on all three axes: is an axis dead, or read twice?");
  }

  out.marker_axis = assign_axes(poses);
  std::array<std::vector<int>, 3> lines;
  for (std::size_t i = 0; i < 3; ++i) lines[i] = {out.marker_axis[i]};
  out.models.push_back(fit_accelerometer_terms(poses, AccelerometerModel::kScalarOffset, lines));
  out.models.push_back(linear);
  const std::vector<int> terms = determined_quadric_terms(poses, config.least_relative_singular_value);
  if (!terms.empty()) {
    out.models.push_back(fit_accelerometer_terms(poses, AccelerometerModel::kQuadric, {{terms, terms, terms}}));
    for (int term = 0; term < 9; ++term) {
      if (std::find(terms.begin(), terms.end(), term) == terms.end())
        out.models.back().dropped.emplace_back(term_name(term));
    }
  }
  for (std::size_t m = 1; m < out.models.size(); ++m) {
    out.models[m].better_probability = improvement_probability(out.models[m - 1], out.models[m]);
  }
  choose_model(out, config);
  out.accelerometer = out.models[out.chosen].accelerometer;
  judge_accelerometer(out, mean_force(poses), correlated(kShown), config);
  return out;
}

}  // namespace asperity
