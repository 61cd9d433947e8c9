#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <Eigen/Core>

namespace asperity {

// The last positions of a hand whose device gives no velocity. Begin with VelocityEstimator{}.
struct VelocityEstimator {
  static constexpr std::size_t kWindow = 16;

  std::array<Eigen::Vector3d, kWindow> p_m{};
  std::array<double, kWindow> t_s{};
  std::size_t next = 0;   // where the next position goes
  std::size_t count = 0;  // positions held
  std::uint64_t sequence = 0;
  Eigen::Vector3d v_mps = Eigen::Vector3d::Zero();
};

// The velocity at time `t_s` by a first-order adaptive window, axis by axis (Janabi-Sharifi, Hayward and Chen 2000,
// end-fit FOAW): (p(k) − p(k−n)) / (t(k) − t(k−n)) with the longest window n < 16 whose positions all lie within
// `noise_m` of that straight line. Slow motion is averaged over many ticks, fast motion over few. A reading whose
// `sequence` is that of the one before is not new and keeps the velocity. Zero after the first position; a position
// that is not finite empties the window. Realtime-safe: yes.
Eigen::Vector3d estimate_velocity(VelocityEstimator& state, const Eigen::Vector3d& p_m, std::uint64_t sequence,
                                  double t_s, double noise_m) noexcept;

}  // namespace asperity
