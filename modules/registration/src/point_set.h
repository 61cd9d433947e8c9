#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/pose.h"
#include "asperity/registration/registration_result.h"

namespace asperity::registration {

// The finite points of all paths, about their mean.
struct PointSet {
  Eigen::Vector3d mean_world_m = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> x_m;      // p - mean
  std::vector<Eigen::Vector3d> outward;  // unit, or zero where unknown
  std::vector<double> s_m;               // length along the paths, one after the other
  std::vector<std::uint32_t> path;
  Eigen::Matrix3d scatter_m2 = Eigen::Matrix3d::Zero();  // mean of x x'
  double radius_m = 0.0;                                 // root mean square of |x|
  double sigma_m = 0.0;  // of a point along the normal as given, the paths' mean; 0: not

  std::size_t size() const { return x_m.size(); }
};

// Throws Error for no paths, sizes that differ or fewer than three finite points, naming the path and the first
// point that is not finite; other points that are not finite are left out and listed in `problems`.
PointSet gather_points(std::span<const MeasuredPath> paths, Problems& problems);

// A pose by where it puts the points' mean: y = rotation x + centre.
struct CentredPose {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator*(const Eigen::Vector3d& x_m) const { return rotation * x_m + centre_m; }
};

CentredPose centred(const Pose& T_mesh_world, const PointSet& points);
Pose uncentred(const CentredPose& pose, const PointSet& points);

// The pose moved by (turn about its centre, shift), and the motion from one to the other.
CentredPose moved(const CentredPose& pose, const Eigen::Matrix<double, 6, 1>& motion);
Eigen::Matrix<double, 6, 1> motion_between(const CentredPose& from, const CentredPose& to);

// The mean over the points of P'P, P = (-[y - centre]x, 1): a motion m moves them by sqrt(m' M m) RMS. A path that is
// nearly straight counts as a tenth of its radius thick, lest turning about its own line be no motion at all.
Eigen::Matrix<double, 6, 6> motion_metric(const PointSet& points, const CentredPose& pose);

// Whether that tenth came into it.
bool is_thin(const PointSet& points);

// Root mean square distance of the points at two poses.
double rms_between(const PointSet& points, const CentredPose& a, const CentredPose& b);

}  // namespace asperity::registration
