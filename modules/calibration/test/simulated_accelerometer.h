#pragma once

#include <cmath>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "asperity/base/random.h"
#include "asperity/calibration/accelerometer_samples.h"
#include "asperity/geometry/pose.h"

namespace asperity::test {

// A sensor whose pose means err by more than its rows' scatter over their root: `drift` is added once a pose, `noise`
// to every row, and the converter rounds.
struct SimulatedAccelerometer {
  Eigen::Matrix3d B = Eigen::Matrix3d::Identity();
  Eigen::Vector3d C = Eigen::Vector3d::Zero();
  double drift_counts = 1.5;
  double noise_counts = 4.0;
  double rate_Hz = 50.0;

  Eigen::Vector3d read(const Eigen::Vector3d& f_mps2, const Eigen::Vector3d& drift, Random& random) const {
    const Eigen::Vector3d noise(random.normal(), random.normal(), random.normal());
    return (B * f_mps2 + C + drift + noise_counts * noise).array().round();
  }

  Eigen::Vector3d draw_drift(Random& random) const {
    return drift_counts * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
  }
};

inline Eigen::Vector3d random_direction(Random& random) {
  const Eigen::Vector3d v(random.normal(), random.normal(), random.normal());
  return v.normalized();
}

// Held still for about three seconds in each direction, turned to the next within one, shaken a little on the way.
inline AccelerometerSamples hold_in(const std::vector<Eigen::Vector3d>& directions, double g_mps2,
                                    const SimulatedAccelerometer& sensor, Random& random) {
  AccelerometerSamples out;
  double t_s = 0.0;
  const auto add = [&](const Eigen::Vector3d& f_mps2, const Eigen::Vector3d& drift) {
    out.t_s.push_back(t_s);
    out.counts.push_back(sensor.read(f_mps2, drift, random));
    t_s += 1.0 / sensor.rate_Hz;
  };
  for (std::size_t p = 0; p < directions.size(); ++p) {
    const Eigen::Vector3d drift = sensor.draw_drift(random);
    const int rows = static_cast<int>(sensor.rate_Hz * random.uniform(2.5, 3.5));
    for (int i = 0; i < rows; ++i) add(g_mps2 * directions[p], drift);
    if (p + 1 == directions.size()) break;
    const Eigen::Quaterniond turn = shortest_rotation(directions[p], directions[p + 1]);
    const int steps = static_cast<int>(sensor.rate_Hz);
    for (int i = 1; i < steps; ++i) {
      const Eigen::Vector3d f = slerp(Eigen::Quaterniond::Identity(), turn, i / sensor.rate_Hz) * directions[p];
      add(g_mps2 * f + 0.7 * random_direction(random), drift);
    }
  }
  return out;
}

// The same without the turns, the specific force known at each row.
inline AccelerometerSamples place_in(const std::vector<Eigen::Vector3d>& forces_mps2,
                                     const SimulatedAccelerometer& sensor, Random& random) {
  AccelerometerSamples out;
  for (const Eigen::Vector3d& f_mps2 : forces_mps2) {
    const Eigen::Vector3d drift = sensor.draw_drift(random);
    for (int i = 0; i < 40; ++i) {
      out.t_s.push_back(static_cast<double>(out.size()) / sensor.rate_Hz);
      out.counts.push_back(sensor.read(f_mps2, drift, random));
      out.specific_force_mps2.push_back(f_mps2);
    }
  }
  return out;
}

}  // namespace asperity::test
