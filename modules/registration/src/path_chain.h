#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/mesh_surface.h"
#include "asperity/geometry/pose.h"
#include "asperity/registration/registration_result.h"

namespace asperity::registration {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

// The position of a point's slow error between two knots.
struct KnotShare {
  std::size_t knot = 0;  // and the next
  double share = 0.0;    // of the next
};

// All points of all paths one after the other.
struct PathChain {
  std::vector<Eigen::Vector3d> p_world_m;
  std::vector<Eigen::Matrix3d> R_world_marker;  // zero where the path has no tip error
  std::vector<char> begins;                     // 1: the chain of neighbours is broken before this point
  std::vector<KnotShare> knots;
  std::vector<std::size_t> part_of;
  double spacing_m = 0.0;  // median

  // One part a path: its placement, its tip, its knots and the covariance of its slow error.
  struct Part {
    std::size_t first_point = 0, points = 0;
    std::size_t first_knot = 0, knots = 0;
    std::size_t placement = 0;
    std::size_t tip = 0;  // index into tip_sigma_m, where has_tip
    bool has_tip = false;
    bool is_slow = false;  // it has a slow error
    Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();
  };
  std::vector<Part> parts;
  std::size_t knot_count = 0;
  std::size_t placement_count = 1;
  std::vector<Eigen::Vector3d> tip_sigma_m;  // of each tip, marker axes
};

// `placement_of` is empty or has one index a path.
PathChain make_chain(std::span<const MeasuredPath> paths, double knot_m,
                     std::span<const std::size_t> placement_of = {});

// All unknowns: the pose of each placement, the shift of each tip (marker axes, three numbers), the share of the
// facets' bulge (facet_bulge_m) that the object has, the mean relief of each path and the slow error at each knot
// (world axes, three numbers).
struct State {
  std::vector<Pose> T_mesh_world;
  Eigen::VectorXd tip_m;
  double bulge = 0.0;
  Eigen::VectorXd level_m;
  Eigen::VectorXd knots_m;
  std::vector<double> bulge_m;  // under each point, as it was where a descent began; empty: as it is at the pose
};

// No tip shift, no slow error, no relief; half the bulge.
State zero_state(const PathChain& chain, std::vector<Pose> T_mesh_world);

// The slow error at a point.
Eigen::Vector3d slow_error_m(const PathChain& chain, const State& state, std::size_t point);
// What the tip's shift moves a point by, world axes.
Eigen::Vector3d tip_motion_m(const PathChain& chain, const State& state, std::size_t point);

// What is known of the bulge before: some share of it. An object made from the mesh has its facets, most have not.
inline constexpr double kBulge = 0.5, kBulgeSigma = 0.5;

// Heights over the surface under the paths, between the facets and their bulge, and its normals (mesh frame).
// `here_m` is the bulge under the points, `bulge_m` the one that the heights were made with.
struct FacetHeights {
  std::vector<double> d_m, bulge_m, here_m;
  std::vector<Eigen::Vector3d> p_mesh_m, normal;
  std::vector<char> usable;
  double rms_m = 0.0;
  double edge_m = 0.0;             // mean edge of the facets under the points
  std::size_t count = 0;           // of usable ones
  std::vector<double> part_rms_m;  // of each path
  std::vector<std::size_t> part_count;
};

// The heights over the round surface (facet and bulge) plus (1 − state.bulge) of state.bulge_m. With that fixed they
// have no kinks as functions of the pose, and their gradient is the interpolated normal. Where state.bulge_m is empty
// the facets' kinks count: they would tell where along the mesh a path is to a fraction of an edge, but an edge further
// the path fits them again, and only an object that has the mesh's facets has them.
// Each path's mean relief is taken off its heights. Heights beyond `outlier_sigmas` of their path do not count.
FacetHeights measure_heights(const PathChain& chain, const State& state, const MeshSurface& surface,
                             double outlier_sigmas);

}  // namespace asperity::registration
