#include "paths.h"

#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace bench {

namespace {

using asperity::Random;
using Eigen::Vector3d;

Vector3d facet_normal(const asperity::TriangleMesh& mesh, std::uint32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const Vector3d& p = mesh.vertices_m[a];
  return (mesh.vertices_m[b] - p).cross(mesh.vertices_m[c] - p).normalized();
}

Vector3d direction(Random& random) { return Vector3d(random.normal(), random.normal(), random.normal()).normalized(); }

asperity::ClosestPoint random_point(const asperity::MeshSurface& surface, Random& random) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& vertex_m : surface.mesh.vertices_m) box.extend(vertex_m);
  while (true) {
    const Vector3d outside_m = box.center() + box.diagonal().norm() * direction(random);
    const Vector3d aim_m =
        box.center() + 0.4 * box.sizes().cwiseProduct(
                                 Vector3d(random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5));
    const asperity::RayHit hit = surface.bvh.cast_ray(outside_m, aim_m - outside_m, 2.0);
    if (hit.found()) return surface.bvh.closest_point(outside_m + hit.t * (aim_m - outside_m));
  }
}

// An Ornstein–Uhlenbeck process along the path.
std::vector<double> wander(std::size_t count, double sigma, double length_m, Random& random) {
  const double keep = std::exp(-kPathSpacing_m / length_m);
  std::vector<double> out(count);
  double value = sigma * random.normal();
  for (double& at : out) {
    at = value;
    value = keep * value + sigma * std::sqrt(1.0 - keep * keep) * random.normal();
  }
  return out;
}

}  // namespace

LineOnMesh walk_over(const asperity::MeshSurface& surface, LineKind kind, double length_m, Random& random) {
  const auto count = static_cast<std::size_t>(length_m / kPathSpacing_m);
  const double bend =
      kind == LineKind::kStraight ? 0.0 : (random.chance(0.5) ? 1.0 : -1.0) / random.uniform(12e-3, 45e-3);
  const double wave_m = random.uniform(30e-3, 80e-3), phase = random.uniform(0.0, 2.0 * std::numbers::pi);
  const std::vector<double> unsteady = wander(count, 3.0, 15e-3, random);
  LineOnMesh out;
  asperity::ClosestPoint at = random_point(surface, random);
  Vector3d n = facet_normal(surface.mesh, at.triangle);
  Vector3d along = n.cross(direction(random)).normalized();
  for (std::size_t i = 0; i < count; ++i) {
    out.p_m.push_back(at.p_m);
    out.normal.push_back(n);
    const double s_m = static_cast<double>(i) * kPathSpacing_m;
    const double curvature =
        unsteady[i] + bend * (kind == LineKind::kWavy ? std::sin(2.0 * std::numbers::pi * s_m / wave_m + phase) : 1.0);
    along = Eigen::AngleAxisd(curvature * kPathSpacing_m, n) * along;
    // A little below the surface, so that beyond a sharp edge the next facet is the nearest.
    at = surface.bvh.closest_point(at.p_m + kPathSpacing_m * along - 0.3 * kPathSpacing_m * n);
    const Vector3d next = facet_normal(surface.mesh, at.triangle);
    along = asperity::shortest_rotation(n, next) * along;
    along = (along - along.dot(next) * next).normalized();
    n = next;
  }
  return out;
}

PathErrors draw_errors(Random& random) {
  const auto spread = [&](double low, double high) { return low * std::pow(high / low, random.uniform()); };
  PathErrors out;
  out.slow_m = spread(0.05e-3, 0.25e-3);
  out.slow_length_m = spread(10e-3, 35e-3);
  out.stated_ratio = spread(0.7, 1.4);
  out.white_m = spread(8e-6, 30e-6);
  out.relief_m = spread(8e-6, 80e-6);
  out.relief_length_m = spread(0.2e-3, 1.2e-3);
  out.relief_mean_m = -out.relief_m * random.uniform();
  out.tip_m = out.tip_sigma_m * Vector3d(random.normal(), random.normal(), random.normal());
  return out;
}

asperity::MeasuredPath measure_line(const LineOnMesh& line, const PathErrors& errors,
                                    const asperity::Pose& T_world_mesh, Random& random) {
  const std::size_t n = line.p_m.size();
  const std::vector<double> relief_m = wander(n, errors.relief_m, errors.relief_length_m, random);
  std::array<std::vector<double>, 3> slow_m;
  for (auto& axis : slow_m) axis = wander(n, errors.slow_m, errors.slow_length_m, random);
  const Vector3d lean = 0.25 * Vector3d(random.normal(), random.normal(), random.normal());
  asperity::MeasuredPath out;
  const double stated_m2 = std::pow(errors.stated_ratio * errors.slow_m, 2);
  out.slow_covariance_world_m2 = stated_m2 * Eigen::Matrix3d::Identity();
  out.sigma_m = std::sqrt(stated_m2);
  out.tip_sigma_m.setConstant(errors.tip_sigma_m);
  Eigen::Quaterniond marker =
      Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), T_world_mesh.rotation * line.normal[0]);
  Vector3d outward = (line.normal[0] + lean).normalized();
  for (std::size_t i = 0; i < n; ++i) {
    // The hand follows the normal over some millimetres.
    outward = (outward + 0.06 * ((line.normal[i] + lean).normalized() - outward)).normalized();
    const Vector3d outward_world = T_world_mesh.rotation * outward;
    marker = asperity::shortest_rotation(marker * Vector3d::UnitZ(), outward_world) * marker;
    const Vector3d error_m(slow_m[0][i] + errors.white_m * random.normal(),
                           slow_m[1][i] + errors.white_m * random.normal(),
                           slow_m[2][i] + errors.white_m * random.normal());
    out.p_world_m.push_back(T_world_mesh *
                                Vector3d(line.p_m[i] + (relief_m[i] + errors.relief_mean_m) * line.normal[i]) +
                            error_m + marker * errors.tip_m);
    out.outward_world.push_back(outward_world);
    out.q_world_marker.push_back(marker);
  }
  return out;
}

}  // namespace bench
