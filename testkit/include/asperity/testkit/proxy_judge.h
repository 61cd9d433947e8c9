#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/mesh_bvh.h"
#include "asperity/geometry/triangle_mesh.h"
#include "asperity/testkit/ball_rest.h"
#include "asperity/testkit/tracked_minimum.h"

namespace asperity::testkit {

// What a proxy did over a path. "Pressed" ticks are those with the device inside the surface, for a ball inside the
// surface at the distance of its radius.
struct ProxyStatistics {
  std::size_t ticks = 0;
  std::size_t pressed = 0;
  std::size_t stuck_events = 0;  // |proxy − device| came to exceed 1.5 depths
  std::size_t stuck_ticks = 0;   // and while it did
  double largest_lag_m = 0.0;
  std::size_t pop_throughs = 0;  // the proxy came to be inside the surface by more than 2e-5 of its radius
  double deepest_proxy_m = 0.0;  // inside the surface, for a ball inside that at its radius
  std::size_t frozen_ticks = 0;  // the proxy moved by less than a thousandth of the true minimum's step
  double rms_error_m = 0.0;      // of proxy − true minimum
  double largest_error_m = 0.0;
  std::size_t other_basin = 0;  // ticks at a local minimum other than the tracked one
  double rms_local_m = 0.0;     // of proxy − the local minimum that the proxy itself descends to
  double largest_local_m = 0.0;
  double largest_step_excess_m = 0.0;  // of the proxy's step over the true minimum's, in one basin
  double largest_true_lag_m = 0.0;     // |true minimum − device|
};

struct ProxyJudgeConfig {
  double tip_radius_m = 0.0;
  double depth_m = 1e-3;  // to which the device is pressed in
  bool minimum = true;    // compare with the exact minimum: without friction
};

// Judges a proxy on a star-shaped closed mesh about the origin, tick by tick, by TrackedMinimum for a point and by
// BallRest for a ball.
class ProxyJudge {
 public:
  // Keeps references.
  ProxyJudge(const TriangleMesh& mesh, const MeshBvh& bvh, const ProxyJudgeConfig& config);

  void tick(const Eigen::Vector3d& device_m, const Eigen::Vector3d& proxy_m);

  ProxyStatistics statistics() const;
  const Eigen::Vector3d& true_m() const { return true_m_; }  // the minimum of the last tick
  double last_error_m() const { return last_error_m_; }
  double last_step_excess_m() const { return last_step_excess_m_; }

 private:
  // How far a centre is inside the surface at the tip's radius; negative outside.
  double inside_m(const Eigen::Vector3d& centre_m);
  // The local minimum that a descent from `centre_m` leads to.
  Eigen::Vector3d minimum_from(const Eigen::Vector3d& centre_m, const Eigen::Vector3d& device_m);

  const MeshBvh& bvh_;
  ProxyJudgeConfig config_;
  TrackedMinimum point_, local_point_;
  BallRest ball_, local_ball_;
  ProxyStatistics sums_;
  Eigen::Vector3d device_m_, proxy_m_, true_m_;  // of the last tick
  bool was_pressed_ = false, was_stuck_ = false, was_through_ = false, was_other_ = false;
  double last_error_m_ = 0.0, last_step_excess_m_ = 0.0;
};

}  // namespace asperity::testkit
