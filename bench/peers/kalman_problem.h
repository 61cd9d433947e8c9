#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "asperity/base/random.h"
#include "asperity/trajectory/filter_position.h"

namespace bench {

// A hand's slow path seen by the seed's tracker (Fig. 9), the same for each filter.
struct KalmanProblem {
  static constexpr double kPeriod_s = 5e-3;
  static constexpr std::size_t kSamples = 12000;

  asperity::PositionFilterNoise noise;
  std::vector<Eigen::Vector3d> measured_m;

  KalmanProblem() {
    const Eigen::Vector3d sigma_m(0.15e-3, 0.13e-3, 0.54e-3);
    noise.process_position_m2.setConstant(1e-10);
    noise.process_velocity_m2ps2.setConstant(1e-6);
    noise.measurement_m2 = sigma_m.cwiseAbs2();
    asperity::Random random(1);
    for (std::size_t i = 0; i < kSamples; ++i) {
      const double t = static_cast<double>(i) * kPeriod_s;
      const Eigen::Vector3d path_m(0.025 * t, 0.01 * std::sin(t), 0.3);
      const Eigen::Vector3d error(random.normal(), random.normal(), random.normal());
      measured_m.emplace_back(path_m + sigma_m.cwiseProduct(error));
    }
  }
};

}  // namespace bench
