#include "asperity/testkit/wandering_path.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "asperity/base/random.h"

namespace asperity::testkit {

using Eigen::Vector3d;

std::vector<Vector3d> wandering_directions(std::size_t count, double step_rad, std::uint64_t seed, double turn_rad) {
  constexpr double kMemory_rad = 0.1;
  Random random(seed);
  Vector3d u = Vector3d(random.normal(), random.normal(), random.normal()).normalized();
  Vector3d heading = u.cross(Vector3d(random.normal(), random.normal(), random.normal())).normalized();
  std::vector<Vector3d> out;
  out.reserve(count);
  const double keep = std::exp(-step_rad / kMemory_rad);
  const double draw = turn_rad / std::sqrt(kMemory_rad) * std::sqrt(1.0 - keep * keep);
  double turn = 0.0;  // rad a radian
  for (std::size_t i = 0; i < count; ++i) {
    out.push_back(u);
    turn = keep * turn + draw * random.normal();
    const Vector3d next = std::cos(step_rad) * u + std::sin(step_rad) * heading;
    heading = std::cos(step_rad) * heading - std::sin(step_rad) * u;
    u = next.normalized();
    heading = (heading + turn * step_rad * u.cross(heading)).normalized();
    heading = (heading - heading.dot(u) * u).normalized();
  }
  return out;
}

double touching_radius_m(const MeshBvh& bvh, const Vector3d& direction, double tip_radius_m, double outside_m) {
  if (tip_radius_m <= 0.0) {
    const RayHit hit = bvh.cast_ray(outside_m * direction, -direction);
    return outside_m - hit.t;
  }
  // The ball may go on by its distance to the mesh without touching it.
  constexpr double kClose = 1e-12;
  double at_m = outside_m;
  ClosestPoint nearest;
  for (int i = 0; i < 1000; ++i) {
    nearest = bvh.closest_point(at_m * direction, nearest);
    const double free_m = nearest.distance_m - tip_radius_m;
    if (free_m <= kClose * outside_m) break;
    at_m -= free_m;
  }
  return at_m;
}

PressedPath press_into(const MeshBvh& bvh, const std::vector<Vector3d>& directions, double tip_radius_m, double depth_m,
                       std::size_t approach) {
  PressedPath path;
  path.p_m.reserve(directions.size() + approach);
  if (directions.empty()) return path;
  const ClosestPoint origin = bvh.closest_point(Vector3d::Zero());
  const double outside_m = 2.0 * (origin.distance_m + tip_radius_m + depth_m);
  const double first_m = touching_radius_m(bvh, directions.front(), tip_radius_m, outside_m);
  for (std::size_t i = 0; i < approach; ++i) {
    const double height_m = depth_m * (1.0 - 2.0 * static_cast<double>(i) / static_cast<double>(approach));
    path.p_m.push_back((first_m + height_m) * directions.front());
  }
  path.first_pressed = approach;
  for (const Vector3d& u : directions) {
    path.p_m.push_back((touching_radius_m(bvh, u, tip_radius_m, outside_m) - depth_m) * u);
  }
  return path;
}

}  // namespace asperity::testkit
