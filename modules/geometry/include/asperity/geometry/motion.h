#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "asperity/geometry/covariance_line.h"

namespace asperity {

// The sensors' own noise under a motion: one-sided densities, white, an axis. 0: not known, or there is none.
struct MotionNoise {
  double accel_m2ps3 = 0.0;
  double rotation_rad2ps = 0.0;         // of the tracker's orientation
  double rotation_accel_rad2ps5 = 0.0;  // without a gyroscope: of the angular acceleration, which the tracker follows
  Eigen::Vector3d tip_from_sensor_m = Eigen::Vector3d::Zero();  // from the accelerometer to the tip, marker axes
};

// The motion of the probe's tip over time, what a trajectory estimate hands to the stages after it.
// All vectors have one entry a sample; times rise strictly.
struct TipMotion {
  std::vector<std::int64_t> t_ns;
  std::vector<Eigen::Vector3d> p_world_tip_m;
  std::vector<Eigen::Quaterniond> q_world_marker;
  std::vector<Eigen::Vector3d> v_world_tip_mps;
  std::vector<Eigen::Vector3d> a_world_tip_mps2;  // gravity removed
  CovarianceLine cov_world_tip_m2;                // of the position; empty if the method gives none
  // Of that, what comes from the tip's place in the marker, marker axes: one error for the whole motion.
  Eigen::Vector3d sigma_tip_in_marker_m = Eigen::Vector3d::Zero();
  MotionNoise noise;
  // Calibrated axial reading, and the force along the surface's normal once that is known (profile/normal_force.h); nan
  // where the sensor gave none.
  std::vector<double> force_N;
  std::vector<double> axial_force_N;           // the reading, where force_N is along the normal; empty: force_N is
  std::vector<Eigen::Vector3d> force_world_N;  // on the tip, of a sensor with three axes; empty: there is none

  std::size_t size() const { return t_ns.size(); }
};

}  // namespace asperity
