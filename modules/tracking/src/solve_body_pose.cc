#include "asperity/tracking/solve_body_pose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/Cholesky>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/geometry/pose.h"
#include "asperity/recording/camera_model.h"
#include "asperity/tracking/seen_tag.h"
#include "asperity/vision/vision.h"
#include "body_least_squares.h"

namespace asperity {
namespace {

// The poses T_camera_marker, at most two, that one tag's four corners allow (Collins and Bartoli, 2014, by OpenCV).
// None where the corners are not those of a square.
std::vector<Pose> square_poses(const CameraCalibration& camera, const MarkerPlacement& marker,
                               const Eigen::Matrix<double, 2, 4>& corners_px) {
  // OpenCV's order for this method begins at (−, +) with y up, so it is that of our corners; its frame is turned about
  // x.
  std::array<Eigen::Vector2d, 4> rays;
  for (int i = 0; i < 4; ++i) {
    const auto ray = unproject(camera, corners_px.col(i));
    if (!ray) return {};
    rays[static_cast<std::size_t>(i)] = {ray->x(), ray->y()};
  }
  std::vector<PlanePose> poses;
  try {
    poses = vision().square_poses(0.5 * marker.size_m, rays);
  } catch (const VisionError&) {
    return {};
  }
  const Pose T_up_tag{Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0), Eigen::Vector3d::Zero()};
  const Pose T_tag_marker = marker.T_marker_tag.inverse();
  std::vector<Pose> out;
  for (const auto& [turn, shift] : poses) {
    if (!turn.allFinite() || !shift.allFinite() || !(shift.z() > 0.0)) continue;
    out.push_back(Pose{exp_rotation(turn), shift} * T_up_tag * T_tag_marker);
  }
  return out;
}

constexpr std::size_t kMostTagsToBeginAt = 6;
constexpr std::size_t kMostPolished = 4;

double side_px(const SeenTag& tag) { return (tag.corners_px.col(0) - tag.corners_px.col(2)).norm() / std::sqrt(2.0); }

struct Start {
  Pose pose;
  double cost = 0.0;
};

// Poses to begin at, the most plausible first.
std::vector<Start> find_starts(const CameraCalibration& camera, const std::vector<MarkerPlacement>& body,
                               std::span<const SeenTag> seen, const BodyLeastSquares& problem,
                               const std::optional<Pose>& predicted) {
  std::vector<const SeenTag*> largest;
  double size_px = 0.0;
  for (const SeenTag& tag : seen) {
    largest.push_back(&tag);
    size_px = std::max(size_px, side_px(tag));
  }
  std::stable_sort(largest.begin(), largest.end(),
                   [](const SeenTag* a, const SeenTag* b) { return side_px(*a) > side_px(*b); });
  if (largest.size() > kMostTagsToBeginAt) largest.resize(kMostTagsToBeginAt);
  // How far the other tags may be off where one tag alone has said how the body lies.
  const double loose_px = std::max(1.0, 0.05 * size_px);
  std::vector<Start> starts;
  const auto add = [&](const Pose& pose) {
    if (const auto cost = problem.loose_cost(pose, loose_px)) starts.push_back({pose, *cost});
  };
  for (const SeenTag* tag : largest) {
    for (const Pose& pose : square_poses(camera, body[tag->tag], tag->corners_px)) add(pose);
  }
  if (predicted) add(*predicted);
  std::stable_sort(starts.begin(), starts.end(), [](const Start& a, const Start& b) { return a.cost < b.cost; });
  return starts;
}

// Minima that differ by less are one.
bool is_same(const LeastSquaresPose& a, const LeastSquaresPose& b) {
  constexpr double kSame_rad = 0.01;
  return rotation_between_rad(a.pose, b.pose) < kSame_rad;
}

std::vector<LeastSquaresPose> find_minima(const std::vector<Start>& starts, const BodyLeastSquares& problem) {
  std::vector<LeastSquaresPose> minima;
  std::size_t polished = 0;
  std::vector<Pose> tried;
  for (const Start& start : starts) {
    if (polished == kMostPolished) break;
    constexpr double kNear_rad = 0.1;
    const bool near = std::any_of(tried.begin(), tried.end(),
                                  [&](const Pose& pose) { return rotation_between_rad(pose, start.pose) < kNear_rad; });
    if (near) continue;
    tried.push_back(start.pose);
    ++polished;
    const auto found = problem.minimise(start.pose);
    if (!found) continue;
    const auto twin = std::find_if(minima.begin(), minima.end(),
                                   [&](const LeastSquaresPose& other) { return is_same(other, *found); });
    if (twin == minima.end()) {
      minima.push_back(*found);
    } else if (found->robust_cost < twin->robust_cost) {
      *twin = *found;
    }
  }
  std::stable_sort(minima.begin(), minima.end(),
                   [](const LeastSquaresPose& a, const LeastSquaresPose& b) { return a.robust_cost < b.robust_cost; });
  return minima;
}

// Turning farther on the way to the same minimum is another one.
constexpr double kFarthestTurn_rad = 0.1;

// What the chance that the other of a plane's two ways is the true one adds to the covariance: p d dᵀ, d the way there.
// The odds are those of the residuals, of Student's t with an unknown scale; one that a prediction has chosen is
// twenty times likelier.
Eigen::Matrix<double, 6, 6> the_other_way(const LeastSquaresPose& taken, const LeastSquaresPose& other,
                                          bool predicted) {
  constexpr double kPredictionOdds = 1.0 / 20.0;
  constexpr double kPriorDof = 4.0;
  const double dof = std::max(0.0, 2.0 * taken.corners_used - 6.0) + kPriorDof;
  const double ratio = taken.reprojection_px / std::max(1e-9, other.reprojection_px);
  const double odds = std::min(1.0, std::pow(ratio, dof)) * (predicted ? kPredictionOdds : 1.0);
  Eigen::Matrix<double, 6, 1> way;
  way << other.pose.translation_m - taken.pose.translation_m,
      log_rotation(other.pose.rotation * taken.pose.rotation.conjugate());
  return odds / (1.0 + odds) * way * way.transpose();
}

}  // namespace

std::optional<BodyPose> solve_body_pose(const CameraCalibration& camera, const std::vector<MarkerPlacement>& body,
                                        std::span<const SeenTag> seen, const std::optional<Pose>& predicted,
                                        const BodyPoseConfig& config) {
  for (const SeenTag& tag : seen) {
    if (tag.tag >= body.size()) throw Error("solve_body_pose: the body has no tag " + std::to_string(tag.tag));
  }
  if (seen.empty()) return std::nullopt;
  const BodyLeastSquares problem(camera, body, seen, config);
  std::vector<LeastSquaresPose> minima = find_minima(find_starts(camera, body, seen, problem, predicted), problem);
  if (minima.empty()) return std::nullopt;

  bool ambiguous = false;
  if (minima.size() > 1) {
    ambiguous = minima[1].reprojection_px < config.ambiguous_ratio * minima[0].reprojection_px &&
                minima[1].corners_used >= minima[0].corners_used;
    if (ambiguous && predicted &&
        rotation_between_rad(minima[1].pose, *predicted) < rotation_between_rad(minima[0].pose, *predicted)) {
      std::swap(minima[0], minima[1]);
    }
  }
  // What the corners turn out to be off by weighs them anew.
  LeastSquaresPose& best = minima[0];
  std::vector<std::size_t> tag_of;
  for (const SeenTag& tag : seen) tag_of.push_back(tag.tag);
  double corner_px = 0.0;
  auto at = problem.at_minimum(best, corner_px);
  if (!at) return std::nullopt;
  PoseError error = find_pose_error(camera, body, best.pose, at->corners, tag_of, at->normal, config);
  if (const auto again = problem.minimise(best.pose, error.corner_px);
      again && rotation_between_rad(again->pose, best.pose) < kFarthestTurn_rad) {
    if (auto there = problem.at_minimum(*again, error.corner_px)) {
      corner_px = error.corner_px;
      best = *again;
      at = std::move(there);
      error = find_pose_error(camera, body, best.pose, at->corners, tag_of, at->normal, config);
    }
  }
  BodyPose out;
  out.T_camera_marker = best.pose;
  out.noise = error.noise;
  if (ambiguous) out.noise += the_other_way(minima[0], minima[1], predicted.has_value());
  out.covariance = out.noise + error.shared;
  if (!out.covariance.allFinite()) return std::nullopt;
  out.corner_px = error.corner_px;
  out.smooth_px = error.smooth_px;
  out.reprojection_px = best.reprojection_px;
  out.converged = best.converged;
  out.corners_used = best.corners_used;
  for (const int corners : best.corners_of_tag) {
    out.used.push_back(corners >= 2);
    out.tags_used += corners >= 2 ? 1 : 0;
  }
  out.ambiguous = ambiguous;
  if (minima.size() > 1) {
    out.runner_up = minima[1].pose;
    out.runner_up_px = minima[1].reprojection_px;
  }
  return out;
}

}  // namespace asperity
