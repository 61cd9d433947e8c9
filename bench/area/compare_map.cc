#include "compare_map.h"

#include <cmath>

#include <Eigen/Dense>

#include "asperity/texture/evaluate_spline_grid.h"

namespace bench {

using Eigen::Vector2d;
using Eigen::Vector3d;

std::vector<MapPoint> map_points(const asperity::AreaResult& area, const asperity::TriangleMesh& mesh) {
  std::vector<MapPoint> out;
  const asperity::ArealTexture& texture = area.map.texture;
  const asperity::SplineGrid& g = texture.surface;
  for (std::size_t i = 0; i < area.triangle.size(); ++i) {
    const asperity::Triangle& v = mesh.triangles[area.triangle[i]];
    constexpr int kParts = 8;
    for (int a = 0; a < kParts; ++a) {
      for (int b = 0; a + b < kParts; ++b) {
        const Vector3d w((a + 1.0 / 3.0) / kParts, (b + 1.0 / 3.0) / kParts, 0.0);
        const Vector3d weight(w[0], w[1], 1.0 - w[0] - w[1]);
        MapPoint point;
        point.p_mesh_m.setZero();
        Vector2d xy_m = Vector2d::Zero();
        for (int c = 0; c < 3; ++c) {
          const auto corner = static_cast<std::size_t>(c);
          point.p_mesh_m += weight[c] * mesh.vertices_m[v[corner]];
          xy_m += 1e-3 * weight[c] * area.coordinates[i].xy_mm[corner];
        }
        const double u = std::round((xy_m.x() - g.origin_x_m) / g.spacing_x_m),
                     t = std::round((xy_m.y() - g.origin_y_m) / g.spacing_y_m);
        if (u < 0 || t < 0 || u >= static_cast<double>(g.columns) || t >= static_cast<double>(g.rows)) continue;
        const std::size_t at = static_cast<std::size_t>(t) * g.columns + static_cast<std::size_t>(u);
        point.height_m = asperity::evaluate_height(g, xy_m.x(), xy_m.y()).height_m;
        point.sigma_m = texture.sigma_m[at];
        point.covered = texture.supported[at] != 0;
        out.push_back(point);
      }
    }
  }
  return out;
}

Comparison compare(const std::vector<MapPoint>& points, const UnderTip& truth, const Vector2d& shift_m) {
  std::vector<const MapPoint*> used;
  for (const MapPoint& p : points)
    if (p.covered) used.push_back(&p);
  const auto n = static_cast<Eigen::Index>(used.size());
  Eigen::MatrixXd basis(n, 6);
  Eigen::VectorXd error(n), z(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const MapPoint& p = *used[static_cast<std::size_t>(i)];
    const double x = p.p_mesh_m.x(), y = p.p_mesh_m.y(), u = 100.0 * x, v = 100.0 * y;
    basis.row(i) << 1.0, u, v, u * u, u * v, v * v;
    z[i] = truth.at(x + shift_m.x(), y + shift_m.y());
    error[i] = p.height_m - z[i];
  }
  error -= basis * (basis.transpose() * basis).ldlt().solve(basis.transpose() * error);
  Eigen::VectorXd map = error + z;
  Comparison out;
  double ratio = 0.0, sigma = 0.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double s = used[static_cast<std::size_t>(i)]->sigma_m;
    ratio += std::pow(error[i] / s, 2);
    sigma += s * s;
  }
  const auto count = static_cast<double>(n);
  out.error_m = std::sqrt(error.squaredNorm() / count);
  out.ratio = std::sqrt(ratio / count);
  out.sigma_m = std::sqrt(sigma / count);
  z.array() -= z.mean();
  map.array() -= map.mean();
  out.truth_m = std::sqrt(z.squaredNorm() / count);
  out.correlation = map.dot(z) / (map.norm() * z.norm());
  return out;
}

}  // namespace bench
