#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <mutex>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "asperity/base/progress.h"
#include "asperity/registration/registration_surface.h"

namespace asperity::registration {

// Signed distances from a mesh at the nodes of a cubic grid about it, in float: what a search over thousands of poses
// asks. Between nodes they are interpolated linearly in each coordinate, to about a twentieth of a cell near a smooth
// surface; beyond the grid the way to it is added.
class DistanceGrid {
 public:
  // About `cells` cells along the mesh's longest side.
  DistanceGrid(const RegistrationSurface& surface, int cells, const Observer& observer);

  struct Sample {
    float distance_m = 0.0F;
    Eigen::Vector3f gradient = Eigen::Vector3f::Zero();
  };
  Sample at(const Eigen::Vector3f& p_m) const {
    const Eigen::Vector3f grid = (p_m - origin_m_) * per_cell_;
    const Eigen::Vector3f inside = grid.cwiseMax(Eigen::Vector3f::Zero()).cwiseMin(last_);
    const auto x = static_cast<std::size_t>(inside.x()), y = static_cast<std::size_t>(inside.y()),
               z = static_cast<std::size_t>(inside.z());
    const float u = inside.x() - static_cast<float>(x), v = inside.y() - static_cast<float>(y),
                w = inside.z() - static_cast<float>(z);
    const float* c = &distance_m_[(z * count_[1] + y) * count_[0] + x];
    const std::size_t up = count_[0], back = count_[0] * count_[1];
    const float c00 = c[0] + u * (c[1] - c[0]), c10 = c[up] + u * (c[up + 1] - c[up]);
    const float c01 = c[back] + u * (c[back + 1] - c[back]), c11 = c[back + up] + u * (c[back + up + 1] - c[back + up]);
    const float c0 = c00 + v * (c10 - c00), c1 = c01 + v * (c11 - c01);
    const float along_x = (1 - w) * ((1 - v) * (c[1] - c[0]) + v * (c[up + 1] - c[up])) +
                          w * ((1 - v) * (c[back + 1] - c[back]) + v * (c[back + up + 1] - c[back + up]));
    Sample out;
    out.distance_m = c0 + w * (c1 - c0);
    out.gradient = per_cell_ * Eigen::Vector3f(along_x, (1 - w) * (c10 - c00) + w * (c11 - c01), c1 - c0);
    const Eigen::Vector3f beyond = grid - inside;
    const float square = beyond.squaredNorm();
    if (square > 0.0F) {
      const float cells = std::sqrt(square);
      out.distance_m += cells / per_cell_;
      out.gradient = beyond / cells;
    }
    return out;
  }

  double size_m() const { return size_m_; }  // the diagonal of the mesh's box

 private:
  Eigen::Vector3f origin_m_, last_;
  float per_cell_ = 1.0F;
  std::array<std::size_t, 3> count_{};
  std::vector<float> distance_m_;
  double size_m_ = 0.0;
};

// The grid of a mesh, made when it is first asked for. A search that is cancelled while it is made leaves none.
class SearchGrid {
 public:
  const DistanceGrid& of(const RegistrationSurface& surface, const Observer& observer) {
    constexpr int kCells = 56;
    std::call_once(once_, [&] { grid_.emplace(surface, kCells, observer); });
    return *grid_;
  }

 private:
  std::once_flag once_;
  std::optional<DistanceGrid> grid_;
};

}  // namespace asperity::registration
