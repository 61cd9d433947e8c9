#include "distance_grid.h"

#include <algorithm>

#include <Eigen/Geometry>

namespace asperity::registration {

DistanceGrid::DistanceGrid(const RegistrationSurface& surface, int cells, const Observer& observer) {
  Eigen::AlignedBox3d box;
  for (const Triangle& triangle : surface.mesh->triangles) {
    for (const std::uint32_t corner : triangle) box.extend(surface.mesh->vertices_m[corner]);
  }
  size_m_ = box.diagonal().norm();
  const double cell_m = box.sizes().maxCoeff() / cells;
  constexpr double kMargin = 0.08;  // of the mesh's diagonal on each side
  const Eigen::Vector3d least_m = box.min().array() - kMargin * size_m_;
  for (int k = 0; k < 3; ++k) {
    count_[static_cast<std::size_t>(k)] =
        static_cast<std::size_t>(std::ceil((box.sizes()[k] + 2.0 * kMargin * size_m_) / cell_m)) + 2;
  }
  origin_m_ = least_m.cast<float>();
  per_cell_ = static_cast<float>(1.0 / cell_m);
  for (int k = 0; k < 3; ++k) last_[k] = static_cast<float>(count_[static_cast<std::size_t>(k)]) - 1.001F;
  distance_m_.resize(count_[0] * count_[1] * count_[2]);
  std::size_t at = 0;
  for (std::size_t z = 0; z < count_[2]; ++z) {
    observer.update("search", 0.3 * static_cast<double>(z) / static_cast<double>(count_[2]));
    for (std::size_t y = 0; y < count_[1]; ++y) {
      ClosestPoint closest;
      for (std::size_t x = 0; x < count_[0]; ++x, ++at) {
        const Eigen::Vector3d p_m =
            least_m + cell_m * Eigen::Vector3d(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z));
        closest = closest.found() ? surface.bvh->closest_point(p_m, closest) : surface.bvh->closest_point(p_m);
        const RegistrationFacet& facet = surface.facets[closest.triangle];
        const Eigen::Vector3d b = closest.barycentric;
        const Eigen::Vector3d n = b[0] * facet.corner_normal[0].cast<double>() +
                                  b[1] * facet.corner_normal[1].cast<double>() +
                                  b[2] * facet.corner_normal[2].cast<double>() + 1e-3 * facet.normal.cast<double>();
        distance_m_[at] = static_cast<float>(std::copysign(closest.distance_m, (p_m - closest.p_m).dot(n)));
      }
    }
  }
}

}  // namespace asperity::registration
