#include "asperity/simulation/make_pebble.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "asperity/base/error.h"
#include "asperity/base/random.h"

namespace asperity {

namespace {

constexpr int kWaves = 24;
constexpr double kGoldenRatio = std::numbers::phi;

struct Wave {
  Eigen::Vector3d k_per_m;
  double phase = 0.0;
};

std::vector<Wave> make_waves(const PebbleConfig& config) {
  Random random(static_cast<std::uint64_t>(config.seed));
  std::vector<Wave> out;
  for (int i = 0; i < kWaves; ++i) {
    const double x = random.normal(), y = random.normal(), z = random.normal();
    const Eigen::Vector3d direction = Eigen::Vector3d(x, y, z).normalized();
    const double wavelength_m = config.bump_length_m * random.uniform(1.0, 2.0);
    const double phase = random.uniform(0.0, 2.0 * std::numbers::pi);
    out.push_back({2.0 * std::numbers::pi / wavelength_m * direction, phase});
  }
  return out;
}

// Corners and faces of the unit icosahedron, counter-clockwise seen from outside.
TriangleMesh icosahedron() {
  TriangleMesh out;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-kGoldenRatio, kGoldenRatio}) {
      for (const Eigen::Vector3d& p : {Eigen::Vector3d(0, a, b), Eigen::Vector3d(a, b, 0), Eigen::Vector3d(b, 0, a)}) {
        out.vertices_m.push_back(p.normalized());
      }
    }
  }
  // Neighbours are 2 / sqrt(1 + φ²) = 1.05 apart, all others at least 1.7.
  const auto near = [&](std::uint32_t i, std::uint32_t j) {
    return (out.vertices_m[i] - out.vertices_m[j]).norm() < 1.3;
  };
  for (std::uint32_t i = 0; i < 12; ++i) {
    for (std::uint32_t j = i + 1; j < 12; ++j) {
      for (std::uint32_t k = j + 1; k < 12; ++k) {
        if (!near(i, j) || !near(j, k) || !near(i, k)) continue;
        const auto& v = out.vertices_m;
        const bool outward = (v[j] - v[i]).cross(v[k] - v[i]).dot(v[i]) > 0.0;
        out.triangles.push_back(outward ? Triangle{i, j, k} : Triangle{i, k, j});
      }
    }
  }
  return out;
}

// Each face cut into n² triangles; points on its edges are shared with the neighbours by their place on the edge.
TriangleMesh subdivide_mesh(const TriangleMesh& coarse, int n) {
  TriangleMesh out;
  out.vertices_m = coarse.vertices_m;
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> on_edges;  // lower end, upper end, steps from the lower
  for (const Triangle& face : coarse.triangles) {
    std::map<std::pair<int, int>, std::uint32_t> inside;
    // The point (i, j) is corner 0 plus i/n of the way to corner 1 and j/n of that to corner 2.
    const auto point = [&](int i, int j) {
      const std::array<int, 3> weight{n - i - j, i, j};
      const auto make = [&] {
        Eigen::Vector3d p = Eigen::Vector3d::Zero();
        for (std::size_t c = 0; c < 3; ++c) p += static_cast<double>(weight[c]) / n * coarse.vertices_m[face[c]];
        out.vertices_m.push_back(p.normalized());
        return static_cast<std::uint32_t>(out.vertices_m.size() - 1);
      };
      for (std::size_t c = 0; c < 3; ++c) {
        if (weight[c] == n) return face[c];
      }
      for (std::size_t c = 0; c < 3; ++c) {
        if (weight[c] != 0) continue;
        std::size_t low = (c + 1) % 3, high = (c + 2) % 3;
        if (face[low] > face[high]) std::swap(low, high);
        const std::array<std::uint32_t, 3> key{face[low], face[high], static_cast<std::uint32_t>(weight[high])};
        const auto found = on_edges.find(key);
        return found != on_edges.end() ? found->second : on_edges[key] = make();
      }
      const auto found = inside.find({i, j});
      return found != inside.end() ? found->second : inside[{i, j}] = make();
    };
    for (int i = 0; i < n; ++i) {
      for (int j = 0; i + j < n; ++j) {
        out.triangles.push_back({point(i, j), point(i + 1, j), point(i, j + 1)});
        if (i + j + 1 < n) out.triangles.push_back({point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)});
      }
    }
  }
  return out;
}

}  // namespace

TriangleMesh make_pebble(const PebbleConfig& config) {
  constexpr double kMostTriangles = 2e6;
  const Eigen::Vector3d axes_m(config.semi_axes_m[0], config.semi_axes_m[1], config.semi_axes_m[2]);
  if (config.bump_m > 0.1 * axes_m.minCoeff()) {
    throw Error(fmt::format("pebble.bump_m: {} m is more than a tenth of the least semi-axis", config.bump_m));
  }
  // An ellipsoid's area to 1 % (Thomsen 2004); √3/4 of an edge's square is a triangle's.
  constexpr double kPower = 1.6075;
  const Eigen::Array3d p = axes_m.array().pow(kPower);
  const double mean_m2 = std::pow((p[0] * p[1] + p[1] * p[2] + p[0] * p[2]) / 3.0, 1.0 / kPower);
  const double triangles =
      4.0 * std::numbers::pi * mean_m2 / (0.25 * std::numbers::sqrt3 * config.facet_m * config.facet_m);
  if (!(triangles <= kMostTriangles)) {
    throw Error(fmt::format("pebble.facet_m: {} m would give {:.3g} triangles", config.facet_m, triangles));
  }
  const int n = std::max(1, static_cast<int>(std::lround(std::sqrt(triangles / 20.0))));
  TriangleMesh out = subdivide_mesh(icosahedron(), n);

  const std::vector<Wave> waves = make_waves(config);
  const double amplitude_m = config.bump_m * std::sqrt(2.0 / kWaves);
  for (Eigen::Vector3d& vertex : out.vertices_m) {
    const Eigen::Vector3d radial = vertex;
    vertex = axes_m.cwiseProduct(radial);
    double bump_m = 0.0;
    for (const Wave& wave : waves) bump_m += amplitude_m * std::cos(wave.k_per_m.dot(vertex) + wave.phase);
    vertex += bump_m * radial;
  }
  return out;
}

}  // namespace asperity
