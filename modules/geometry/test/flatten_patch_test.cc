#include "asperity/geometry/flatten_patch.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/error.h"

namespace asperity {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;
using testing::HasSubstr;
using testing::ThrowsMessage;

// A mesh over a grid of (i, j), both triangles of a cell counter-clockwise there.
TriangleMesh grid_mesh(int columns, int rows, const std::function<Vector3d(double, double)>& point) {
  TriangleMesh out;
  for (int r = 0; r <= rows; ++r)
    for (int c = 0; c <= columns; ++c) out.vertices_m.push_back(point(c, r));
  const auto at = [&](int c, int r) { return static_cast<std::uint32_t>(r * (columns + 1) + c); };
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      out.triangles.push_back({at(c, r), at(c + 1, r), at(c + 1, r + 1)});
      out.triangles.push_back({at(c, r), at(c + 1, r + 1), at(c, r + 1)});
    }
  }
  return out;
}

// All of a mesh as a patch: a path through every triangle.
SurfacePatch whole(const TriangleMesh& mesh) {
  const MeshSurface surface(mesh);
  MeshPath path;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& v = mesh.triangles[t];
    path.p_mesh_m.push_back((mesh.vertices_m[v[0]] + mesh.vertices_m[v[1]] + mesh.vertices_m[v[2]]) / 3.0);
    path.triangle.push_back(t);
    path.s_m.push_back(t);
  }
  return find_surface_patch(surface, std::vector{path}, {0.0});
}

// A cylinder's facets along its generators unroll without a trace of stretch: 100 degrees of one of radius 20 mm.
TEST(FlattenPatch, UnrollsACylinder) {
  const SurfacePatch patch = whole(grid_mesh(40, 25, [](double i, double j) {
    const double angle = 100.0 / 180.0 * pi * i / 40.0;
    return Vector3d(0.02 * std::cos(angle), 0.02 * std::sin(angle), 0.03 * j / 25.0);
  }));
  const FlatPatch flat = flatten_patch(patch);
  EXPECT_TRUE(flat.converged);
  EXPECT_EQ(flat.flipped, 0u);
  EXPECT_NEAR(flat.stretch_min, 1.0, 1e-6);
  EXPECT_NEAR(flat.stretch_max, 1.0, 1e-6);
  EXPECT_NEAR(flat.energy, 2.0, 1e-10);
  // Opposite corners are as far apart as on the unrolled facets.
  const double chord_m = 40.0 * 2.0 * 0.02 * std::sin(0.5 * 100.0 / 180.0 * pi / 40.0);
  std::vector<Vector2d> uv(patch.vertex.size());
  for (std::size_t i = 0; i < uv.size(); ++i) uv[patch.vertex[i]] = flat.uv_m[i];
  EXPECT_NEAR((uv.back() - uv.front()).norm(), std::hypot(chord_m, 0.03), 1e-8);
}

// A sector of a cone, its apex left out; flat facets between its generators.
TEST(FlattenPatch, UnrollsAConeSector) {
  const SurfacePatch patch = whole(grid_mesh(48, 20, [](double i, double j) {
    const double angle = 1.5 * pi * i / 48.0, along_m = 0.01 + 0.03 * j / 20.0;
    return Vector3d(0.6 * along_m * std::sin(angle), 0.6 * along_m * std::cos(angle), -0.8 * along_m);
  }));
  const FlatPatch flat = flatten_patch(patch);
  EXPECT_EQ(flat.flipped, 0u);
  EXPECT_NEAR(flat.stretch_min, 1.0, 1e-6);
  EXPECT_NEAR(flat.stretch_max, 1.0, 1e-6);
}

// The least mean energy of a map of a spherical cap (radius 1, half angle `cap`) that keeps its symmetry: of r(φ), by
// Newton's method on a fine grid, an independent one-dimensional problem.
double least_energy_of_cap(double cap) {
  constexpr int n = 200;
  const double h = cap / n;
  std::vector<double> r(n + 1);
  for (int i = 0; i <= n; ++i) r[static_cast<std::size_t>(i)] = i * h;
  // ∫ ½ (r'² + 1/r'² + (r/sin φ)² + (sin φ/r)²) sin φ dφ, by the midpoints of the cells.
  const auto energy = [&](const std::vector<double>& x) {
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      const double s = std::sin((static_cast<double>(i) + 0.5) * h), d = (x[i + 1] - x[i]) / h;
      const double round = 0.5 * (x[i + 1] + x[i]) / s;
      sum += 0.5 * (d * d + 1.0 / (d * d) + round * round + 1.0 / (round * round)) * s * h;
    }
    return sum;
  };
  // Sweeps of one coordinate at a time, three points each: slow, certain.
  for (int sweep = 0; sweep < 3000; ++sweep) {
    for (std::size_t i = 1; i <= n; ++i) {
      double first = 0.0, second = 0.0;
      for (const std::size_t cell : {i - 1, i}) {
        if (cell >= n) continue;
        const double s = std::sin((static_cast<double>(cell) + 0.5) * h), d = (r[cell + 1] - r[cell]) / h;
        const double q = 0.5 * (r[cell + 1] + r[cell]) / s, of_d = cell < i ? 1.0 / h : -1.0 / h, of_q = 0.5 / s;
        first += ((d - std::pow(d, -3)) * of_d + (q - std::pow(q, -3)) * of_q) * s * h;
        second += ((1.0 + 3.0 * std::pow(d, -4)) * of_d * of_d + (1.0 + 3.0 * std::pow(q, -4)) * of_q * of_q) * s * h;
      }
      r[i] -= 1.95 * first / second;  // over-relaxed (Young 1954)
    }
  }
  return energy(r) / (1.0 - std::cos(cap));
}

TEST(FlattenPatch, ReachesTheLeastEnergyOfASphericalCap) {
  constexpr double kCap = 0.9;  // rad: over half of a hemisphere
  // Rings about the pole.
  TriangleMesh mesh;
  mesh.vertices_m.push_back({0, 0, 1});
  constexpr int kRings = 30, kRound = 96;
  for (int ring = 1; ring <= kRings; ++ring) {
    for (int k = 0; k < kRound; ++k) {
      const double phi = kCap * ring / kRings, angle = 2.0 * pi * (k + 0.5 * (ring % 2)) / kRound;
      mesh.vertices_m.push_back({std::sin(phi) * std::cos(angle), std::sin(phi) * std::sin(angle), std::cos(phi)});
    }
  }
  const auto at = [](int ring, int k) {
    return static_cast<std::uint32_t>(1 + (ring - 1) * kRound + (k + kRound) % kRound);
  };
  for (int k = 0; k < kRound; ++k) mesh.triangles.push_back({0, at(1, k), at(1, k + 1)});
  for (int ring = 1; ring < kRings; ++ring) {
    const int shift = ring % 2;  // odd rings are turned by half a step
    for (int k = 0; k < kRound; ++k) {
      mesh.triangles.push_back({at(ring, k), at(ring + 1, k + shift), at(ring, k + 1)});
      mesh.triangles.push_back({at(ring + 1, k + shift), at(ring + 1, k + 1 + shift), at(ring, k + 1)});
    }
  }
  const FlatPatch flat = flatten_patch(whole(mesh));
  EXPECT_EQ(flat.flipped, 0u);
  const double least = least_energy_of_cap(kCap);
  // An isometry has 2; what is above it is the distortion. Facets of 2 degrees are flatter than the sphere.
  EXPECT_GT(least - 2.0, 1e-3);
  EXPECT_NEAR((flat.energy - 2.0) / (least - 2.0), 1.0, 0.02);
  // Nothing is lost against the angle-preserving or area-preserving maps: r = 2 tan(φ/2), r = 2 sin(φ/2).
  EXPECT_GT(flat.stretch_min, 0.85);
  EXPECT_LT(flat.stretch_max, 1.15);
}

TEST(FlattenPatch, TurnsNothingOverOnARoughPatch) {
  // Relief of 0.8 mm with waves of 4 mm: slopes beyond 1.
  const SurfacePatch patch = whole(grid_mesh(40, 40, [](double i, double j) {
    return Vector3d(0.5e-3 * i, 0.5e-3 * j, 0.8e-3 * std::sin(0.8 * i) * std::sin(0.75 * j));
  }));
  const FlatPatch flat = flatten_patch(patch);
  EXPECT_EQ(flat.flipped, 0u);
  EXPECT_TRUE(flat.converged);
  EXPECT_GT(flat.stretch_min, 0.2);
}

// The same mesh at another size: the same map, scaled.
TEST(FlattenPatch, IsFreeOfScale) {
  const auto bowl = [](double size) {
    return whole(grid_mesh(12, 12, [size](double i, double j) {
      return Vector3d(size * Vector3d(i, j, 0.02 * (i - 6) * (i - 6) + 0.03 * (j - 5) * (j - 5)));
    }));
  };
  const FlatPatch one = flatten_patch(bowl(1.0)), small = flatten_patch(bowl(1.0 / 1024.0));
  EXPECT_NEAR(one.energy, small.energy, 1e-9);
  EXPECT_NEAR((one.uv_m.back() - one.uv_m.front()).norm(), 1024.0 * (small.uv_m.back() - small.uv_m.front()).norm(),
              1e-4);
}

TEST(SurfacePatch, TakesTheTrianglesNearAndFillsTheGaps) {
  const TriangleMesh mesh = grid_mesh(60, 60, [](double i, double j) { return Vector3d(1e-3 * i, 1e-3 * j, 0.0); });
  const MeshSurface surface(mesh);
  // The sides of a square of 12 mm: its middle is enclosed.
  MeshPath path;
  const auto add = [&](double x_mm, double y_mm) {
    const Vector3d p(1e-3 * x_mm, 1e-3 * y_mm, 0.0);
    const ClosestPoint c = surface.bvh.closest_point(p);
    path.p_mesh_m.push_back(c.p_m);
    path.triangle.push_back(c.triangle);
    path.s_m.push_back(static_cast<double>(path.s_m.size()));
  };
  for (double u = 24; u <= 36; u += 0.5) add(u, 24);
  for (double u = 24; u <= 36; u += 0.5) add(36, u);
  for (double u = 36; u >= 24; u -= 0.5) add(u, 36);
  for (double u = 36; u >= 24; u -= 0.5) add(24, u);
  EXPECT_THAT([&] { find_surface_patch(surface, {}, {}); }, ThrowsMessage<Error>(HasSubstr("no stroke")));
  const SurfacePatch patch = find_surface_patch(surface, std::vector{path}, {1.0});
  // Between 1 mm inside of the sides: 10 mm squared, two triangles a mm², those cut by the reach left out.
  EXPECT_GT(patch.filled, 100u);
  EXPECT_LE(patch.filled, 200u);
  EXPECT_TRUE(patch.paths_apart.empty());
  for (const Vector3d& p : patch.mesh.vertices_m) {
    EXPECT_GE(p.x(), 0.021);
    EXPECT_LE(p.x(), 0.039);
  }
  // A path far from it on the same mesh is another piece.
  MeshPath far;
  far.p_mesh_m.push_back({0.058, 0.058, 0.0});
  far.triangle.push_back(surface.bvh.closest_point(far.p_mesh_m[0]).triangle);
  far.s_m.push_back(0.0);
  EXPECT_THAT(find_surface_patch(surface, std::vector{path, far}, {1.0}).paths_apart, testing::ElementsAre(1u));
}

TEST(SurfacePatch, RefusesAStrokeRoundATube) {
  constexpr int kRound = 40;
  TriangleMesh mesh;
  for (int j = 0; j <= 60; ++j) {
    for (int i = 0; i < kRound; ++i) {
      const double angle = 2.0 * pi * i / kRound;
      mesh.vertices_m.push_back({0.01 * std::cos(angle), 0.01 * std::sin(angle), 1e-3 * j});
    }
  }
  for (int j = 0; j < 60; ++j) {
    for (int i = 0; i < kRound; ++i) {
      const auto a = static_cast<std::uint32_t>(j * kRound + i),
                 b = static_cast<std::uint32_t>(j * kRound + (i + 1) % kRound);
      mesh.triangles.push_back({a, b, b + kRound});
      mesh.triangles.push_back({a, b + kRound, a + kRound});
    }
  }
  const MeshSurface surface(mesh);
  MeshPath path;
  for (int k = 0; k <= 200; ++k) {
    const double angle = 2.0 * pi * k / 200;
    const ClosestPoint c = surface.bvh.closest_point({0.01 * std::cos(angle), 0.01 * std::sin(angle), 0.03});
    path.p_mesh_m.push_back(c.p_m);
    path.triangle.push_back(c.triangle);
    path.s_m.push_back(k);
  }
  EXPECT_THAT([&] { find_surface_patch(surface, std::vector{path}, {2.0}); },
              ThrowsMessage<Error>(HasSubstr("not a disc")));
}

}  // namespace
}  // namespace asperity
