#include "asperity/simulation/mesh_stroke.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

namespace {

constexpr double kSpacing_m = 0.1e-3;  // well below the hand's smoothing (mesh_base.h)
constexpr double kMargin_m = 8e-3;     // the tip may lag behind the hand's first place, and smoothing needs both sides
constexpr double kLongest_m = 20.0;
constexpr int kSweeps = 30;
// Finer than this pulling tight changes nothing that smoothing leaves.
constexpr double kTight_m = 1e-3;

Eigen::Vector3d normal_at(const MeshSurface& surface, const ClosestPoint& at) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) normal += at.barycentric[k] * surface.normals[at.triangle][static_cast<std::size_t>(k)];
  return normal.normalized();
}

struct Axes {
  Eigen::Vector3d centre_m, longest, shortest;
  double size_m = 0.0;
};

Axes axes_of(const TriangleMesh& mesh) {
  Axes out;
  Eigen::Vector3d sum_m3 = Eigen::Vector3d::Zero();
  double area_m2 = 0.0;
  const auto corner = [&](const Triangle& t, std::size_t k) -> const Eigen::Vector3d& { return mesh.vertices_m[t[k]]; };
  for (const Triangle& t : mesh.triangles) {
    const double twice = (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0)).norm();
    sum_m3 += twice / 3.0 * (corner(t, 0) + corner(t, 1) + corner(t, 2));
    area_m2 += twice;
  }
  if (!(area_m2 > 0.0)) throw Error("simulation.shape: the mesh has no area");
  out.centre_m = sum_m3 / area_m2;
  Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
  for (const Triangle& t : mesh.triangles) {
    const double twice = (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0)).norm();
    const Eigen::Vector3d m = (corner(t, 0) + corner(t, 1) + corner(t, 2)) / 3.0 - out.centre_m;
    moment += twice * m * m.transpose();
    out.size_m = std::max(out.size_m, 2.0 * m.norm());
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moment);
  const auto signed_axis = [&](int column) {
    Eigen::Vector3d axis = solver.eigenvectors().col(column);
    Eigen::Index largest = 0;
    axis.cwiseAbs().maxCoeff(&largest);
    return Eigen::Vector3d(axis[largest] < 0.0 ? -axis : axis);
  };
  out.shortest = signed_axis(0);
  out.longest = signed_axis(2);
  return out;
}

// Straight on over the surface from `from` for `length_m`, in steps of kSpacing_m without the first point.
// Beyond a border straight on in space.
std::vector<Eigen::Vector3d> continue_straight(const MeshSurface& surface, const Eigen::Vector3d& from,
                                               Eigen::Vector3d direction, double length_m) {
  const auto steps = static_cast<std::size_t>(std::ceil(length_m / kSpacing_m));
  std::vector<Eigen::Vector3d> out;
  out.reserve(steps);
  ClosestPoint at = surface.bvh.closest_point(from);
  Eigen::Vector3d p_m = from;
  bool on_mesh = true;
  for (std::size_t i = 0; i < steps; ++i) {
    Eigen::Vector3d next_m = p_m + kSpacing_m * direction;
    if (on_mesh) {
      const Eigen::Vector3d normal = normal_at(surface, at);
      const Eigen::Vector3d flat = direction - direction.dot(normal) * normal;
      if (flat.norm() > 0.1) direction = flat.normalized();
      next_m = p_m + kSpacing_m * direction;
      at = surface.bvh.closest_point(next_m, at);
      on_mesh = (at.p_m - p_m).norm() > 0.5 * kSpacing_m;
      if (on_mesh) {
        next_m = p_m + kSpacing_m * (at.p_m - p_m).normalized();
        direction = (next_m - p_m) / kSpacing_m;
      }
    }
    out.push_back(next_m);
    p_m = next_m;
  }
  return out;
}

// A line between two points over the surface, both included, its points at most kSpacing_m apart.
std::vector<Eigen::Vector3d> join_points(const MeshSurface& surface, const Eigen::Vector3d& from,
                                         const Eigen::Vector3d& to, std::size_t number) {
  const auto fail = [&] {
    return Error(
        fmt::format("simulation.shape.through: no path on the surface connects point {} with point {}; pick more "
                    "points between them",
                    number, number + 1));
  };
  std::vector<Eigen::Vector3d> line{from, to};
  const double chord_m = (to - from).norm();
  if (!(chord_m > 0.0))
    throw Error(fmt::format("simulation.shape.through: points {} and {} are the same", number, number + 1));
  const int levels = 4 + static_cast<int>(std::ceil(std::log2(std::max(1.0, chord_m / kSpacing_m))));
  double longest_m = chord_m;
  for (int level = 0; level < levels && longest_m > kSpacing_m; ++level) {
    std::vector<Eigen::Vector3d> finer;
    finer.reserve(2 * line.size());
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      finer.push_back(line[i]);
      if ((line[i + 1] - line[i]).norm() > kSpacing_m)
        finer.push_back(surface.bvh.closest_point(0.5 * (line[i] + line[i + 1])).p_m);
    }
    finer.push_back(line.back());
    line = std::move(finer);
    if (static_cast<double>(line.size()) > kLongest_m / kSpacing_m) throw fail();
    for (int sweep = 0; sweep < kSweeps && longest_m > kTight_m; ++sweep) {
      for (std::size_t i = 1; i + 1 < line.size(); ++i)
        line[i] = surface.bvh.closest_point(0.5 * (line[i - 1] + line[i + 1])).p_m;
    }
    longest_m = 0.0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) longest_m = std::max(longest_m, (line[i + 1] - line[i]).norm());
  }
  if (longest_m > 2.0 * kSpacing_m) throw fail();
  return line;
}

}  // namespace

std::vector<Eigen::Vector3d> parse_points_m(std::string_view text, std::string_view what) {
  constexpr std::size_t kMost = 1000;
  constexpr double kFurthest_m = 1000.0;
  std::vector<Eigen::Vector3d> out;
  std::string_view rest = trim(text);
  while (!rest.empty()) {
    const std::size_t end = rest.find(';');
    std::string_view point = rest.substr(0, end);
    rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
    Eigen::Vector3d p_m;
    const std::string_view whole = point;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const std::size_t comma = point.find(',');
      const auto number = parse_double(trim(point.substr(0, comma)));
      if (!number || !(std::abs(*number) <= kFurthest_m) || (comma == std::string_view::npos) != (axis == 2))
        throw Error(fmt::format("{}: '{}' is not a point x,y,z in metres", what, printable(whole)));
      p_m[axis] = *number;
      if (axis < 2) point.remove_prefix(comma + 1);
    }
    out.push_back(p_m);
    if (out.size() > kMost) throw Error(fmt::format("{}: more than {} points", what, kMost));
  }
  return out;
}

MeshStroke trace_mesh_stroke(const MeshSurface& surface, const std::vector<Eigen::Vector3d>& picked_m,
                             double length_m) {
  const Axes axes = axes_of(surface.mesh);
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < picked_m.size(); ++i) {
    const ClosestPoint at = surface.bvh.closest_point(picked_m[i]);
    if (!(at.distance_m <= 0.1 * axes.size_m)) {
      throw Error(fmt::format(
          "simulation.shape.through: point {} is {:.3g} m from a mesh of {:.3g} m: are the points in metres?", i + 1,
          at.distance_m, axes.size_m));
    }
    points.push_back(at.p_m);
  }
  if (points.empty()) {
    const RayHit hit = surface.bvh.cast_ray(axes.centre_m + axes.size_m * axes.shortest, -axes.shortest);
    points.push_back(surface.bvh
                         .closest_point(hit.found()
                                            ? Eigen::Vector3d(axes.centre_m + (axes.size_m - hit.t) * axes.shortest)
                                            : axes.centre_m)
                         .p_m);
  }

  std::vector<Eigen::Vector3d> line;
  if (points.size() == 1) {
    const Eigen::Vector3d normal = normal_at(surface, surface.bvh.closest_point(points[0]));
    Eigen::Vector3d direction = axes.longest - axes.longest.dot(normal) * normal;
    direction = direction.norm() > 0.1 ? direction.normalized() : normal.unitOrthogonal();
    const std::vector<Eigen::Vector3d> back = continue_straight(surface, points[0], -direction, 0.5 * length_m);
    line.assign(back.rbegin(), back.rend());
    line.push_back(points[0]);
    const std::vector<Eigen::Vector3d> on = continue_straight(surface, points[0], direction, 0.5 * length_m);
    line.insert(line.end(), on.begin(), on.end());
  } else {
    line.push_back(points[0]);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const std::vector<Eigen::Vector3d> part = join_points(surface, points[i], points[i + 1], i + 1);
      line.insert(line.end(), part.begin() + 1, part.end());
    }
  }

  MeshStroke stroke;
  stroke.spacing_m = kSpacing_m;
  stroke.margin_m = kMargin_m;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) stroke.length_m += (line[i + 1] - line[i]).norm();
  if (points.size() == 1) stroke.length_m = length_m;
  if (stroke.length_m > kLongest_m)
    throw Error(
        fmt::format("simulation.shape.through: a path of {:.3g} m is more than {} m", stroke.length_m, kLongest_m));

  // The directions at the ends over a millimetre, where the last step alone is at the facets' mercy.
  const std::size_t reach = std::min<std::size_t>(10, line.size() - 1);
  const std::vector<Eigen::Vector3d> before =
      continue_straight(surface, line.front(), (line.front() - line[reach]).normalized(), kMargin_m + kSpacing_m);
  const std::vector<Eigen::Vector3d> after = continue_straight(
      surface, line.back(), (line.back() - line[line.size() - 1 - reach]).normalized(), kMargin_m + 3.0 * kSpacing_m);
  std::vector<Eigen::Vector3d> whole(before.rbegin(), before.rend());
  whole.insert(whole.end(), line.begin(), line.end());
  whole.insert(whole.end(), after.begin(), after.end());

  // Evenly spaced by length: whole[0] is one spacing before the margin's beginning.
  double skipped_m = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) skipped_m += (whole[i + 1] - whole[i]).norm();
  double at_m = skipped_m - kMargin_m, passed_m = 0.0;
  const auto count = static_cast<std::size_t>(std::ceil((stroke.length_m + 2.0 * kMargin_m) / kSpacing_m)) + 1;
  stroke.p_mesh_m.reserve(count);
  for (std::size_t i = 0; i + 1 < whole.size() && stroke.p_mesh_m.size() < count; ++i) {
    const Eigen::Vector3d step_m = whole[i + 1] - whole[i];
    const double step = step_m.norm();
    while (at_m <= passed_m + step && stroke.p_mesh_m.size() < count) {
      stroke.p_mesh_m.push_back(whole[i] + (step > 0.0 ? (at_m - passed_m) / step : 0.0) * step_m);
      at_m += kSpacing_m;
    }
    passed_m += step;
  }
  while (stroke.p_mesh_m.size() < count) {
    const std::size_t n = stroke.p_mesh_m.size();
    stroke.p_mesh_m.push_back(2.0 * stroke.p_mesh_m[n - 1] - stroke.p_mesh_m[n - 2]);
  }
  return stroke;
}

}  // namespace asperity
