#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "asperity/geometry/motion.h"
#include "asperity/profile/find_base_path.h"

namespace asperity {

struct CausalBaseConfig {
  BasePathConfig base;
  double history_s = 6.0;
  double period_s = 0.25;
  double blend_m = 10e-3;
};

// The base shape under a path that is still growing: find_base_path over the last seconds, again and again. Until the
// path is long enough for that, and its normal known better than by how a probe is held, the plane lies across the
// probe's axis. Where a new fit differs from the one before,
// the height goes over to it within the distance blend_m, without a step. Thread-safe: no.
class CausalBase {
 public:
  CausalBase(const CausalBaseConfig& config, const Eigen::Vector3d& tip_in_marker_m);

  // A sample of the motion in order of time, and whether the tip touched; `travelled_m` is the way since the sample
  // before. Memory is bounded.
  void push(std::int64_t t_ns, const Eigen::Vector3d& p_world_tip_m, const Eigen::Quaterniond& q_world_marker,
            double force_N, bool contact, double travelled_m);

  bool begun() const { return begun_; }  // there is a plane, if only the probe's
  bool fitted() const { return fitted_; }
  bool settled() const { return travelled_m_ > 10.0 * config_.blend_m; }
  PathShape shape() const { return shape_; }
  double radius_m() const { return shape_ == PathShape::kCircle ? radius_m_ : 0.0; }
  double normal_sigma_deg() const { return normal_sigma_deg_; }

  // The outward unit normal of the base at a point beside it, and the point's height.
  Eigen::Vector3d normal_at(const Eigen::Vector3d& p_world_m) const;
  double height_m(const Eigen::Vector3d& p_world_m) const;

  void reset();

 private:
  double distance_m(const Eigen::Vector3d& p_world_m) const;
  void refit(const Eigen::Vector3d& here_m);

  CausalBaseConfig config_;
  Eigen::Vector3d tip_in_marker_m_;
  TipMotion history_;  // at 200 Hz
  std::int64_t next_fit_ns_ = 0;
  bool begun_ = false;
  bool fitted_ = false;
  double travelled_m_ = 0.0;  // in contact
  double remainder_m_ = 0.0;  // of the heights over the base before, still to be given up

  PathShape shape_ = PathShape::kPlane;
  Eigen::Vector3d centre_m_ = Eigen::Vector3d::Zero();  // a point of the plane, or the circle's centre
  Eigen::Vector3d axis_ = Eigen::Vector3d::Zero();      // the plane's outward normal, or the circle's axis
  double radius_m_ = 0.0;
  bool outside_ = true;
  double lean_rad_ = 0.0;  // of the circle's normals towards its axis
  double normal_sigma_deg_ = 0.0;
};

}  // namespace asperity
