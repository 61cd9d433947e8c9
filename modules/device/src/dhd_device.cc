#include "asperity/device/dhd_device.h"

#include <array>
#include <atomic>
#include <cmath>
#include <cstring>

#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "asperity/base/text.h"
#include "check_config.h"
#include "dhd_api.h"
#include "single_owner.h"
#include "stall_watch.h"

namespace asperity {

namespace {

constexpr int kFailuresUntilFault = 5;  // one after another: a lost packet is not an unplugged cable

std::atomic<bool> owned{false};

// Theirs: x toward the user, y right, z up. Ours: x right, y up, z toward the user.
Eigen::Vector3d from_driver_frame(const Eigen::Vector3d& v) { return {v.y(), v.z(), v.x()}; }
Eigen::Vector3d to_driver_frame(const Eigen::Vector3d& v) { return {v.z(), v.x(), v.y()}; }

class DhdDevice final : public HapticDevice {
 public:
  explicit DhdDevice(const DhdConfig& config)
      : owner_(owned, "dhd"), api_(dhd::load_api(config.library)), watch_(config.stall_after_s) {
    if (api_.open() < 0) throw Error("dhd: no device: " + words());
    info_.name = "dhd";
    if (api_.system_name != nullptr) {
      const char* const model = api_.system_name(dhd::kDefaultDevice);
      if (model != nullptr) info_.model = printable(model);
    }
    info_.rate_Hz = config.rate_Hz;
    watched_ = set_watchdog(config.watchdog_s);
    if (!watched_ && !config.without_watchdog) {
      const std::string why = words();
      api_.close(dhd::kDefaultDevice);
      throw Error("dhd: the controller's watchdog cannot be set (" + why +
                  "): if this program were stopped, the last force would stay on the device; "
                  "dhd.without_watchdog=true uses it all the same");
    }
    const bool enabled = api_.enable_force(1, dhd::kDefaultDevice) >= 0;
    if (!enabled || api_.set_force(0.0, 0.0, 0.0, dhd::kDefaultDevice) < 0) {
      const std::string why = words();
      api_.close(dhd::kDefaultDevice);
      throw Error("dhd: its force cannot be enabled: " + why);
    }
  }

  ~DhdDevice() override { close(); }

  const DeviceInfo& info() const noexcept override { return info_; }

  DeviceReading read(std::int64_t t_ns) noexcept override {
    if (!closed_ && !faulty_) take_reading();
    DeviceReading reading = reading_;
    if (watch_.stalled(t_ns, reading.sequence)) reading.status = DeviceStatus::kStalled;
    if (closed_) reading.status = DeviceStatus::kEnded;
    if (faulty_) reading.status = DeviceStatus::kFault;
    return reading;
  }

  void write(const Eigen::Vector3d& force_N) noexcept override {
    if (closed_ || faulty_) return;
    const Eigen::Vector3d f_N = force_N.allFinite() ? to_driver_frame(force_N) : Eigen::Vector3d::Zero();
    note(force_failures_, api_.set_force(f_N.x(), f_N.y(), f_N.z(), dhd::kDefaultDevice));
  }

  void close() noexcept override {
    if (closed_) return;
    closed_ = true;
    api_.set_force(0.0, 0.0, 0.0, dhd::kDefaultDevice);
    api_.enable_force(0, dhd::kDefaultDevice);
    api_.close(dhd::kDefaultDevice);
  }

  std::string fault() const override {
    if (!faulty_.load(std::memory_order_acquire)) {
      return watched_ ? ""
                      : "its controller has no watchdog that this driver can set: if this program stops, "
                        "the last force stays until the controller's own time-out";
    }
    return "its calls fail: " + printable(what_.data(), what_.size());
  }

 private:
  std::string words() const {
    const char* const text = api_.last_error();
    return text == nullptr ? "the driver gives no reason" : printable(text, 200);
  }

  // True if the controller turns forces off by itself when none comes for so long, and said so.
  bool set_watchdog(double watchdog_s) {
    if (api_.enable_expert_mode == nullptr || api_.disable_expert_mode == nullptr || api_.set_watchdog == nullptr ||
        api_.get_watchdog == nullptr) {
      return false;
    }
    const auto steps = static_cast<unsigned char>(std::lround(watchdog_s / dhd::kWatchdogStep_s));
    unsigned char told = 0;
    api_.enable_expert_mode();
    const bool set = api_.set_watchdog(steps, dhd::kDefaultDevice) >= 0 &&
                     api_.get_watchdog(&told, dhd::kDefaultDevice) >= 0 && told == steps;
    api_.disable_expert_mode();
    return set;
  }

  void take_reading() noexcept {
    Eigen::Vector3d p_m = Eigen::Vector3d::Zero();
    Eigen::Vector3d v_mps = Eigen::Vector3d::Zero();
    const int got = api_.get_position(&p_m.x(), &p_m.y(), &p_m.z(), dhd::kDefaultDevice);
    note(position_failures_, got);
    if (got < 0 || got == dhd::kTimeGuard || !p_m.allFinite()) return;
    // Its estimator of velocity has nothing to say at first: that is no failure of the device.
    const bool moving = api_.get_linear_velocity(&v_mps.x(), &v_mps.y(), &v_mps.z(), dhd::kDefaultDevice) >= 0;
    const int buttons = api_.get_button_mask(dhd::kDefaultDevice);
    reading_.p_m = from_driver_frame(p_m);
    // Without one it is not 0 but unknown: the loop estimates it, and damps by that.
    reading_.v_mps = moving && v_mps.allFinite() ? from_driver_frame(v_mps) : Eigen::Vector3d::Constant(kNan);
    reading_.buttons = buttons > 0 ? static_cast<std::uint32_t>(buttons) : 0;
    ++reading_.sequence;
  }

  // Each call has a count of its own: one that works must not hide that the other does not.
  void note(int& failures, int answer) noexcept {
    if (answer >= 0) {
      failures = 0;
      return;
    }
    if (++failures < kFailuresUntilFault || faulty_) return;
    // The driver keeps its last error for each thread: it is asked for here.
    const char* const text = api_.last_error();
    if (text != nullptr) std::strncpy(what_.data(), text, what_.size() - 1);
    // If one of both is refused, the other may still be taken.
    api_.set_force(0.0, 0.0, 0.0, dhd::kDefaultDevice);
    api_.enable_force(0, dhd::kDefaultDevice);
    faulty_.store(true, std::memory_order_release);
  }

  SingleOwner owner_;
  dhd::Api api_;
  DeviceInfo info_;
  StallWatch watch_;
  DeviceReading reading_;
  int position_failures_ = 0;
  int force_failures_ = 0;
  bool closed_ = false;
  bool watched_ = false;
  std::atomic<bool> faulty_{false};
  std::array<char, 200> what_{};
};

}  // namespace

std::unique_ptr<HapticDevice> open_dhd(const DhdConfig& config) {
  check_config("dhd", config);
  return std::make_unique<DhdDevice>(config);
}

}  // namespace asperity
