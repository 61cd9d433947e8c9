#include "path_chain.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace asperity::registration {

namespace {

double median_of(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

PathChain make_chain(std::span<const MeasuredPath> paths, double knot_m) {
  PathChain chain;
  std::vector<double> steps_m;
  for (const MeasuredPath& path : paths) {
    PathChain::Part part;
    part.first_point = chain.p_world_m.size();
    part.points = path.p_world_m.size();
    part.first_knot = chain.knot_count;
    part.covariance_m2 = path.slow_covariance_world_m2;
    double s_m = 0.0;
    for (std::size_t i = 0; i < path.p_world_m.size(); ++i) {
      const double step_m = i == 0 ? 0.0 : (path.p_world_m[i] - path.p_world_m[i - 1]).norm();
      if (i > 0 && std::isfinite(step_m)) steps_m.push_back(step_m);
      s_m += std::isfinite(step_m) ? step_m : 0.0;
      const double at = s_m / knot_m;
      const double knot = std::floor(at);
      chain.p_world_m.push_back(path.p_world_m[i]);
      chain.begins.push_back(i == 0 ? 1 : 0);
      chain.part_of.push_back(chain.parts.size());
      chain.knots.push_back({part.first_knot + static_cast<std::size_t>(knot), at - knot});
    }
    part.knots = static_cast<std::size_t>(std::floor(s_m / knot_m)) + 2;
    chain.knot_count += part.knots;
    chain.parts.push_back(part);
  }
  if (steps_m.empty()) return chain;
  chain.spacing_m = median_of(steps_m);
  for (std::size_t i = 1; i < chain.p_world_m.size(); ++i) {
    const double step_m = (chain.p_world_m[i] - chain.p_world_m[i - 1]).norm();
    if (!(step_m <= 3.0 * chain.spacing_m)) chain.begins[i] = 1;
  }
  return chain;
}

Eigen::Vector3d slow_error_m(const PathChain& chain, const Eigen::VectorXd& knots_m, std::size_t point) {
  const auto [knot, share] = chain.knots[point];
  const auto at = 3 * static_cast<Eigen::Index>(knot);
  return (1.0 - share) * knots_m.segment<3>(at) + share * knots_m.segment<3>(at + 3);
}

FacetHeights measure_heights(const PathChain& chain, const Eigen::VectorXd& knots_m, const Eigen::VectorXd& level_m,
                             const MeshSurface& surface, const Pose& T_mesh_world, double outlier_sigmas) {
  const std::size_t n = chain.p_world_m.size();
  FacetHeights out;
  out.d_m.resize(n);
  out.p_mesh_m.resize(n);
  out.normal.resize(n);
  out.usable.assign(n, 0);
  ClosestPoint closest;
  std::vector<double> magnitude_m;
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector3d p_m = T_mesh_world * (chain.p_world_m[i] - slow_error_m(chain, knots_m, i));
    if (!p_m.allFinite()) continue;
    closest = closest.found() ? surface.bvh.closest_point(p_m, closest) : surface.bvh.closest_point(p_m);
    const NormalFoot foot = foot_along_normal(surface, p_m, closest);
    if (!foot.on_normal) continue;
    const Triangle& corner = surface.mesh.triangles[foot.triangle];
    const Eigen::Vector3d& a = surface.mesh.vertices_m[corner[0]];
    const Eigen::Vector3d normal =
        (surface.mesh.vertices_m[corner[1]] - a).cross(surface.mesh.vertices_m[corner[2]] - a).normalized();
    if (!(normal.dot(foot.normal) > 0.0)) continue;
    out.p_mesh_m[i] = p_m;
    out.normal[i] = normal;
    out.d_m[i] = normal.dot(p_m - a) - level_m[static_cast<Eigen::Index>(chain.part_of[i])];
    out.usable[i] = 1;
    magnitude_m.push_back(std::abs(out.d_m[i]));
  }
  if (magnitude_m.empty()) return out;
  constexpr double kNormal = 1.4826;  // standard deviation over the median magnitude of a normal distribution
  const double limit_m = outlier_sigmas * kNormal * median_of(magnitude_m);
  double square = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    if (out.usable[i] != 0 && !(std::abs(out.d_m[i]) <= limit_m)) out.usable[i] = 0;
    if (out.usable[i] == 0) continue;
    square += out.d_m[i] * out.d_m[i];
    ++out.count;
  }
  out.rms_m = std::sqrt(square / static_cast<double>(std::max<std::size_t>(1, out.count)));
  return out;
}

}  // namespace asperity::registration
