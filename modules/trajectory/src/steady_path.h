#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <Eigen/Core>

namespace asperity {

// A path that is dead reckoning between corrections, with the corrections let in slowly. What has been corrected so
// far, D, is a straight line between jumps of itself and of its slope; L[D] with
//   L = 10 u³ - 15 u⁴ + 6 u⁵,  u = 1/(1 + s/w)
// is let in. 1 - L = s³ (…): constant, ramp and parabola, which a wrong start and bias leave, come through whole; above
// the corner L falls with the third power of the frequency, where a filter's own corrections fall with the first.
class SteadyPath {
 public:
  explicit SteadyPath(double corner_Hz) : w_(2.0 * std::numbers::pi * corner_Hz) {}

  void reset() {
    total_.setZero();
    slope_.setZero();
    for (auto& x : stages_) x.setZero();
    any_ = false;
  }

  // The path is corrected at the next point: so much farther, and faster.
  void jump(const Eigen::Vector3d& by_m, const Eigen::Vector3d& by_mps) {
    pending_m_ += by_m;
    pending_mps_ += by_mps;
  }

  // The next point as corrected; the point with slow corrections.
  Eigen::Vector3d push(std::int64_t t_ns, const Eigen::Vector3d& p_m) {
    const double dt_s = any_ ? static_cast<double>(t_ns - last_ns_) * 1e-9 : 0.0;
    last_ns_ = t_ns;
    any_ = true;
    const double keep = std::exp(-w_ * dt_s);
    Eigen::Vector3d before = total_;
    total_ += dt_s * slope_;
    Eigen::Vector3d now = total_;
    for (Eigen::Vector3d& x : stages_) {
      // A pole's answer to a straight line from `before` to `now`.
      const Eigen::Vector3d behind =
          dt_s > 0.0 ? Eigen::Vector3d((now - before) / (dt_s * w_)) : Eigen::Vector3d::Zero();
      const Eigen::Vector3d next = now - behind + keep * (x - before + behind);
      before = x;
      x = next;
      now = next;
    }
    total_ += pending_m_;
    slope_ += pending_mps_;
    pending_m_.setZero();
    pending_mps_.setZero();
    return p_m - (total_ - (10.0 * stages_[2] - 15.0 * stages_[3] + 6.0 * stages_[4]));
  }

 private:
  double w_;
  Eigen::Vector3d total_ = Eigen::Vector3d::Zero(), slope_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d pending_m_ = Eigen::Vector3d::Zero(), pending_mps_ = Eigen::Vector3d::Zero();
  std::array<Eigen::Vector3d, 5> stages_{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                                         Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  std::int64_t last_ns_ = 0;
  bool any_ = false;
};

}  // namespace asperity
