#include "rough_patch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "asperity/base/random.h"

namespace bench {

using Eigen::Vector3d;

Relief::Relief(std::uint64_t seed, double rms_m) {
  asperity::Random random(seed, 7);
  constexpr int kWaves = 200;
  for (int i = 0; i < kWaves; ++i) {
    const double f = 250.0 * std::pow(4.0, random.uniform(0.0, 1.0)),
                 angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    waves_.push_back({2.0 * std::numbers::pi * f * std::cos(angle), 2.0 * std::numbers::pi * f * std::sin(angle),
                      random.uniform(0.0, 2.0 * std::numbers::pi)});
  }
  height_m_ = rms_m * std::sqrt(2.0 / kWaves);
}

double Relief::at(double x_m, double y_m) const {
  double out = 0.0;
  for (const Vector3d& w : waves_) out += height_m_ * std::cos(w.x() * x_m + w.y() * y_m + w.z());
  return out;
}

asperity::TriangleMesh rough_top(const asperity::MeshSurface& pebble, const Relief& relief, double half_m) {
  asperity::TriangleMesh out;
  constexpr double kSpacing_m = 0.1e-3;
  const int n = static_cast<int>(std::ceil(2.0 * half_m / kSpacing_m));
  for (int r = 0; r <= n; ++r) {
    for (int c = 0; c <= n; ++c) {
      const double x = -half_m + c * kSpacing_m, y = -half_m + r * kSpacing_m;
      const asperity::RayHit hit = pebble.bvh.cast_ray({x, y, 0.1}, {0.0, 0.0, -1.0});
      const auto& normals = pebble.normals[hit.triangle];
      const Vector3d n_mesh =
          (hit.barycentric[0] * normals[0] + hit.barycentric[1] * normals[1] + hit.barycentric[2] * normals[2])
              .normalized();
      out.vertices_m.push_back(Vector3d(x, y, 0.1 - hit.t) + relief.at(x, y) * n_mesh);
    }
  }
  for (int r = 0; r < n; ++r) {
    for (int c = 0; c < n; ++c) {
      const auto a = static_cast<std::uint32_t>(r * (n + 1) + c), up = a + static_cast<std::uint32_t>(n) + 1;
      out.triangles.push_back({a, a + 1, up + 1});
      out.triangles.push_back({a, up + 1, up});
    }
  }
  return out;
}

UnderTip::UnderTip(const Relief& relief, double radius_m, double half_m) : half_m_(half_m) {
  n_ = static_cast<int>(std::ceil(2.0 * half_m / kSpacing_m)) + 1;
  std::vector<double> z(static_cast<std::size_t>(n_ * n_));
  for (int r = 0; r < n_; ++r)
    for (int c = 0; c < n_; ++c) z[place(r, c)] = relief.at(-half_m + c * kSpacing_m, -half_m + r * kSpacing_m);
  height_m_ = z;
  const int reach = std::min(static_cast<int>(radius_m / kSpacing_m), 12);  // slopes are below 0.6
  for (int dr = -reach; dr <= reach; ++dr) {
    for (int dc = -reach; dc <= reach; ++dc) {
      const double u2 = (dr * dr + dc * dc) * kSpacing_m * kSpacing_m;
      if (u2 > radius_m * radius_m) continue;
      const double ball = std::sqrt(radius_m * radius_m - u2) - radius_m;
      for (int r = std::max(0, -dr); r < std::min(n_, n_ - dr); ++r)
        for (int c = std::max(0, -dc); c < std::min(n_, n_ - dc); ++c)
          height_m_[place(r, c)] = std::max(height_m_[place(r, c)], z[place(r + dr, c + dc)] + ball);
    }
  }
}

double UnderTip::at(double x_m, double y_m) const {
  const double u = std::clamp((x_m + half_m_) / kSpacing_m, 0.0, n_ - 1.001);
  const double v = std::clamp((y_m + half_m_) / kSpacing_m, 0.0, n_ - 1.001);
  const int c = static_cast<int>(u), r = static_cast<int>(v);
  const double a = u - c, b = v - r;
  return (1 - b) * ((1 - a) * height_m_[place(r, c)] + a * height_m_[place(r, c + 1)]) +
         b * ((1 - a) * height_m_[place(r + 1, c)] + a * height_m_[place(r + 1, c + 1)]);
}

}  // namespace bench
