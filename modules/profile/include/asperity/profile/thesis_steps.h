#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

// The steps of make_profile_thesis(), one by one.
namespace asperity {

// The distance along a path up to each of its points: the sum of the straight segments before it (seed
// §5.1). Noise in the points lengthens it (erratum 10): this is the baseline's arc length.
std::vector<double> path_length_m(std::span<const Eigen::Vector3d> p_m);

// The tip's acceleration along the outward surface normal, signed, m/s²: a·n for each sample (seed §4.3,
// erratum 3; the seed's weights per accelerometer axis are this scalar product in the sensor's frame).
// Throws Error if the sizes differ.
std::vector<double> blend_acceleration(std::span<const Eigen::Vector3d> a_world_tip_mps2,
                                       std::span<const Eigen::Vector3d> n_world);

// The seed's scale of the acceleration that evens out the hand's force: s = 1 − (f − f_mean)/(f_max − f_min)
// for each sample, with f after a moving average over `half_width` samples to either side and its own mean,
// maximum and minimum (seed §4.4, erratum 14). All 1 where f_max = f_min (erratum 25) or where there is no
// force at all; cells that are nan are bridged by straight lines first.
std::vector<double> force_scale(std::span<const double> force_N, std::size_t half_width);

// The height whose second derivative is `a_mps2`, sampled every `period_s`, from rest at zero, m:
// h[i+1] = 2h[i] − h[i−1] + a[i] Δt² (seed §5.1, erratum 2), with h[1] = a[0] Δt²/2. Computed by its steps
// d[i+1] = d[i] + a[i] Δt², h[i+1] = h[i] + d[i+1]: the same scheme, but 2h[i] − h[i−1] would lose seven
// digits over a million samples. Throws Error unless the period is positive.
std::vector<double> integrate_verlet(std::span<const double> a_mps2, double period_s);

// For each sample whether the tip moves: its speed along the surface (without the part along the normal)
// is at least `min_speed_mps`. Samples that do not are those of stick and slip and of rest, which the seed
// drops (seed §4.4), here after the integration, which needs them (erratum 25). Throws Error if the sizes
// differ.
std::vector<char> mark_stick_slip(std::span<const Eigen::Vector3d> v_world_tip_mps,
                                  std::span<const Eigen::Vector3d> n_world, double min_speed_mps);

}  // namespace asperity
