#include "query_patterns.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <Eigen/Geometry>

#include "asperity/base/random.h"
#include "asperity/geometry/mesh_bvh.h"

namespace bench {

using asperity::Random;
using asperity::Triangle;
using asperity::TriangleMesh;
using Eigen::Vector3d;

namespace {

struct Box {
  Vector3d low, high;
};

Box box_of(const TriangleMesh& mesh) {
  Box box{mesh.vertices_m.front(), mesh.vertices_m.front()};
  for (const auto& v : mesh.vertices_m) {
    box.low = box.low.cwiseMin(v);
    box.high = box.high.cwiseMax(v);
  }
  return box;
}

Vector3d area_vector(const TriangleMesh& mesh, std::size_t triangle) {
  const Triangle& t = mesh.triangles[triangle];
  const Vector3d& a = mesh.vertices_m[t[0]];
  return 0.5 * (mesh.vertices_m[t[1]] - a).cross(mesh.vertices_m[t[2]] - a);
}

}  // namespace

QueryPatterns make_query_patterns(const TriangleMesh& mesh, std::size_t count, std::uint64_t seed) {
  constexpr double kReach_m = 1e-3;
  constexpr double kStep_m = 1e-4;
  Random random(seed);
  QueryPatterns out;

  std::vector<double> area(mesh.triangles.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < area.size(); ++i) area[i] = sum += area_vector(mesh, i).norm();
  const auto on_surface = [&](Vector3d& normal) {
    const auto i =
        static_cast<std::size_t>(std::lower_bound(area.begin(), area.end(), random.uniform(0.0, sum)) - area.begin());
    normal = area_vector(mesh, i).normalized();
    double u = random.uniform(), v = random.uniform();
    if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
    const Triangle& t = mesh.triangles[i];
    const Vector3d& a = mesh.vertices_m[t[0]];
    return Vector3d(a + u * (mesh.vertices_m[t[1]] - a) + v * (mesh.vertices_m[t[2]] - a));
  };

  const Box box = box_of(mesh);
  for (std::size_t i = 0; i < count; ++i) {
    Vector3d normal;
    const Vector3d p = on_surface(normal);
    out.near.push_back(p + random.uniform(-kReach_m, kReach_m) * normal);
    Vector3d q;
    for (int k = 0; k < 3; ++k) q[k] = random.uniform(box.low[k], box.high[k]);
    out.random.push_back(q);
  }

  const asperity::MeshBvh bvh(mesh);
  Vector3d normal, turning;
  Vector3d p = on_surface(normal);
  Vector3d heading = normal.unitOrthogonal();
  for (std::size_t i = 0; i < count; ++i) {
    const double height = kReach_m * std::sin(2.0 * std::numbers::pi * static_cast<double>(i) / 317.0);
    out.path.push_back(p + height * normal);
    heading = (heading + 0.02 * random.normal() * normal.cross(heading)).normalized();
    const auto next = bvh.closest_point(p + kStep_m * heading);
    p = next.p_m;
    normal = area_vector(mesh, next.triangle).normalized();
    heading = (heading - heading.dot(normal) * normal).normalized();
  }
  return out;
}

TriangleMesh bumpy_torus(std::uint32_t rows, std::uint32_t columns) {
  constexpr double kRing_m = 40e-3, kTube_m = 18e-3, kBump_m = 1e-3;
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < rows; ++i) {
    for (std::uint32_t j = 0; j < columns; ++j) {
      const double u = 2.0 * std::numbers::pi * i / rows, v = 2.0 * std::numbers::pi * j / columns;
      const double r = kTube_m + kBump_m * std::sin(9.0 * u) * std::cos(7.0 * v);
      const double ring = kRing_m + r * std::cos(v);
      mesh.vertices_m.emplace_back(ring * std::cos(u), ring * std::sin(u), r * std::sin(v));
      const std::uint32_t i1 = (i + 1) % rows, j1 = (j + 1) % columns;
      const std::uint32_t a = i * columns + j, b = i1 * columns + j, c = i1 * columns + j1, d = i * columns + j1;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  }
  return mesh;
}

TriangleMesh subdivide(const TriangleMesh& mesh) {
  TriangleMesh out;
  out.vertices_m = mesh.vertices_m;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [at, added] = middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(out.vertices_m.size()));
    if (added) out.vertices_m.push_back(0.5 * (mesh.vertices_m[a] + mesh.vertices_m[b]));
    return at->second;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const Triangle& t : {Triangle{a, ab, ca}, Triangle{ab, b, bc}, Triangle{ca, bc, c}, Triangle{ab, bc, ca}})
      out.triangles.push_back(t);
  }
  return out;
}

TriangleMesh scaled_to(TriangleMesh mesh, double size_m) {
  const Box box = box_of(mesh);
  const double scale = size_m / (box.high - box.low).maxCoeff();
  for (auto& v : mesh.vertices_m) v *= scale;
  return mesh;
}

}  // namespace bench
