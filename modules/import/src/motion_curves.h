#pragma once

#include <cstdint>
#include <vector>

#include "asperity/import/file_streams.h"

namespace asperity {

inline constexpr std::int64_t kCurveStep_ns = 5'000'000;
inline constexpr double kCurveStep_s = 5e-3;

// A quantity that poses and an inertial sensor both show, whatever their axes, on a grid of 5 ms from the stream's
// first time on; nan where there is none.
struct MotionCurve {
  std::int64_t start_ns = 0;
  std::vector<double> value;
};

// The angular speed, rad/s: the length of the mean rotation rate over `half_ns` to either side.
MotionCurve angular_speed(const PoseStream& pose, std::int64_t half_ns);
MotionCurve angular_speed(const VectorStream& rate, std::int64_t half_ns);

// The size of the specific force, m/s²: |a + g up| of the body's origin, whose acceleration is a second difference over
// h = 2 `half_ns`, which is its mean under a triangle of that half width, and |f| of f's mean under the same triangle
// (two means over h, one of the other). That the sensor is not in the origin, and turns meanwhile, is left out.
MotionCurve specific_force_size(const PoseStream& pose, std::int64_t half_ns, const Eigen::Vector3d& up);
MotionCurve specific_force_size(const VectorStream& specific_force, std::int64_t half_ns);

}  // namespace asperity
