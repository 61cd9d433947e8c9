#include "mesh_truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "asperity/base/error.h"

namespace asperity {

namespace {

constexpr double kTruthSpacing_m = 25e-6;
constexpr double kTruthMargin_m = 3e-3;
constexpr double kWindow_m = 1e-3;  // the foot is no further from its place on the path than a lateral deviation

}  // namespace

MeshBasePath place_on_mesh(const MeshBase& base, const ScanPath& path) {
  MeshBasePath out;
  const auto margin = static_cast<std::ptrdiff_t>(kTruthMargin_m / kTruthSpacing_m);
  const auto count = static_cast<std::ptrdiff_t>(std::ceil(path.length_m() / kTruthSpacing_m));
  const double step_m = path.length_m() / static_cast<double>(count);
  const Pose T_mesh_world = base.T_world_mesh().inverse();
  out.p_mesh_m.reserve(static_cast<std::size_t>(count + 2 * margin + 1));
  Ground ground;
  for (std::ptrdiff_t i = -margin; i <= count + margin; ++i) {
    const double path_s_m = static_cast<double>(i) * step_m;
    const ScanPoint point = path.at(path_s_m);
    const Ground here = base.ground(point.a_m, point.v_m);
    if (here.found) {
      ground = here;
    } else if (i >= 0 && i <= count) {
      throw Error(fmt::format("simulation.shape: the path leaves the mesh {:.4g} m from its beginning", path_s_m));
    }
    out.path_s_m.push_back(path_s_m);
    out.p_mesh_m.push_back(T_mesh_world * base.point_m(point.a_m, point.v_m, ground.height_m));
  }
  out.s_m.assign(out.p_mesh_m.size(), 0.0);
  for (std::size_t i = 1; i < out.s_m.size(); ++i)
    out.s_m[i] = out.s_m[i - 1] + (out.p_mesh_m[i] - out.p_mesh_m[i - 1]).norm();
  const double start_m = out.s_m[static_cast<std::size_t>(margin)];
  for (double& s_m : out.s_m) s_m -= start_m;
  out.length_m = out.s_m[static_cast<std::size_t>(margin + count)];
  return out;
}

void measure_on_mesh(const MeshBase& base, const MeshBasePath& path, Truth& truth) {
  const Pose T_mesh_world = base.T_world_mesh().inverse();
  const double first_m = path.path_s_m.front(), step_m = path.path_s_m[1] - first_m;
  const auto last = static_cast<std::ptrdiff_t>(path.s_m.size()) - 1;
  ClosestPoint start;
  for (std::size_t row = 0; row < truth.size(); ++row) {
    const Eigen::Vector3d p_mesh_m = T_mesh_world * truth.p_world_tip_m[row];
    const auto near = static_cast<std::ptrdiff_t>(std::clamp((truth.s_m[row] - first_m) / step_m, 0.0, 1e9));
    // Over a tight bend a deep hole has more than one foot: that of the path's own point counts.
    const Eigen::Vector3d& on_path_m = path.p_mesh_m[static_cast<std::size_t>(std::min(near, last))];
    start = start.found() ? base.surface().bvh.closest_point(on_path_m, start)
                          : base.surface().bvh.closest_point(on_path_m);
    NormalFoot foot = foot_along_normal(base.surface(), p_mesh_m, start);
    if (!foot.on_normal) foot = foot_along_normal(base.surface(), p_mesh_m, base.surface().bvh.closest_point(p_mesh_m));
    truth.height_m[row] = foot.height_m;

    const auto reach = static_cast<std::ptrdiff_t>(kWindow_m / step_m);
    const std::ptrdiff_t from = std::clamp<std::ptrdiff_t>(near - reach, 0, last - 1);
    const std::ptrdiff_t to = std::clamp<std::ptrdiff_t>(near + reach, from, last - 1);
    double nearest_m2 = std::numeric_limits<double>::infinity();
    for (std::ptrdiff_t i = from; i <= to; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const Eigen::Vector3d step = path.p_mesh_m[k + 1] - path.p_mesh_m[k];
      const Eigen::Vector3d gap = foot.p_m - path.p_mesh_m[k];
      const double squared = step.squaredNorm();
      const double share = squared > 0.0 ? std::clamp(gap.dot(step) / squared, 0.0, 1.0) : 0.0;
      const double distance_m2 = (gap - share * step).squaredNorm();
      if (distance_m2 >= nearest_m2) continue;
      nearest_m2 = distance_m2;
      truth.s_m[row] = path.s_m[k] + share * (path.s_m[k + 1] - path.s_m[k]);
    }
  }
}

}  // namespace asperity
