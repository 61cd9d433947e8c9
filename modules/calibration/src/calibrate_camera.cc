#include "asperity/calibration/calibrate_camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Cholesky>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/signal/statistics.h"
#include "camera_bundle.h"
#include "camera_start.h"
#include "camera_views.h"

namespace asperity {

namespace {

using Views = std::vector<const BoardView*>;

constexpr int kK3 = 8;

double degrees(double rad) { return rad * 180.0 / std::numbers::pi; }

std::size_t count_corners(const Views& views) {
  std::size_t corners = 0;
  for (const BoardView* view : views) corners += view->corner_px.size();
  return corners;
}

double degrees_of_freedom(const Views& views, const CameraBundle& bundle) {
  const auto parameters = static_cast<double>(std::count(bundle.free.begin(), bundle.free.end(), true));
  return 2.0 * static_cast<double>(count_corners(views)) - parameters - 6.0 * static_cast<double>(views.size());
}

// The camera's covariance for corners of 1 px error; infinite variances where nothing is determined.
CameraMatrix unit_covariance(const CameraBundle& bundle) {
  CameraMatrix information = bundle.information;
  for (int k = 0; k < information.rows(); ++k) {
    if (!bundle.free[static_cast<std::size_t>(k)]) information(k, k) = 1.0;
  }
  const CameraVector scale = information.diagonal().cwiseAbs().cwiseSqrt().cwiseInverse();
  const Eigen::LDLT<CameraMatrix> factors(CameraMatrix(scale.asDiagonal() * information * scale.asDiagonal()));
  if (!scale.allFinite() || !factors.isPositive() || !(factors.vectorD().minCoeff() > 0.0)) {
    return CameraMatrix::Identity() * std::numeric_limits<double>::infinity();
  }
  CameraMatrix covariance = scale.asDiagonal() * factors.solve(CameraMatrix(scale.asDiagonal()));
  for (int k = 0; k < covariance.rows(); ++k) {
    if (bundle.free[static_cast<std::size_t>(k)]) continue;
    covariance.row(k).setZero();
    covariance.col(k).setZero();
  }
  return covariance;
}

struct Fit {
  CameraBundle bundle;
  double sigma_px = 0.0;
  CameraMatrix covariance;  // for independent corners
};

Fit refine_bundle(const Views& views, CameraBundle start, bool k3_free, int most_iterations) {
  Fit fit{std::move(start), 0.0, {}};
  fit.bundle.free.fill(true);
  fit.bundle.free[kK3] = k3_free;
  if (!k3_free) fit.bundle.parameters[kK3] = 0.0;
  refine_bundle(views, most_iterations, fit.bundle);
  const double freedom = degrees_of_freedom(views, fit.bundle);
  fit.sigma_px = std::sqrt(fit.bundle.sum_of_squares_px2 / freedom);
  fit.covariance = fit.sigma_px * fit.sigma_px * unit_covariance(fit.bundle);
  return fit;
}

// Whether the data ask for k3: by Schwarz's criterion, which a coefficient of nothing passes at these numbers of
// corners in one calibration of a hundred and fifty.
Fit choose_model(const Views& views, const CameraBundle& start, const CameraFitConfig& config, double& k3_over_error) {
  Fit without = refine_bundle(views, start, false, config.most_iterations);
  if (unmirror_poses(views, without.bundle))
    without = refine_bundle(views, without.bundle, false, config.most_iterations);
  if (config.k3 == ThirdRadialTerm::kZero) return without;
  Fit with = refine_bundle(views, without.bundle, true, config.most_iterations);
  k3_over_error = with.bundle.parameters[kK3] / std::sqrt(with.covariance(kK3, kK3));
  if (config.k3 == ThirdRadialTerm::kFree) return with;
  const double numbers = 2.0 * static_cast<double>(count_corners(views));
  return k3_over_error * k3_over_error > std::log(numbers) ? with : without;
}

// Variance between views over that within (docs/calibration-optics.md).
void measure_dispersion(const Fit& fit, CameraFit& out) {
  std::vector<int> free;
  for (int k = 0; k < static_cast<int>(kCameraParameters); ++k) {
    if (fit.bundle.free[static_cast<std::size_t>(k)]) free.push_back(k);
  }
  const Eigen::MatrixXd information = fit.bundle.information(free, free);
  const Eigen::VectorXd scale = information.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::LLT<Eigen::MatrixXd> root(scale.asDiagonal() * information * scale.asDiagonal());
  if (root.info() != Eigen::Success || !(fit.sigma_px > 0.0)) return;
  double between = 0.0, leverage = 0.0;
  for (std::size_t v = 0; v < fit.bundle.view_score.size(); ++v) {
    const Eigen::VectorXd score = scale.asDiagonal() * fit.bundle.view_score[v](free);
    between += root.matrixL().solve(score).squaredNorm() / (fit.sigma_px * fit.sigma_px);
    const Eigen::MatrixXd share = scale.asDiagonal() * fit.bundle.view_information[v](free, free) * scale.asDiagonal();
    const Eigen::MatrixXd half = root.matrixL().solve(share);
    leverage += root.matrixL().solve(half.transpose()).squaredNorm();
  }
  const double expected = static_cast<double>(free.size()) - leverage;
  if (!(expected > 0.0)) return;
  out.dispersion = between / expected;
  out.dispersion_error = std::sqrt(2.0 * leverage) / expected;
  constexpr double kByChance = 2.0;
  out.errors_scaled = out.dispersion > 1.0 + kByChance * out.dispersion_error;
}

std::vector<double> rms_by_view_px(const Views& views, const CameraBundle& bundle) {
  std::vector<double> out;
  for (std::size_t v = 0; v < views.size(); ++v) {
    const double sum = view_sum_of_squares_px2(*views[v], bundle.parameters, bundle.T_camera_board[v]);
    out.push_back(std::sqrt(sum / static_cast<double>(views[v]->corner_px.size())));
  }
  return out;
}

CameraFitView describe_view(const BoardView& view, const CameraVector& parameters, const Pose& T_camera_board,
                            bool used) {
  CameraFitView out;
  out.name = view.name;
  out.corners = view.corner_px.size();
  out.rms_px = std::sqrt(view_sum_of_squares_px2(view, parameters, T_camera_board) / static_cast<double>(out.corners));
  out.tilt_rad = std::acos(std::min(1.0, std::abs((T_camera_board.rotation * Eigen::Vector3d::UnitZ()).z())));
  out.T_camera_board = T_camera_board;
  out.used = used;
  return out;
}

void refuse_undetermined(const CameraFit& fit, const CameraFitConfig& config) {
  std::vector<double> tilts;
  for (const CameraFitView& view : fit.views) {
    if (view.used) tilts.push_back(view.tilt_rad);
  }
  std::sort(tilts.begin(), tilts.end());
  const double fx_share = fit.standard_error[0] / fit.camera.fx, fy_share = fit.standard_error[1] / fit.camera.fy;
  const double share = std::max(fx_share, fy_share);
  const std::string advice = "take images with the board tilted by 20 to 45 degrees, to the left, right, up and down";
  if (tilts[tilts.size() - 2] < config.least_tilt_rad) {
    throw Error(
        fmt::format("calibrate camera: the board was always frontal (steepest tilt {:.0f} degrees), which does not "
                    "determine the focal length: {}",
                    degrees(tilts.back()), advice));
  }
  if (!(share <= config.largest_focal_error)) {
    throw Error(
        fmt::format("calibrate camera: the focal length is not determined ({:.0f} ± {:.0f} px; steepest tilt {:.0f} "
                    "degrees): {}",
                    fit.camera.fx, share * fit.camera.fx, degrees(tilts.back()), advice));
  }
}

CalibrationVerdict judge_camera(const CameraFit& fit, const CameraFitConfig& config) {
  const double share = std::max(fit.standard_error[0] / fit.camera.fx, fit.standard_error[1] / fit.camera.fy);
  CalibrationVerdict verdict;
  verdict.text = fmt::format("focal length to {:.2f} %, corners within {:.2f} px RMS;{}.", 100.0 * share, fit.rms_px,
                             fit.k3_free ? " k3 was fitted: the distortion requires it" : " k3 is held at 0");
  if (!fit.converged) verdict.add("camera_not_converged", "the fit did not converge");
  if (fit.rms_px > config.good_rms_px) {
    verdict.add("camera_misfit", fmt::format("the corners miss the model by {:.2f} px", fit.rms_px));
  }
  if (share > config.good_focal_error) {
    verdict.add("focal_length_uncertain", fmt::format("the focal length is known to {:.1f} % only", 100.0 * share));
  }
  if (fit.coverage < config.good_coverage) {
    verdict.add("board_coverage",
                fmt::format("the board covered {:.0f} % of the image only: outside, the distortion is extrapolated",
                            100.0 * fit.coverage));
  }
  if (fit.errors_scaled) {
    verdict.add("views_disagree",
                fmt::format("views disagree by {:.1f} times what the scatter of corners explains; the standard errors "
                            "are larger by that",
                            std::sqrt(fit.dispersion)));
  }
  return verdict;
}

}  // namespace

CameraVector camera_parameters(const CameraCalibration& camera) {
  CameraVector out = CameraVector::Zero();
  out.head<4>() << camera.fx, camera.fy, camera.cx, camera.cy;
  for (std::size_t k = 0; k < std::min<std::size_t>(5, camera.distortion.size()); ++k) {
    out[static_cast<Eigen::Index>(4 + k)] = camera.distortion[k];
  }
  return out;
}

CameraFit calibrate_camera(std::span<const BoardView> all_views, int width, int height, const CameraFitConfig& config) {
  check_views(all_views, width, height, config);
  CameraFit out;
  Views views;
  for (const BoardView& view : all_views) views.push_back(&view);
  out.coverage = image_coverage(views, width, height);
  refuse_narrow_coverage(out.coverage, config);

  CameraBundle start = start_bundle(views, width, height);
  Fit fit = choose_model(views, start, config, out.k3_over_error);
  std::vector<CameraFitView> left_out;
  // At most a quarter: where more disagree, the model is wrong, not the views.
  const std::size_t most_left_out = all_views.size() / 4;
  while (left_out.size() < most_left_out && views.size() > static_cast<std::size_t>(config.least_views)) {
    const std::vector<double> rms = rms_by_view_px(views, fit.bundle);
    const auto worst = std::max_element(rms.begin(), rms.end());
    if (!(*worst > config.outlier_rms * median(rms))) break;
    const std::ptrdiff_t at = worst - rms.begin();
    const BoardView& view = *views[static_cast<std::size_t>(at)];
    left_out.push_back(
        describe_view(view, fit.bundle.parameters, fit.bundle.T_camera_board[static_cast<std::size_t>(at)], false));
    out.problems.push_back(
        {"view_left_out", fmt::format("{}: its corners miss by {:.2f} px RMS, the median is {:.2f} px",
                                      printable(view.name), *worst, median(rms))});
    views.erase(views.begin() + at);
    start = fit.bundle;
    start.T_camera_board.erase(start.T_camera_board.begin() + at);
    fit = choose_model(views, start, config, out.k3_over_error);
  }

  const CameraBundle& bundle = fit.bundle;
  const CameraVector& c = bundle.parameters;
  out.camera = {width, height, c[0], c[1], c[2], c[3], {c[4], c[5], c[6], c[7], c[8]}, std::nullopt};
  out.k3_free = bundle.free[kK3];
  out.corner_sigma_px = fit.sigma_px;
  out.rms_px = std::sqrt(bundle.sum_of_squares_px2 / static_cast<double>(count_corners(views)));
  out.coverage = image_coverage(views, width, height);
  out.iterations = bundle.iterations;
  out.converged = bundle.converged;
  measure_dispersion(fit, out);
  out.covariance = fit.covariance * (out.errors_scaled ? out.dispersion : 1.0);
  out.camera.covariance = out.covariance;
  out.standard_error = out.covariance.diagonal().cwiseSqrt();
  for (std::size_t v = 0; v < views.size(); ++v)
    out.views.push_back(describe_view(*views[v], c, bundle.T_camera_board[v], true));
  for (const CameraFitView& view : out.views) out.steepest_tilt_rad = std::max(out.steepest_tilt_rad, view.tilt_rad);
  out.views.insert(out.views.end(), left_out.begin(), left_out.end());
  refuse_narrow_coverage(out.coverage, config);
  refuse_undetermined(out, config);
  out.verdict = judge_camera(out, config);
  return out;
}

}  // namespace asperity
