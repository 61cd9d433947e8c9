#include "asperity/device/pointer_device.h"

#include <utility>

#include "asperity/base/error.h"
#include "asperity/base/units.h"
#include "check_config.h"
#include "computed_device.h"
#include "matrix_exponential.h"

namespace asperity {

namespace {

class PointerDevice final : public ComputedDevice {
 public:
  PointerDevice(const PointerDeviceConfig& config, const Eigen::Vector3d& start_m,
                std::shared_ptr<PointerTargets> targets)
      : ComputedDevice(config),
        config_(config),
        targets_(std::move(targets)),
        p_m_(start_m),
        end_m_(start_m),
        target_m_(start_m) {
    info_.name = "mouse";
    info_.model = "pointer on a spring";
  }

  DeviceReading read(std::int64_t t_ns) noexcept override {
    Eigen::Vector3d target_m;
    if (targets_->take_if_new(target_m) && target_m.allFinite()) {
      target_m_ = target_m;
      heard_ns_ = t_ns;
    }
    if (t_ns > newest_ns_) {
      if (newest_ns_ >= 0) advance(t_ns - newest_ns_);
      newest_ns_ = t_ns;
      ++sequence_;
    }
    DeviceReading reading;
    reading.p_m = p_m_;
    reading.v_mps = v_mps_;
    reading.sequence = sequence_;
    if (static_cast<double>(t_ns - heard_ns_) * kNanosecond_s > config_.stalled_after_s) {
      reading.status = DeviceStatus::kStalled;
    }
    if (closed_) reading.status = DeviceStatus::kEnded;
    return reading;
  }

 private:
  // Of one axis: p, p′, g, and the constants u and f.
  using Step = Eigen::Matrix<double, 5, 5>;

  Step step_of(std::int64_t dt_ns) const noexcept {
    const double dt_s = static_cast<double>(dt_ns) * kNanosecond_s;
    Step rates = Step::Zero();
    rates(0, 1) = 1.0;
    rates.row(1) << -config_.stiffness_N_per_m, -config_.damping_N_s_per_m, config_.stiffness_N_per_m, 0.0, 1.0;
    rates.row(1) /= config_.mass_kg;
    rates(2, 2) = -1.0 / config_.smoothing_s;
    rates(2, 3) = -rates(2, 2);
    return matrix_exponential<5>(dt_s * rates);
  }

  void advance(std::int64_t dt_ns) noexcept {
    if (dt_ns != step_ns_) {
      step_ = step_of(dt_ns);
      step_ns_ = dt_ns;
    }
    end_m_ = inside_workspace(end_m_);
    const Eigen::Vector3d u_m = inside_workspace(target_m_);
    for (int axis = 0; axis < 3; ++axis) {
      // From the point, so that a place far from the origin costs no digits.
      Eigen::Matrix<double, 5, 1> x;
      x << 0.0, v_mps_[axis], end_m_[axis] - p_m_[axis], u_m[axis] - p_m_[axis], force_N_[axis];
      const Eigen::Matrix<double, 5, 1> y = step_.lazyProduct(x);
      end_m_[axis] = p_m_[axis] + y[2];
      p_m_[axis] += y[0];
      v_mps_[axis] = y[1];
    }
  }

  Eigen::Vector3d inside_workspace(const Eigen::Vector3d& place_m) const noexcept {
    const Eigen::Vector3d way_m = place_m - p_m_;
    const double length_m = way_m.stableNorm();
    return length_m > config_.reach_m ? Eigen::Vector3d(p_m_ + way_m * (config_.reach_m / length_m)) : place_m;
  }

  PointerDeviceConfig config_;
  std::shared_ptr<PointerTargets> targets_;
  Eigen::Vector3d p_m_;
  Eigen::Vector3d v_mps_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d end_m_;  // g
  Eigen::Vector3d target_m_;
  Step step_ = Step::Identity();
  std::int64_t step_ns_ = -1;
  std::int64_t newest_ns_ = -1;
  std::int64_t heard_ns_ = 0;
  std::uint64_t sequence_ = 0;
};

}  // namespace

std::unique_ptr<HapticDevice> open_pointer(const PointerDeviceConfig& config, const Eigen::Vector3d& start_m,
                                           std::shared_ptr<PointerTargets> targets) {
  check_config("pointer", config);
  if (!start_m.allFinite()) throw Error("pointer: its start is not finite");
  if (!targets) throw Error("pointer: nobody moves it");
  return std::make_unique<PointerDevice>(config, start_m, std::move(targets));
}

}  // namespace asperity
