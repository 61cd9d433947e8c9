#pragma once

#include <span>
#include <vector>

#include <Eigen/Geometry>

namespace asperity {

// The quaternions with each one's sign chosen so that neighbours lie on one half of the sphere.
std::vector<Eigen::Quaterniond> make_signs_continuous(std::span<const Eigen::Quaterniond> q);

// The thesis's linear Kalman filter with the state x = [q] and F = H = I, component by component, each
// result normalised (thesis §4.2, erratum 9), after making the signs continuous. `process_rad2` is the
// variance of the rotation gained from one sample to the next, `measurement_rad2` that of a measured
// angle about one axis; a quaternion's component has a quarter of each. Throws Error unless
// measurement_rad2 is positive.
std::vector<Eigen::Quaterniond> filter_orientation(std::span<const Eigen::Quaterniond> measured, double process_rad2,
                                                   double measurement_rad2);

}  // namespace asperity
