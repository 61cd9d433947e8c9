#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/mesh_bvh.h"
#include "asperity/registration/registration_config.h"
#include "asperity/registration/registration_surface.h"
#include "point_set.h"

namespace asperity::registration {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

// What decides whether a pair of a point and its closest point counts.
struct MatchRules {
  RegistrationNormals normals = RegistrationNormals::kInterpolated;
  double facing_cos = -1.0;     // least cosine of the probe's direction and the facet's normal
  double max_distance_m = 0.0;  // 0: no limit
};

// One pair: y = q + distance n to first order.
struct Match {
  Eigen::Vector3d y_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d n = Eigen::Vector3d::Zero();  // unit: the distance's gradient
  double distance_m = 0.0;                      // signed, positive on the outer side
  bool usable = false;
};

// Some of a set's points with their closest points, kept from one pose to the next for the warm start.
class Matcher {
 public:
  Matcher(const RegistrationSurface& surface, const PointSet& points, std::span<const std::uint32_t> chosen,
          const MatchRules& rules);

  // Finds the closest points at `pose`, of the points drawn together by `shrink` towards their mean.
  void match(const CentredPose& pose, double shrink = 1.0);

  // Moves the pairs by a small motion about `centre_m` to first order: no closest point is looked up.
  void advance(const Eigen::Matrix<double, 6, 1>& motion, const Eigen::Vector3d& centre_m);

  std::size_t size() const { return matches_.size(); }
  std::uint32_t chosen(std::size_t i) const { return chosen_[i]; }  // index in the set of the i-th
  const std::vector<Match>& matches() const { return matches_; }
  const std::vector<ClosestPoint>& closest() const { return closest_; }

  // The scale of the distances as a standard deviation, from the 75th percentile of the usable ones; 0 without any.
  double scale_m() const;

 private:
  void pair(std::size_t i, const Eigen::Vector3d& outward_mesh);

  const RegistrationSurface* surface_;
  MatchRules rules_;
  double rounding_m_ = 0.0;
  std::vector<std::uint32_t> chosen_;
  std::vector<Eigen::Vector3d> x_m_;
  std::vector<Eigen::Vector3d> outward_;
  std::vector<ClosestPoint> closest_;
  std::vector<Match> matches_;
  mutable std::vector<double> scratch_;
};

}  // namespace asperity::registration
