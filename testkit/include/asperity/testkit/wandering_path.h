#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/mesh_bvh.h"

namespace asperity::testkit {

// `count` unit vectors along a path over the unit sphere in equal steps of `step_rad`: a great circle whose heading
// turns at random, by about `turn_rad` in each radian travelled (white noise smoothed over a tenth of a radian).
std::vector<Eigen::Vector3d> wandering_directions(std::size_t count, double step_rad, std::uint64_t seed,
                                                  double turn_rad = 1.0);

// How deep a device is pressed into a star-shaped mesh about the origin.
struct PressedPath {
  std::vector<Eigen::Vector3d> p_m;  // of the device, a tick each
  std::size_t first_pressed = 0;     // index of the first point at full depth
};

// The centre of a ball of `tip_radius_m` (0: a point) along those directions, radially `depth_m` below the place where
// the ball, coming from outside along the ray, first touches the mesh; no point of the mesh may be twice as far from
// the origin as the nearest. Before that it comes down along the first direction, from `depth_m` above the surface, in
// `approach` steps.
PressedPath press_into(const MeshBvh& bvh, const std::vector<Eigen::Vector3d>& directions, double tip_radius_m,
                       double depth_m, std::size_t approach = 100);

// The distance from the origin at which a ball that comes along the ray of `direction` (unit) first touches the mesh.
double touching_radius_m(const MeshBvh& bvh, const Eigen::Vector3d& direction, double tip_radius_m, double outside_m);

}  // namespace asperity::testkit
