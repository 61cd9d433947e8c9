#pragma once

#include <cstddef>
#include <cstdint>

#include <Eigen/Core>

#include "asperity/device/hand_model_config.h"
#include "asperity/device/hand_path.h"

namespace asperity {

// A hand pulled along a path, with a device's force on it that is constant between two instants, as a sampled system
// holds it. With q(t) the path, F(t) the pressing force, n the press direction, e = p − q and f the device's force,
//
//   across n:  m_t e_t″ + b_t e_t′ + k_t e_t = f_t
//   along n:   m e_n″ + b e_n′ + k (e_n − r) = F + f_n,    r′ = (e_n − r) / τ,    |r| ≤ reach
//
// q and F are piecewise linear, so between two instants or knots both systems are linear with inputs that are
// constant or linear: they are advanced exactly, by the matrix exponential, not by a numerical integration. At rest in
// contact r = e_n, and the surface bears F exactly; in the air the hand sinks with F/(b + k τ). The bound of r is
// applied at the instants. A virtual wall is therefore as stable or unstable as the sampled system is (Colgate and
// Schenkel, 1994).
class SimulatedHand {
 public:
  // At the path's first point, at rest. Throws Error for an empty path, times that do not rise or are not within
  // ±2^61 ns, numbers that are not finite, and for a config out of its ranges.
  SimulatedHand(const HandModelConfig& config, HandPath path);

  // Goes on to `t_ns` of the path's own clock, under `force_N`; earlier times change nothing. Does not allocate.
  void advance(std::int64_t t_ns, const Eigen::Vector3d& force_N) noexcept;

  const Eigen::Vector3d& p_m() const noexcept { return p_m_; }
  const Eigen::Vector3d& v_mps() const noexcept { return v_mps_; }
  std::int64_t start_ns() const noexcept { return path_.front().t_ns; }
  std::int64_t end_ns() const noexcept { return path_.back().t_ns; }

 private:
  using AcrossMatrix = Eigen::Matrix3d;             // of e, e′ and a constant force
  using AlongMatrix = Eigen::Matrix<double, 5, 5>;  // of e, e′, r, a force and its slope
  struct Step {
    std::int64_t dt_ns = -1;
    AcrossMatrix across;
    AlongMatrix along;
  };

  Step step_of(std::int64_t dt_ns) const noexcept;
  void move(std::int64_t to_ns, const Step& step, const Eigen::Vector3d& force_N) noexcept;
  void enter_segment(std::size_t segment) noexcept;

  HandModelConfig config_;
  HandPath path_;
  Eigen::Vector3d n_ = Eigen::Vector3d::Zero();
  std::int64_t t_ns_ = 0;
  std::size_t segment_ = 0;                              // from point segment_ on; the last one does not end
  Eigen::Vector3d slope_mps_ = Eigen::Vector3d::Zero();  // q′ in it
  double press_slope_N_per_s_ = 0.0;                     // F′ in it
  Eigen::Vector3d p_m_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d v_mps_ = Eigen::Vector3d::Zero();
  double yield_m_ = 0.0;  // r
  Step usual_;            // that of the tick before
};

}  // namespace asperity
