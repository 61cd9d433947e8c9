#include "asperity/tracking/solve_body_pose.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "body_least_squares.h"
#include "square_poses.h"

namespace asperity {
namespace {

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
  const LeastSquaresPose& best = minima[0];
  BodyPose out;
  out.T_camera_marker = best.pose;
  out.covariance = best.covariance;
  out.reprojection_px = best.reprojection_px;
  out.scale = best.scale;
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
