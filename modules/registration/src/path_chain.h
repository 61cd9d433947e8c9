#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/mesh_surface.h"
#include "asperity/geometry/pose.h"
#include "asperity/registration/registration_result.h"

namespace asperity::registration {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

// Where a point's slow error stands between two knots.
struct KnotShare {
  std::size_t knot = 0;  // and the next
  double share = 0.0;    // of the next
};

// All points of all paths one after the other.
struct PathChain {
  std::vector<Eigen::Vector3d> p_world_m;
  std::vector<char> begins;  // 1: the chain of neighbours is broken before this point
  std::vector<KnotShare> knots;
  std::vector<std::size_t> part_of;
  double spacing_m = 0.0;  // median

  // One part a path: its knots and the covariance of its slow error.
  struct Part {
    std::size_t first_point = 0, points = 0;
    std::size_t first_knot = 0, knots = 0;
    Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();
  };
  std::vector<Part> parts;
  std::size_t knot_count = 0;
};

PathChain make_chain(std::span<const MeasuredPath> paths, double knot_m);

// The slow error at a point. `knots_m` has three numbers a knot.
Eigen::Vector3d slow_error_m(const PathChain& chain, const Eigen::VectorXd& knots_m, std::size_t point);

// Heights over the facets under the paths, and the facets' normals (mesh frame).
struct FacetHeights {
  std::vector<double> d_m;
  std::vector<Eigen::Vector3d> p_mesh_m, normal;
  std::vector<char> usable;
  double rms_m = 0.0;
  std::size_t count = 0;  // of usable ones
};

// Each path's mean relief `level_m` is taken off its heights.
FacetHeights measure_heights(const PathChain& chain, const Eigen::VectorXd& knots_m, const Eigen::VectorXd& level_m,
                             const MeshSurface& surface, const Pose& T_mesh_world, double outlier_sigmas);

}  // namespace asperity::registration
