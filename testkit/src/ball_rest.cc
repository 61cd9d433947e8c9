#include "asperity/testkit/ball_rest.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "asperity/testkit/tracked_minimum.h"

namespace asperity::testkit {
namespace {

using Eigen::Vector3d;

constexpr double kParallel = 1e-7;  // sine of the angle between two normals below which they are one
constexpr double kReach = 0.05;     // of the radius: the longest step
constexpr double kDone = 1e-12;     // of the radius: a step this small is the last
constexpr int kMostIterations = 400;

// The nearest point on the line where two boundaries meet, within the first `count` half-spaces.
Vector3d on_line(const Vector3d& p, std::span<const HalfSpace> spaces, std::size_t count, const HalfSpace& one,
                 const HalfSpace& two, const Vector3d& direction) {
  const double c = one.n.dot(two.n), s2 = 1.0 - c * c;
  const double g1 = one.b_m - one.n.dot(p), g2 = two.b_m - two.n.dot(p);
  const Vector3d foot = p + (g1 - c * g2) / s2 * one.n + (g2 - c * g1) / s2 * two.n;
  double low = -std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t k = 0; k < count; ++k) {
    const double slope = spaces[k].n.dot(direction), need = spaces[k].b_m - spaces[k].n.dot(foot);
    if (slope > kParallel) low = std::max(low, need / slope);
    if (slope < -kParallel) high = std::min(high, need / slope);
  }
  return foot + (low > high ? 0.5 * (low + high) : std::clamp(0.0, low, high)) * direction;
}

Vector3d on_plane(const Vector3d& p, std::span<const HalfSpace> spaces, std::size_t count, const HalfSpace& plane) {
  Vector3d x = p + (plane.b_m - plane.n.dot(p)) * plane.n;
  for (std::size_t k = 0; k < count; ++k) {
    if (spaces[k].n.dot(x) >= spaces[k].b_m) continue;
    const Vector3d along = plane.n.cross(spaces[k].n);
    const double sine = along.norm();
    if (sine <= kParallel) continue;
    x = on_line(p, spaces, k, plane, spaces[k], along / sine);
  }
  return x;
}

std::vector<std::uint32_t> triangles_near(const MeshBvh& bvh, const Vector3d& c, double radius_m) {
  std::vector<std::uint32_t> near(64);
  const std::size_t count = bvh.triangles_within(c, radius_m, near);
  near.resize(count);
  if (count > 64) bvh.triangles_within(c, radius_m, near);
  return near;
}

// A half-space for each triangle near c, none twice.
void half_spaces_of(const TriangleMesh& mesh, std::span<const std::uint32_t> near, const Vector3d& c, double radius_m,
                    std::vector<HalfSpace>& out) {
  out.clear();
  for (const std::uint32_t index : near) {
    const auto& [i, j, k] = mesh.triangles[index];
    const Vector3d q = nearest_of_triangle(mesh.vertices_m[i], mesh.vertices_m[j], mesh.vertices_m[k], c).p_m;
    const Vector3d n = (c - q).normalized();
    out.push_back({n, n.dot(q) + radius_m});
  }
  std::sort(out.begin(), out.end(), [](const HalfSpace& a, const HalfSpace& b) {
    return std::lexicographical_compare(a.n.data(), a.n.data() + 3, b.n.data(), b.n.data() + 3);
  });
  out.erase(std::unique(out.begin(), out.end(), [](const HalfSpace& a, const HalfSpace& b) { return a.n == b.n; }),
            out.end());
}

}  // namespace

Vector3d nearest_of_half_spaces(const Vector3d& p_m, std::span<const HalfSpace> spaces) {
  Vector3d x = p_m;
  for (std::size_t k = 0; k < spaces.size(); ++k) {
    if (spaces[k].n.dot(x) < spaces[k].b_m) x = on_plane(p_m, spaces, k, spaces[k]);
  }
  return x;
}

BallRest::BallRest(const TriangleMesh& mesh, const MeshBvh& bvh, double radius_m)
    : mesh_(mesh), bvh_(bvh), radius_m_(radius_m) {}

Vector3d BallRest::descend(const Vector3d& centre_m, const Vector3d& p_m) {
  Vector3d c = centre_m;
  for (iterations_ = 0; iterations_ < kMostIterations; ++iterations_) {
    const double reach_m = std::min((p_m - c).norm(), kReach * radius_m_);
    if (reach_m == 0.0) break;
    near_.resize(std::max<std::size_t>(near_.size(), 64));
    std::size_t count = bvh_.triangles_within(c, radius_m_ + reach_m, near_);
    if (count > near_.size()) {
      near_.resize(2 * count);
      count = bvh_.triangles_within(c, radius_m_ + reach_m, near_);
    }
    half_spaces_of(mesh_, std::span<const std::uint32_t>(near_).first(count), c, radius_m_, spaces_);
    // The sharpest first: later ones then seldom cut.
    std::stable_sort(spaces_.begin(), spaces_.end(), [&](const HalfSpace& a, const HalfSpace& b) {
      return a.b_m - a.n.dot(p_m) > b.b_m - b.n.dot(p_m);
    });
    const Vector3d step = nearest_of_half_spaces(p_m, spaces_) - c;
    const double length_m = step.norm();
    if (length_m <= reach_m) {
      c += step;
    } else {
      c += reach_m / length_m * step;
    }
    if (length_m <= kDone * radius_m_) break;
  }
  return c;
}

const Vector3d& BallRest::follow(const Vector3d& p_m, int steps) {
  const Vector3d from = last_m_;
  for (int i = 1; i <= steps; ++i) {
    centre_m_ = descend(centre_m_, i == steps ? p_m : Vector3d(from + static_cast<double>(i) / steps * (p_m - from)));
  }
  last_m_ = p_m;
  return centre_m_;
}

BallConditions ball_conditions(const TriangleMesh& mesh, const MeshBvh& bvh, double radius_m, const Vector3d& centre_m,
                               const Vector3d& p_m, double slack) {
  BallConditions out;
  out.distance_m = bvh.closest_point(centre_m).distance_m;
  std::vector<HalfSpace> spaces;
  half_spaces_of(mesh, triangles_near(bvh, centre_m, radius_m * (1.0 + slack)), centre_m, radius_m, spaces);
  out.touching = spaces.size();
  // The part of p − c that no λ >= 0 explains is its projection on the dual cone {x : n·x >= 0} (Moreau 1962).
  for (HalfSpace& space : spaces) space.b_m = 0.0;
  const Vector3d pull = p_m - centre_m;
  std::stable_sort(spaces.begin(), spaces.end(),
                   [&](const HalfSpace& a, const HalfSpace& b) { return a.n.dot(pull) < b.n.dot(pull); });
  out.residual_m = nearest_of_half_spaces(pull, spaces).norm();
  return out;
}

}  // namespace asperity::testkit
