#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "asperity/base/random.h"
#include "asperity/geometry/triangle_mesh.h"

namespace asperity::test {

inline Eigen::Vector3d random_point(Random& random, double half_width) {
  return {random.uniform(-half_width, half_width), random.uniform(-half_width, half_width),
          random.uniform(-half_width, half_width)};
}

// Separate triangles of the given size in a cube of half width 1.
inline TriangleMesh soup(std::uint32_t count, double size, std::uint64_t seed) {
  Random random(seed);
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Eigen::Vector3d centre = random_point(random, 1.0);
    for (int k = 0; k < 3; ++k) mesh.vertices_m.push_back(centre + random_point(random, size));
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return mesh;
}

// A closed sphere of radius 1 by rings and sectors; the poles are fans of thin triangles.
inline TriangleMesh sphere(std::uint32_t rings, std::uint32_t sectors) {
  TriangleMesh mesh;
  mesh.vertices_m.emplace_back(0.0, 0.0, 1.0);
  for (std::uint32_t i = 1; i < rings; ++i)
    for (std::uint32_t j = 0; j < sectors; ++j) {
      const double v = std::numbers::pi * i / rings, u = 2.0 * std::numbers::pi * j / sectors;
      mesh.vertices_m.emplace_back(std::sin(v) * std::cos(u), std::sin(v) * std::sin(u), std::cos(v));
    }
  mesh.vertices_m.emplace_back(0.0, 0.0, -1.0);
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return 1 + (i - 1) * sectors + j % sectors; };
  const auto last = static_cast<std::uint32_t>(mesh.vertices_m.size() - 1);
  for (std::uint32_t j = 0; j < sectors; ++j) {
    mesh.triangles.push_back({0, at(1, j), at(1, j + 1)});
    mesh.triangles.push_back({last, at(rings - 1, j + 1), at(rings - 1, j)});
    for (std::uint32_t i = 1; i + 1 < rings; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

// A flat open square of half width 1 in z = 0 with 2 n² triangles.
inline TriangleMesh square(std::uint32_t n) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t j = 0; j <= n; ++j) mesh.vertices_m.emplace_back(2.0 * i / n - 1.0, 2.0 * j / n - 1.0, 0.0);
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t a = i * (n + 1) + j, b = a + n + 1;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  return mesh;
}

// Points, segments, needles and slivers of every thinness among whole triangles; every fifth stands twice.
inline TriangleMesh degenerate(std::uint32_t count, std::uint64_t seed) {
  Random random(seed);
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Eigen::Vector3d a = random_point(random, 1.0), u = random_point(random, 1.0), w = random_point(random, 1.0);
    const double thin = std::pow(10.0, random.uniform(-18.0, 0.0));
    const Eigen::Vector3d corners[6][2] = {
        {a, a},        {a + u, a}, {a + u, a + 0.5 * u}, {a + u, a + 0.3 * u + thin * w}, {a + thin * u, a + w},
        {a + u, a + w}};
    mesh.vertices_m.push_back(a);
    mesh.vertices_m.push_back(corners[i % 6][0]);
    mesh.vertices_m.push_back(corners[i % 6][1]);
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    if (i % 5 == 0) mesh.triangles.push_back({3 * i + 1, 3 * i + 2, 3 * i});
  }
  return mesh;
}

// Many triangles on one edge, and a fan that meets itself in a corner: no manifold.
inline TriangleMesh book(std::uint32_t pages) {
  TriangleMesh mesh;
  mesh.vertices_m = {{0.0, 0.0, -1.0}, {0.0, 0.0, 1.0}};
  for (std::uint32_t i = 0; i < pages; ++i) {
    const double u = 2.0 * std::numbers::pi * i / pages;
    mesh.vertices_m.emplace_back(std::cos(u), std::sin(u), 0.1 * std::sin(5.0 * u));
    mesh.triangles.push_back({0, 1, i + 2});
    if (i > 0) mesh.triangles.push_back({0, i + 1, i + 2});
  }
  return mesh;
}

inline TriangleMesh moved(TriangleMesh mesh, double scale, const Eigen::Vector3d& offset) {
  for (auto& v : mesh.vertices_m) v = scale * v + offset;
  return mesh;
}

struct NamedMesh {
  std::string name;
  TriangleMesh mesh;
  double scale = 1.0;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
};

inline std::vector<NamedMesh> all_meshes() {
  const Eigen::Vector3d far(3e4, -1e5, 7e4);
  std::vector<NamedMesh> out{
      {"sphere", sphere(20, 30)},          {"soup", soup(800, 0.1, 1)},
      {"large soup", soup(300, 1.0, 2)},   {"one triangle", soup(1, 1.0, 3)},
      {"nine triangles", soup(9, 0.5, 4)}, {"square", square(20)},
      {"degenerate", degenerate(300, 5)},  {"book", book(200)},
      {"needle", sphere(6, 200)},          {"point", {{{1.0, 2.0, 3.0}}, {{0, 0, 0}, {0, 0, 0}}}}};
  out.push_back({"tiny", moved(sphere(16, 30), 1e-6, {0.0, 0.0, 0.0}), 1e-6});
  out.push_back({"huge", moved(degenerate(200, 6), 1e6, {0.0, 0.0, 0.0}), 1e6});
  out.push_back({"far away", moved(sphere(16, 30), 1.0, far), 1.0, far});
  out.push_back({"tiny and far", moved(soup(400, 0.1, 7), 1e-6, {0.3, -0.2, 0.1}), 1e-6, {0.3, -0.2, 0.1}});
  // One large triangle among dust: the leaves' units differ by many powers of two.
  NamedMesh dust{"dust", moved(soup(500, 0.1, 8), 1e-7, {0.0, 0.0, 0.0})};
  for (const auto& v :
       {Eigen::Vector3d(-1.0, -1.0, 0.0), Eigen::Vector3d(1.0, -1.0, 0.5), Eigen::Vector3d(0.0, 1.0, 0.0)})
    dust.mesh.vertices_m.push_back(v);
  const auto last = static_cast<std::uint32_t>(dust.mesh.vertices_m.size());
  dust.mesh.triangles.push_back({last - 3, last - 2, last - 1});
  out.push_back(std::move(dust));
  return out;
}

// Points in and around the mesh, on its corners, edges and faces and close to them, and far off.
inline std::vector<Eigen::Vector3d> query_points(const NamedMesh& named, std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Eigen::Vector3d> out;
  const auto& [name, mesh, scale, offset] = named;
  for (std::size_t i = 0; i < count; ++i) {
    const auto& t =
        mesh.triangles[static_cast<std::size_t>(random.uniform() * static_cast<double>(mesh.triangles.size()))];
    const auto &a = mesh.vertices_m[t[0]], &b = mesh.vertices_m[t[1]], &c = mesh.vertices_m[t[2]];
    const double u = random.uniform(), v = random.uniform() * (1.0 - u);
    const double reach = std::pow(10.0, random.uniform(-9.0, 0.0));
    const Eigen::Vector3d face = a + u * (b - a) + v * (c - a);
    const Eigen::Vector3d candidates[8] = {offset + scale * random_point(random, 1.5),
                                           face,
                                           face + scale * random_point(random, reach),
                                           a,
                                           a + u * (b - a),
                                           a + 0.5 * (b - a) + scale * random_point(random, reach),
                                           offset + scale * random_point(random, 100.0),
                                           offset + scale * random_point(random, 1e5)};
    out.push_back(candidates[i % 8]);
  }
  return out;
}

}  // namespace asperity::test
