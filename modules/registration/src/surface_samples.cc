#include "surface_samples.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/Geometry>

namespace asperity::registration {

std::vector<SurfaceSample> spread_over(const TriangleMesh& mesh, int count) {
  std::vector<double> area(mesh.triangles.size());
  double total = 0.0;
  for (std::size_t t = 0; t < area.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    total += (mesh.vertices_m[b] - mesh.vertices_m[a]).cross(mesh.vertices_m[c] - mesh.vertices_m[a]).norm();
    area[t] = total;
  }
  std::vector<SurfaceSample> out;
  for (int i = 0; i < count; ++i) {
    // Triangles are listed by neighbourhood in most meshes: equal steps of the summed area spread over it.
    const double at = total * (i + 0.5) / count;
    const auto found = std::min<std::ptrdiff_t>(std::lower_bound(area.begin(), area.end(), at) - area.begin(),
                                                static_cast<std::ptrdiff_t>(area.size()) - 1);
    const auto t = static_cast<std::size_t>(found);
    const auto& [a, b, c] = mesh.triangles[t];
    const Eigen::Vector3d& p = mesh.vertices_m[a];
    const double before = t == 0 ? 0.0 : area[t - 1];
    // Large triangles hold many of them: a sequence of low discrepancy, folded into the triangle (Roberts 2018).
    double u = std::fmod(0.5 + 0.7548776662466927 * (i + 1), 1.0),
           v = std::fmod(0.5 + 0.5698402909980532 * (i + 1), 1.0);
    if (u + v > 1.0) {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    if (!(area[t] > before)) continue;
    out.push_back({p + u * (mesh.vertices_m[b] - p) + v * (mesh.vertices_m[c] - p),
                   (mesh.vertices_m[b] - p).cross(mesh.vertices_m[c] - p).normalized()});
  }
  return out;
}

}  // namespace asperity::registration
