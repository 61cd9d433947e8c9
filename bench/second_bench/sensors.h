#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "hand_motion.h"

namespace second_bench {

inline constexpr double kGravity_mps2 = 9.80665;
inline const Eigen::Vector3d kGravity_world_mps2{0.0, kGravity_mps2, 0.0};
inline constexpr std::int64_t kStart_ns = 5'000'000'000;

// What the sensors truly do: counts = B · (quantity) + C.
struct TrueSensors {
  Eigen::Matrix3d accel_B, gyro_B;
  Eigen::Vector3d accel_C, gyro_C;
  double force_newton_per_count = 0.0, force_offset_N = 0.0;
};
TrueSensors draw_sensors(const ScanPlan& plan);

struct ProbeRow {
  std::int64_t t_ns = 0;
  Eigen::Vector3d accel, gyro;
  double force = std::numeric_limits<double>::quiet_NaN();
};
struct TruthRow {
  std::int64_t t_ns = 0;
  std::size_t step = 0;
};
struct ProbeRows {
  std::vector<ProbeRow> rows;   // those that arrived, stamped by the host
  std::vector<TruthRow> taken;  // all, at their true times on the host's clock
};
// The stamps' mean delay is taken off, so that they are right on the average.
ProbeRows sample_probe(const ScanPlan& plan, const TrueSensors& sensors, const HandMotion& motion);

struct PoseRow {
  std::int64_t t_ns = 0;
  Eigen::Vector3d p_m;
  Eigen::Quaterniond q;
  Eigen::Vector3d sigma_m, sigma_rad;  // of this frame, without the slow error, along the world's axes
};
struct PoseRows {
  std::vector<PoseRow> rows;
  Eigen::Vector3d rms_m = Eigen::Vector3d::Zero(), rms_rad = Eigen::Vector3d::Zero();  // all errors but outliers
};
PoseRows sample_tracker(const ScanPlan& plan, const HandMotion& motion);

}  // namespace second_bench
