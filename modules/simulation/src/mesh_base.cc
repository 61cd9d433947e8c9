#include "asperity/simulation/mesh_base.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/geometry/pose.h"
#include "asperity/simulation/base_shape.h"
#include "asperity/simulation/mesh_stroke.h"

namespace asperity {

namespace {

// A Gaussian's mean over the points around each, mirrored through the ends: a straight line stays as it is.
std::vector<Eigen::Vector3d> smoothed(const std::vector<Eigen::Vector3d>& points, double sigma) {
  const auto n = static_cast<std::ptrdiff_t>(points.size());
  const auto reach = std::min<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(std::ceil(4.0 * sigma)), n - 1);
  std::vector<double> weight;
  double sum = 0.0;
  for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
    weight.push_back(std::exp(-0.5 * std::pow(static_cast<double>(k) / sigma, 2)));
    sum += weight.back();
  }
  std::vector<Eigen::Vector3d> out(points.size(), Eigen::Vector3d::Zero());
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    Eigen::Vector3d& mean = out[static_cast<std::size_t>(i)];
    for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
      const std::ptrdiff_t j = i + k;
      const double w = weight[static_cast<std::size_t>(k + reach)] / sum;
      if (j < 0) {
        mean += w * (2.0 * points.front() - points[static_cast<std::size_t>(-j)]);
      } else if (j >= n) {
        mean += w * (2.0 * points.back() - points[static_cast<std::size_t>(2 * (n - 1) - j)]);
      } else {
        mean += w * points[static_cast<std::size_t>(j)];
      }
    }
  }
  return out;
}

std::vector<Eigen::Vector3d> normals_along(const MeshSurface& surface, const std::vector<Eigen::Vector3d>& points) {
  std::vector<Eigen::Vector3d> out;
  out.reserve(points.size());
  ClosestPoint at;
  for (const Eigen::Vector3d& p_m : points) {
    at = at.found() ? surface.bvh.closest_point(p_m, at) : surface.bvh.closest_point(p_m);
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3; ++k) normal += at.barycentric[k] * surface.normals[at.triangle][static_cast<std::size_t>(k)];
    const double length = normal.norm();
    if (length > 0.0) {
      out.push_back(normal / length);
    } else if (!out.empty()) {
      out.push_back(out.back());
    } else {
      throw Error("simulation.shape: the mesh has no normal where the path begins");
    }
  }
  return out;
}

}  // namespace

MeshBase::MeshBase(std::shared_ptr<const MeshSurface> surface, const SimulatedShapeConfig& config, double length_m,
                   double follow_normal)
    : surface_(std::move(surface)) {
  const MeshStroke stroke =
      trace_mesh_stroke(*surface_, parse_points_m(config.through, "simulation.shape.through"), length_m);
  length_m_ = stroke.length_m;
  const double first_m = -0.5 * length_m_ - stroke.margin_m;
  const std::vector<Eigen::Vector3d> normals = normals_along(*surface_, stroke.p_mesh_m);
  line_ = {smoothed(stroke.p_mesh_m, kSmoothing_m / stroke.spacing_m), first_m, stroke.spacing_m};
  normals_ = {smoothed(normals, kSmoothing_m / stroke.spacing_m), first_m, stroke.spacing_m};

  SimulatedShapeConfig plane = config;
  plane.kind = BaseShapeKind::kPlane;
  const SimulatedShape stand(plane);
  const Frame middle = frame(0.0);
  Eigen::Quaterniond held = Eigen::Quaterniond::Identity();
  if (config.mesh_pose == MeshPose::kGiven) {
    T_world_mesh_ = {exp_rotation(Eigen::Vector3d(config.mesh_rotation_rad.data())),
                     Eigen::Vector3d(config.mesh_position_m.data())};
    held = shortest_rotation(stand.normal(0.0), T_world_mesh_.rotation * middle.normal);
  } else {
    Eigen::Matrix3d from, to;
    from << middle.along, middle.across, middle.normal;
    to << stand.along(0.0), stand.across(0.0), stand.normal(0.0);
    T_world_mesh_.rotation = Eigen::Quaterniond(to * from.transpose()).normalized();
    const Eigen::Vector3d p_mesh_m = line_.value(0.0) + ground(0.0, 0.0).height_m * middle.normal;
    T_world_mesh_.translation_m = Eigen::Vector3d(config.centre_m.data()) - T_world_mesh_.rotation * p_mesh_m;
  }

  // The smallest turns from normal to normal, one after another from the middle: no turn about the normal, and no
  // jump where the whole turn passes a half circle.
  const std::vector<Eigen::Vector3d> followed = smoothed(normals, kHandSmoothing_m / stroke.spacing_m);
  const auto n = static_cast<std::ptrdiff_t>(followed.size());
  const std::ptrdiff_t middle_node = std::clamp<std::ptrdiff_t>(std::llround(-first_m / stroke.spacing_m), 0, n - 1);
  std::vector<Eigen::Vector4d> turns(followed.size());
  const auto at = [&](std::ptrdiff_t i) {
    return Eigen::Vector3d(T_world_mesh_.rotation * followed[static_cast<std::size_t>(i)]);
  };
  for (const std::ptrdiff_t step : {std::ptrdiff_t{1}, std::ptrdiff_t{-1}}) {
    Eigen::Quaterniond turn = held;
    turns[static_cast<std::size_t>(middle_node)] = turn.coeffs();
    for (std::ptrdiff_t i = middle_node + step; i >= 0 && i < n; i += step) {
      const Eigen::Vector3d small = log_rotation(shortest_rotation(at(i - step), at(i)));
      turn = (exp_rotation(follow_normal * small) * turn).normalized();
      const Eigen::Vector4d& before = turns[static_cast<std::size_t>(i - step)];
      turns[static_cast<std::size_t>(i)] =
          before.dot(turn.coeffs()) < 0.0 ? Eigen::Vector4d(-turn.coeffs()) : turn.coeffs();
    }
  }
  turns_ = {std::move(turns), first_m, stroke.spacing_m};
}

MeshBase::Frame MeshBase::frame(double a_m) const {
  Frame out;
  const Eigen::Vector3d along = line_.derivative(a_m);
  out.normal = normals_.value(a_m).normalized();
  out.along = (along - along.dot(out.normal) * out.normal).normalized();
  out.across = out.normal.cross(out.along);
  return out;
}

Eigen::Vector3d MeshBase::point_m(double a_m, double v_m, double height_m) const {
  const Frame f = frame(a_m);
  return T_world_mesh_ * Eigen::Vector3d(line_.value(a_m) + v_m * f.across + height_m * f.normal);
}

Eigen::Vector3d MeshBase::normal(double a_m) const { return T_world_mesh_.rotation * frame(a_m).normal; }
Eigen::Vector3d MeshBase::along(double a_m) const { return T_world_mesh_.rotation * frame(a_m).along; }
Eigen::Vector3d MeshBase::across(double a_m) const { return T_world_mesh_.rotation * frame(a_m).across; }

Eigen::Quaterniond MeshBase::turn(double a_m) const { return Eigen::Quaterniond(turns_.value(a_m)).normalized(); }

Ground MeshBase::ground(double a_m, double v_m) const {
  const Frame f = frame(a_m);
  const Eigen::Vector3d p_m = line_.value(a_m) + v_m * f.across;
  Ground out;
  out.found = false;
  for (const double sign : {1.0, -1.0}) {
    const RayHit hit = surface_->bvh.cast_ray(p_m, sign * f.normal, out.found ? std::abs(out.height_m) : kReach_m);
    if (!hit.found()) continue;
    const Triangle& t = surface_->mesh.triangles[hit.triangle];
    const Eigen::Vector3d& corner = surface_->mesh.vertices_m[t[0]];
    const Eigen::Vector3d facet =
        (surface_->mesh.vertices_m[t[1]] - corner).cross(surface_->mesh.vertices_m[t[2]] - corner);
    // A back is the far side of a thin part.
    if (!(facet.dot(f.normal) > 0.0)) continue;
    out.found = true;
    out.height_m = sign * hit.t;
  }
  return out;
}

}  // namespace asperity
