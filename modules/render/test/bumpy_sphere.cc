#include <cmath>
#include <map>
#include <utility>

#include "asperity/testkit/shape_meshes.h"
#include "scenes.h"

namespace asperity::testing_render {

using Eigen::Vector3d;

TriangleMesh bumpy_sphere(double radius_m, int cuts, double height) {
  const TriangleMesh base = testkit::sphere_mesh(1.0, 0);
  TriangleMesh out;
  std::map<std::array<long long, 3>, std::uint32_t> index;
  const auto vertex = [&](const Vector3d& on_face) {
    const std::array<long long, 3> key{std::llround(on_face.x() * 1e9), std::llround(on_face.y() * 1e9),
                                       std::llround(on_face.z() * 1e9)};
    const auto [place, is_new] = index.try_emplace(key, static_cast<std::uint32_t>(out.vertices_m.size()));
    if (is_new) {
      const Vector3d d = on_face.normalized();
      const double wave = std::sin(23.0 * d.x() + 1.0) * std::sin(19.0 * d.y() + 2.0) +
                          0.6 * std::sin(41.0 * d.z() + 13.0 * d.x()) * std::sin(37.0 * d.y());
      out.vertices_m.push_back(radius_m * (1.0 + height * wave) * d);
    }
    return place->second;
  };
  for (const Triangle& t : base.triangles) {
    const Vector3d a = base.vertices_m[t[0]], u = (base.vertices_m[t[1]] - a) / cuts,
                   w = (base.vertices_m[t[2]] - a) / cuts;
    const auto at_grid = [&](int i, int j) { return vertex(a + i * u + j * w); };
    for (int i = 0; i < cuts; ++i) {
      for (int j = 0; i + j < cuts; ++j) {
        out.triangles.push_back({at_grid(i, j), at_grid(i + 1, j), at_grid(i, j + 1)});
        if (i + j + 1 < cuts) out.triangles.push_back({at_grid(i + 1, j), at_grid(i + 1, j + 1), at_grid(i, j + 1)});
      }
    }
  }
  return out;
}

}  // namespace asperity::testing_render
