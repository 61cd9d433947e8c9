#include "project_on_planes.h"

#include <Eigen/Geometry>

namespace asperity {

using Eigen::Vector3d;

// normal = across + sum of shares_i n_i, with `across` perpendicular to the active normals.
void PlaneProjection::split(const Vector3d& normal, Vector3d& across, std::array<double, 3>& shares) const noexcept {
  if (size_ == 0) {
    across = normal;
    return;
  }
  const Vector3d& n0 = active_[0].plane.normal;
  if (size_ == 1) {
    shares[0] = n0.dot(normal);
    across = normal - shares[0] * n0;
    return;
  }
  const Vector3d& n1 = active_[1].plane.normal;
  const Vector3d m = n0.cross(n1);
  if (size_ == 2) {
    const double square = m.squaredNorm();
    shares[0] = n1.cross(m).dot(normal) / square;
    shares[1] = m.cross(n0).dot(normal) / square;
    across = (m.dot(normal) / square) * m;
    return;
  }
  const Vector3d& n2 = active_[2].plane.normal;
  const double volume = m.dot(n2);
  shares[0] = n1.cross(n2).dot(normal) / volume;
  shares[1] = n2.cross(n0).dot(normal) / volume;
  shares[2] = m.dot(normal) / volume;
  across.setZero();
}

void PlaneProjection::drop(int i) noexcept {
  for (int k = i + 1; k < size_; ++k) active_[static_cast<std::size_t>(k - 1)] = active_[static_cast<std::size_t>(k)];
  --size_;
}

bool PlaneProjection::add(const HalfSpace& plane, int tag) noexcept {
  double multiplier_m = 0.0;
  for (;;) {
    const double violation_m = plane.depth_m(x_m_);
    if (!(violation_m > 0.0) && multiplier_m == 0.0) return true;
    Vector3d across;
    std::array<double, 3> shares{};
    split(plane.normal, across, shares);
    const double square = across.squaredNorm();
    const bool blocked = size_ == 3 || square <= kParallel * kParallel;

    int first = -1;
    double dual_m = 0.0;
    for (int i = 0; i < size_; ++i) {
      const double share = shares[static_cast<std::size_t>(i)];
      if (!(share > 0.0)) continue;
      const double t = active_[static_cast<std::size_t>(i)].multiplier_m / share;
      if (first < 0 || t < dual_m) first = i, dual_m = t;
    }
    if (blocked && first < 0) return false;
    const double primal_m = blocked ? 0.0 : (violation_m > 0.0 ? violation_m : 0.0) / square;
    const bool full = !blocked && (first < 0 || primal_m <= dual_m);
    const double step_m = full ? primal_m : dual_m;
    if (!blocked) x_m_ += step_m * across;
    for (int i = 0; i < size_; ++i) {
      double& m = active_[static_cast<std::size_t>(i)].multiplier_m;
      m -= step_m * shares[static_cast<std::size_t>(i)];
      if (m < 0.0) m = 0.0;
    }
    multiplier_m += step_m;
    if (full) {
      active_[static_cast<std::size_t>(size_++)] = {plane, multiplier_m, tag};
      return true;
    }
    drop(first);
  }
}

}  // namespace asperity
