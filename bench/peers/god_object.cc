#include "god_object.h"

#include <cmath>

#include <Eigen/Dense>

namespace bench {

using Eigen::Vector3d;

namespace {

constexpr double kParallel = 1e-3;  // of the planes' normals, absolute

}  // namespace

GodObject::GodObject(const asperity::TriangleMesh& mesh, const asperity::MeshBvh& bvh, double epsilon_m)
    : mesh_(mesh), bvh_(bvh), epsilon_m_(epsilon_m) {}

bool GodObject::advance(const Vector3d& goal_m, Vector3d& n, double& b_m) {
  const Vector3d way = goal_m - proxy_m_;
  const double length_m = way.norm();
  if (length_m < 1e-12) return false;
  const Vector3d direction = way / length_m;
  const asperity::RayHit hit = bvh_.cast_ray(proxy_m_, direction, length_m + 2.0 * epsilon_m_);
  if (!hit.found()) {
    proxy_m_ = goal_m;
    return false;
  }
  const auto& [i, j, k] = mesh_.triangles[hit.triangle];
  const Vector3d& a = mesh_.vertices_m[i];
  n = (mesh_.vertices_m[j] - a).cross(mesh_.vertices_m[k] - a).normalized();
  if (n.dot(direction) > 0.0) n = -n;
  b_m = n.dot(a) + epsilon_m_;
  // Back along the segment to where it is an epsilon from the plane.
  const double steepness = -n.dot(direction);
  const double back_m = steepness > 0.0 ? epsilon_m_ / steepness : hit.t;
  proxy_m_ += std::max(0.0, hit.t - back_m) * direction;
  return true;
}

const Vector3d& GodObject::step(const Vector3d& device_m) {
  if (!started_) proxy_m_ = device_m;
  started_ = true;
  Vector3d n1, n2, n3;
  double b1_m = 0.0, b2_m = 0.0, b3_m = 0.0;
  if (!advance(device_m, n1, b1_m)) return proxy_m_;
  const Vector3d on_plane_m = device_m + (b1_m - n1.dot(device_m)) * n1;
  if (!advance(on_plane_m, n2, b2_m)) return proxy_m_;
  const Vector3d along = n1.cross(n2);
  if (along.norm() < kParallel) return proxy_m_;
  Eigen::Matrix3d planes;
  planes << n1.transpose(), n2.transpose(), along.transpose();
  const Vector3d on_line_m = planes.partialPivLu().solve(Vector3d(b1_m, b2_m, along.dot(device_m)));
  advance(on_line_m, n3, b3_m);
  return proxy_m_;
}

}  // namespace bench
