#include "asperity/testkit/shape_meshes.h"

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "asperity/base/random.h"
#include "asperity/geometry/mesh_adjacency.h"

namespace asperity::testkit {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

struct Grid {
  std::vector<Vector2d> uv;  // within 0 and 1
  std::vector<Triangle> triangles;
};

Grid make_grid(int columns, int rows, double jitter, bool jitter_u, std::uint64_t seed) {
  Random random(seed);
  Grid grid;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      const double du = jitter_u && i > 0 && i < columns ? jitter * random.uniform(-1.0, 1.0) : 0.0;
      const double dv = j > 0 && j < rows ? jitter * random.uniform(-1.0, 1.0) : 0.0;
      grid.uv.push_back({(i + du) / columns, (j + dv) / rows});
    }
  }
  const auto at = [columns](int i, int j) { return static_cast<std::uint32_t>(j * (columns + 1) + i); };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const std::uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      if (random.chance(0.5)) {
        grid.triangles.push_back({a, b, c});
        grid.triangles.push_back({a, c, d});
      } else {
        grid.triangles.push_back({a, b, d});
        grid.triangles.push_back({b, c, d});
      }
    }
  }
  return grid;
}

}  // namespace

TriangleMesh plane_mesh(const Vector2d& size_m, int columns, int rows, double jitter, std::uint64_t seed) {
  const Grid grid = make_grid(columns, rows, jitter, true, seed);
  TriangleMesh mesh;
  for (const Vector2d& uv : grid.uv) mesh.vertices_m.push_back({uv.x() * size_m.x(), uv.y() * size_m.y(), 0.0});
  mesh.triangles = grid.triangles;
  return mesh;
}

TriangleMesh cylinder_mesh(double radius_m, double height_m, int around, int up, double sweep_rad, std::uint64_t seed) {
  const Grid grid = make_grid(around, up, 0.0, false, seed);
  const bool closed = sweep_rad >= 2.0 * std::numbers::pi;
  TriangleMesh mesh;
  for (const Vector2d& uv : grid.uv) {
    const double angle = closed && uv.x() >= 1.0 ? 0.0 : uv.x() * sweep_rad;
    mesh.vertices_m.push_back({radius_m * std::cos(angle), radius_m * std::sin(angle), uv.y() * height_m});
  }
  mesh.triangles = grid.triangles;
  return weld_vertices(mesh);
}

TriangleMesh sphere_mesh(double radius_m, int levels) {
  const double g = 0.5 * (1.0 + std::sqrt(5.0));
  TriangleMesh mesh{{{-1, g, 0},
                     {1, g, 0},
                     {-1, -g, 0},
                     {1, -g, 0},
                     {0, -1, g},
                     {0, 1, g},
                     {0, -1, -g},
                     {0, 1, -g},
                     {g, 0, -1},
                     {g, 0, 1},
                     {-g, 0, -1},
                     {-g, 0, 1}},
                    {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                     {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                     {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [place, is_new] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.vertices_m.size()));
      if (is_new) mesh.vertices_m.push_back(0.5 * (mesh.vertices_m[a] + mesh.vertices_m[b]));
      return place->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
    for (Vector3d& p : mesh.vertices_m) p.normalize();
  }
  for (Vector3d& p : mesh.vertices_m) p *= radius_m / p.norm();
  return mesh;
}

TriangleMesh box_mesh(const Vector3d& size_m, int cells) {
  TriangleMesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool far : {false, true}) {
      const Grid grid = make_grid(cells, cells, 0.0, false, static_cast<std::uint64_t>(2 * axis + far));
      const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
      for (const Vector2d& uv : grid.uv) {
        Vector3d p;
        p[axis] = far ? 1.0 : 0.0;
        p[(axis + 1) % 3] = uv.x();
        p[(axis + 2) % 3] = uv.y();
        mesh.vertices_m.push_back(p.cwiseProduct(size_m));
      }
      for (const auto& [a, b, c] : grid.triangles) {
        if (far) {
          mesh.triangles.push_back({first + a, first + b, first + c});
        } else {
          mesh.triangles.push_back({first + a, first + c, first + b});
        }
      }
    }
  }
  return weld_vertices(mesh);
}

}  // namespace asperity::testkit
