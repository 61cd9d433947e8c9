#include "asperity/testkit/bumpy_sphere.h"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "asperity/base/random.h"
#include "asperity/geometry/mesh_adjacency.h"
#include "asperity/testkit/shape_meshes.h"

namespace asperity::testkit {
namespace {

using Eigen::Vector3d;

struct Wave {
  Vector3d k;  // phase a unit of direction
  double phase;
};

std::vector<Wave> make_waves(const BumpySphere& shape) {
  Random random(shape.seed);
  std::vector<Wave> waves;
  for (int w = 0; w < shape.waves; ++w) {
    const Vector3d direction = Vector3d(random.normal(), random.normal(), random.normal()).normalized();
    const double wavelength_m = random.uniform(shape.shortest_wave_m, shape.longest_wave_m);
    waves.push_back({2.0 * std::numbers::pi * shape.radius_m / wavelength_m * direction,
                     random.uniform(0.0, 2.0 * std::numbers::pi)});
  }
  return waves;
}

}  // namespace

TriangleMesh bumpy_sphere_mesh(int frequency, const BumpySphere& shape) {
  const TriangleMesh icosahedron = sphere_mesh(1.0, 0);
  TriangleMesh mesh;
  const auto rows = static_cast<std::uint32_t>(frequency);
  for (const auto& [a, b, c] : icosahedron.triangles) {
    const Vector3d &p = icosahedron.vertices_m[a], &q = icosahedron.vertices_m[b], &r = icosahedron.vertices_m[c];
    const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
    // Row i has i + 1 points from edge pq to edge pr. The sum is taken in one order for all faces, so that
    // points of shared edges are equal to the last bit and can be welded.
    for (std::uint32_t i = 0; i <= rows; ++i) {
      for (std::uint32_t j = 0; j <= i; ++j) {
        struct Share {
          std::uint32_t vertex;
          double weight;
          const Vector3d* p;
        } shares[] = {{a, static_cast<double>(rows - i), &p},
                      {b, static_cast<double>(i - j), &q},
                      {c, static_cast<double>(j), &r}};
        if (shares[0].vertex > shares[1].vertex) std::swap(shares[0], shares[1]);
        if (shares[1].vertex > shares[2].vertex) std::swap(shares[1], shares[2]);
        if (shares[0].vertex > shares[1].vertex) std::swap(shares[0], shares[1]);
        Vector3d sum = Vector3d::Zero();
        for (const Share& share : shares) sum += share.weight * *share.p;
        mesh.vertices_m.push_back(sum.normalized());
      }
    }
    const auto at = [first](std::uint32_t i, std::uint32_t j) { return first + i * (i + 1) / 2 + j; };
    for (std::uint32_t i = 0; i < rows; ++i) {
      for (std::uint32_t j = 0; j <= i; ++j) {
        mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
        if (j < i) mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
  }
  mesh = weld_vertices(mesh);

  // Vertices that welding left unused would be outside every triangle's order in memory.
  constexpr std::uint32_t kUnused = 0xFFFFFFFFu;
  std::vector<std::uint32_t> place(mesh.vertices_m.size(), kUnused);
  std::vector<Vector3d> used;
  for (Triangle& t : mesh.triangles) {
    for (std::uint32_t& v : t) {
      if (place[v] == kUnused) {
        place[v] = static_cast<std::uint32_t>(used.size());
        used.push_back(mesh.vertices_m[v]);
      }
      v = place[v];
    }
  }

  const std::vector<Wave> waves = make_waves(shape);
  const double scale_m = shape.waves > 0 ? shape.rms_m * std::sqrt(2.0 / shape.waves) : 0.0;
  for (Vector3d& u : used) {
    double sum = 0.0;
    for (const Wave& wave : waves) sum += std::sin(wave.k.dot(u) + wave.phase);
    u *= shape.radius_m + scale_m * sum;
  }
  mesh.vertices_m = std::move(used);
  return mesh;
}

}  // namespace asperity::testkit
