#include "path_chain.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

namespace asperity::registration {

namespace {

double median_of(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// The index of a path's tip among the chain's; a new one for a number that is new.
void add_tip(const MeasuredPath& path, std::vector<int>& numbers, PathChain& chain, PathChain::Part& part) {
  part.has_tip = path.q_world_marker.size() == path.p_world_m.size() && !path.p_world_m.empty() &&
                 path.tip_sigma_m.allFinite() && path.tip_sigma_m.minCoeff() > 0.0;
  if (!part.has_tip) return;
  const auto found = std::find(numbers.begin(), numbers.end(), path.tip);
  part.tip = static_cast<std::size_t>(found - numbers.begin());
  if (found != numbers.end()) return;
  numbers.push_back(path.tip);
  chain.tip_sigma_m.push_back(path.tip_sigma_m);
}

}  // namespace

PathChain make_chain(std::span<const MeasuredPath> paths, double knot_m, std::span<const std::size_t> placement_of) {
  PathChain chain;
  std::vector<double> steps_m;
  std::vector<int> tip_numbers;
  for (std::size_t p = 0; p < paths.size(); ++p) {
    const MeasuredPath& path = paths[p];
    PathChain::Part part;
    part.first_point = chain.p_world_m.size();
    part.points = path.p_world_m.size();
    part.first_knot = chain.knot_count;
    part.placement = placement_of.empty() ? 0 : placement_of[p];
    chain.placement_count = std::max(chain.placement_count, part.placement + 1);
    part.covariance_m2 = path.slow_covariance_world_m2;
    part.is_slow =
        part.covariance_m2.trace() > 0.0 && Eigen::LLT<Eigen::Matrix3d>(part.covariance_m2).info() == Eigen::Success;
    add_tip(path, tip_numbers, chain, part);
    double s_m = 0.0;
    for (std::size_t i = 0; i < path.p_world_m.size(); ++i) {
      const double step_m = i == 0 ? 0.0 : (path.p_world_m[i] - path.p_world_m[i - 1]).norm();
      if (i > 0 && std::isfinite(step_m)) steps_m.push_back(step_m);
      s_m += std::isfinite(step_m) ? step_m : 0.0;
      const double at = s_m / knot_m;
      const double knot = std::floor(at);
      chain.p_world_m.push_back(path.p_world_m[i]);
      chain.R_world_marker.push_back(part.has_tip ? path.q_world_marker[i].toRotationMatrix()
                                                  : Eigen::Matrix3d(Eigen::Matrix3d::Zero()));
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

State zero_state(const PathChain& chain, std::vector<Pose> T_mesh_world) {
  State out;
  out.T_mesh_world = std::move(T_mesh_world);
  out.tip_m = Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(chain.tip_sigma_m.size()));
  out.bulge = kBulge;
  out.level_m = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(chain.parts.size()));
  out.knots_m = Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(chain.knot_count));
  return out;
}

Eigen::Vector3d slow_error_m(const PathChain& chain, const State& state, std::size_t point) {
  const auto [knot, share] = chain.knots[point];
  const auto at = 3 * static_cast<Eigen::Index>(knot);
  return (1.0 - share) * state.knots_m.segment<3>(at) + share * state.knots_m.segment<3>(at + 3);
}

Eigen::Vector3d tip_motion_m(const PathChain& chain, const State& state, std::size_t point) {
  const PathChain::Part& part = chain.parts[chain.part_of[point]];
  if (!part.has_tip) return Eigen::Vector3d::Zero();
  return chain.R_world_marker[point] * state.tip_m.segment<3>(3 * static_cast<Eigen::Index>(part.tip));
}

FacetHeights measure_heights(const PathChain& chain, const State& state, const MeshSurface& surface,
                             double outlier_sigmas) {
  const std::size_t n = chain.p_world_m.size();
  FacetHeights out;
  out.d_m.resize(n);
  out.bulge_m.resize(n);
  out.here_m.resize(n);
  out.p_mesh_m.resize(n);
  out.normal.resize(n);
  out.usable.assign(n, 0);
  double square_m2 = 0.0, edge_sum_m = 0.0, edges = 0.0;
  for (const PathChain::Part& part : chain.parts) {
    const Pose& T_mesh_world = state.T_mesh_world[part.placement];
    const double level_m = state.level_m[static_cast<Eigen::Index>(&part - chain.parts.data())];
    const std::size_t end = part.first_point + part.points;
    ClosestPoint closest;
    std::vector<double> magnitude_m;
    for (std::size_t i = part.first_point; i < end; ++i) {
      const Eigen::Vector3d p_m =
          T_mesh_world * (chain.p_world_m[i] + tip_motion_m(chain, state, i) - slow_error_m(chain, state, i));
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
      const double facet_share = state.bulge_m.empty() ? 1.0 - state.bulge : 0.0;
      out.normal[i] = (facet_share * normal + (1.0 - facet_share) * foot.normal).normalized();
      out.here_m[i] = facet_bulge_m(surface, foot.triangle, foot.barycentric);
      out.bulge_m[i] = state.bulge_m.empty() ? out.here_m[i] : state.bulge_m[i];
      out.d_m[i] = normal.dot(p_m - a) - out.here_m[i] + (1.0 - state.bulge) * out.bulge_m[i] - level_m;
      for (std::size_t k = 0; k < 3; ++k)
        edge_sum_m += (surface.mesh.vertices_m[corner[(k + 1) % 3]] - surface.mesh.vertices_m[corner[k]]).norm() / 3.0;
      edges += 1.0;
      out.usable[i] = 1;
      magnitude_m.push_back(std::abs(out.d_m[i]));
    }
    constexpr double kNormal = 1.4826;  // standard deviation over the median magnitude of a normal distribution
    const double limit_m = magnitude_m.empty() ? 0.0 : outlier_sigmas * kNormal * median_of(magnitude_m);
    double part_m2 = 0.0;
    std::size_t count = 0;
    for (std::size_t i = part.first_point; i < end; ++i) {
      if (out.usable[i] != 0 && !(std::abs(out.d_m[i]) <= limit_m)) out.usable[i] = 0;
      if (out.usable[i] == 0) continue;
      part_m2 += out.d_m[i] * out.d_m[i];
      ++count;
    }
    out.part_rms_m.push_back(std::sqrt(part_m2 / static_cast<double>(std::max<std::size_t>(1, count))));
    out.part_count.push_back(count);
    square_m2 += part_m2;
    out.count += count;
  }
  out.edge_m = edges > 0.0 ? edge_sum_m / edges : 0.0;
  out.rms_m = std::sqrt(square_m2 / static_cast<double>(std::max<std::size_t>(1, out.count)));
  return out;
}

}  // namespace asperity::registration
