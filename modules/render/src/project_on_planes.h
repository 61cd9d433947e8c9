#pragma once

#include <array>

#include <Eigen/Core>

namespace asperity {

// The half space of the points x with normal · x >= offset_m; the normal is a unit vector.
struct HalfSpace {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double offset_m = 0.0;

  double depth_m(const Eigen::Vector3d& p_m) const { return offset_m - normal.dot(p_m); }  // positive outside
};

// The point of an intersection of half spaces that is nearest to a goal, found by the dual active-set method of
// Goldfarb and Idnani (1983): the half spaces are told one after another, those that the point violates, in any order;
// the point then moves on and is the nearest one of those told so far that still matter. In three dimensions at most
// three of them are active; the products that the method needs are written out for none to three.
//
// With x - goal = sum of m_i n_i over the active planes, m_i >= 0, a violated plane n joins by a step t along
// z = n - sum r_i n_i, the part of n across the active normals: m_i falls by t r_i, and t is the smaller of what the
// plane needs, violation / |z|², and of what the first multiplier allows, m_i / r_i, whose plane is then left out and
// the rest of the step is taken without it. Normals within kParallel (sine) of the span of the active ones count
// as being in it: nearly parallel planes thus replace each other and never form an acute corner.
class PlaneProjection {
 public:
  struct Active {
    HalfSpace plane;
    double multiplier_m = 0.0;
    int tag = 0;  // the caller's
  };
  static constexpr double kParallel = 0x1p-26;

  explicit PlaneProjection(const Eigen::Vector3d& goal_m) : x_m_(goal_m) {}

  // False if no point is in this half space and the active ones; nothing is changed in that case but multipliers.
  bool add(const HalfSpace& plane, int tag) noexcept;

  const Eigen::Vector3d& x_m() const { return x_m_; }
  int size() const { return size_; }
  const Active& active(int i) const { return active_[static_cast<std::size_t>(i)]; }

 private:
  void split(const Eigen::Vector3d& normal, Eigen::Vector3d& across, std::array<double, 3>& shares) const noexcept;
  void drop(int i) noexcept;

  Eigen::Vector3d x_m_;
  int size_ = 0;
  std::array<Active, 3> active_;
};

}  // namespace asperity
