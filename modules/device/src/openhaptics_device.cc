#include "asperity/device/openhaptics_device.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/device/latest_value.h"
#include "check_config.h"
#include "hd_api.h"
#include "single_owner.h"
#include "stall_watch.h"

namespace asperity {

namespace {

constexpr double kMillimetre_m = 1e-3;
constexpr double kReturn_s = 0.02;  // in which the force comes back after it was not renewed
constexpr int kMostErrorsAFrame = 32;
constexpr int kLowestRate_Hz = 100;
constexpr int kHighestRate_Hz = 10000;
constexpr std::chrono::milliseconds kFirstFrameWithin{1000};
constexpr std::chrono::milliseconds kLastFramesWithin{200};

struct Command {
  Eigen::Vector3d force_N = Eigen::Vector3d::Zero();
  std::uint64_t sequence = 0;
};

std::atomic<bool> owned{false};

class OpenHapticsDevice final : public HapticDevice {
 public:
  explicit OpenHapticsDevice(const OpenHapticsConfig& config)
      : owner_(owned, "openhaptics"), api_(hd::load_api(config.library)), watch_(config.stall_after_s) {
    handle_ = api_.init_device(config.device.empty() ? nullptr : config.device.c_str());
    const unsigned error = drain_first_error();
    if (handle_ == hd::kInvalidHandle) {
      throw Error("openhaptics: no device" +
                  (config.device.empty() ? std::string() : " '" + printable(config.device) + "'") +
                  (error != 0 ? ": " + hd::error_text(error) : std::string()));
    }
    try {
      describe(config);
      start(config);
    } catch (...) {
      close();
      throw;
    }
  }

  ~OpenHapticsDevice() override { close(); }

  const DeviceInfo& info() const noexcept override { return info_; }

  DeviceReading read(std::int64_t t_ns) noexcept override {
    DeviceReading reading = readings_.take();
    if (watch_.stalled(t_ns, reading.sequence)) reading.status = DeviceStatus::kStalled;
    if (closed_) reading.status = DeviceStatus::kEnded;
    if (fault_code_.load(std::memory_order_relaxed) != 0) reading.status = DeviceStatus::kFault;
    return reading;
  }

  void write(const Eigen::Vector3d& force_N) noexcept override {
    if (closed_) return;
    command_.force_N = force_N.allFinite() ? force_N : Eigen::Vector3d::Zero();
    ++command_.sequence;
    commands_.publish(command_);
  }

  void close() noexcept override {
    if (closed_) return;
    closed_ = true;
    if (scheduled_) {
      // Two whole frames after the flag: the force of zero has been sent.
      ending_.store(true);
      const std::uint64_t first = silent_frames_.load();
      const auto until = std::chrono::steady_clock::now() + kLastFramesWithin;
      while (silent_frames_.load() < first + 2 && std::chrono::steady_clock::now() < until) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
      api_.disable(hd::kForceOutput);
      api_.stop_scheduler();
      api_.unschedule(schedule_);
    }
    api_.disable_device(handle_);
    drain_first_error();
  }

  std::string fault() const override {
    std::string out;
    const auto say = [&out](unsigned code) { out += (out.empty() ? "" : "; ") + hd::error_text(code); };
    if (const unsigned code = fault_code_.load(); code != 0) say(code);
    for (std::size_t i = 0; i < kWarnings.size(); ++i) {
      if (warned_[i].load()) say(kWarnings[i]);
    }
    if (const unsigned code = other_code_.load(); code != 0) say(code);
    return out;
  }

 private:
  static constexpr std::array<unsigned, 4> kWarnings = {hd::kWarmMotors, hd::kExceededMaxForce,
                                                        hd::kExceededMaxVelocity, hd::kFrameError};

  static unsigned on_frame(void* self) { return static_cast<OpenHapticsDevice*>(self)->frame(); }

  // The oldest thing the driver complains of, 0 if of nothing; its list is empty afterwards.
  unsigned drain_first_error() noexcept {
    unsigned first = 0;
    for (int i = 0; i < kMostErrorsAFrame; ++i) {
      const unsigned code = api_.get_error().code;
      if (code == 0) break;
      first = code;
    }
    return first;
  }

  double limit(unsigned parameter) noexcept {
    double value = std::numeric_limits<double>::quiet_NaN();
    api_.get_doubles(parameter, &value);
    const bool told = drain_first_error() == 0 && std::isfinite(value) && value > 0.0;
    return told ? value : std::numeric_limits<double>::quiet_NaN();
  }

  void describe(const OpenHapticsConfig& config) {
    info_.name = "openhaptics";
    if (api_.get_string != nullptr) {
      const char* const model = api_.get_string(hd::kDeviceModel);
      if (drain_first_error() == 0 && model != nullptr) info_.model = printable(model);
    }
    info_.rate_Hz = config.rate_Hz;
    info_.max_force_N = limit(hd::kNominalMaxForce_N);
    info_.max_continuous_force_N = limit(hd::kMaxContinuousForce_N);
    info_.max_stiffness_N_per_m = limit(hd::kNominalMaxStiffness_N_per_mm) / kMillimetre_m;
    std::array<double, 6> box_mm{};
    api_.get_doubles(hd::kUsableWorkspace_mm, box_mm.data());
    const Eigen::Vector3d low_mm(box_mm.data());
    const Eigen::Vector3d high_mm(box_mm.data() + 3);
    if (drain_first_error() == 0 && low_mm.allFinite() && high_mm.allFinite() &&
        (low_mm.array() < high_mm.array()).all()) {
      info_.workspace_min_m = kMillimetre_m * low_mm;
      info_.workspace_max_m = kMillimetre_m * high_mm;
    }
  }

  void start(const OpenHapticsConfig& config) {
    api_.set_scheduler_rate(static_cast<unsigned long>(std::lround(config.rate_Hz)));
    drain_first_error();  // a device that has one rate only keeps it
    int rate_Hz = 0;
    api_.get_integers(hd::kUpdateRate_Hz, &rate_Hz);
    if (drain_first_error() == 0 && rate_Hz >= kLowestRate_Hz && rate_Hz <= kHighestRate_Hz) info_.rate_Hz = rate_Hz;
    force_lasts_frames_ = std::lround(std::ceil(config.force_timeout_s * info_.rate_Hz));
    gain_step_ = 1.0 / (kReturn_s * info_.rate_Hz);
    api_.enable(hd::kForceOutput);
    api_.enable(hd::kMaxForceClamping);
    api_.enable(hd::kForceRamping);
    schedule_ = api_.schedule_asynchronous(&OpenHapticsDevice::on_frame, this, hd::kDefaultPriority);
    scheduled_ = true;
    api_.start_scheduler();
    if (const unsigned error = drain_first_error(); error != 0) {
      throw Error("openhaptics: the device does not start: " + hd::error_text(error));
    }
    const auto until = std::chrono::steady_clock::now() + kFirstFrameWithin;
    while (frames_.load() == 0) {
      if (fault_code_.load() != 0) throw Error("openhaptics: " + fault());
      if (std::chrono::steady_clock::now() > until) {
        throw Error("openhaptics: the driver's scheduler does not call back" +
                    (fault().empty() ? std::string() : ": " + fault()));
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

  // One frame of the vendor's thread.
  unsigned frame() noexcept {
    const bool ending = ending_.load(std::memory_order_acquire);
    const Command command = commands_.take();
    unrenewed_frames_ = command.sequence == taken_ ? unrenewed_frames_ + 1 : 0;
    taken_ = command.sequence;
    const bool driven = !ending && fault_code_.load(std::memory_order_relaxed) == 0 &&
                        unrenewed_frames_ <= force_lasts_frames_ && command.force_N.allFinite();
    gain_ = driven ? std::min(1.0, gain_ + gain_step_) : 0.0;
    const Eigen::Vector3d force_N = driven ? Eigen::Vector3d(gain_ * command.force_N) : Eigen::Vector3d::Zero();

    Eigen::Vector3d p_mm = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
    Eigen::Vector3d v_mmps = p_mm;
    int buttons = 0;
    api_.begin_frame(handle_);
    api_.get_doubles(hd::kCurrentPosition_mm, p_mm.data());
    api_.get_doubles(hd::kCurrentVelocity_mmps, v_mmps.data());
    api_.get_integers(hd::kCurrentButtons, &buttons);
    api_.set_doubles(hd::kCurrentForce_N, force_N.data());
    api_.end_frame(handle_);

    if (note_errors() && p_mm.allFinite() && v_mmps.allFinite()) {
      reading_.p_m = kMillimetre_m * p_mm;
      reading_.v_mps = kMillimetre_m * v_mmps;
      reading_.buttons = static_cast<std::uint32_t>(buttons);
      ++reading_.sequence;
      readings_.publish(reading_);
      frames_.fetch_add(1, std::memory_order_release);
    }
    if (ending) silent_frames_.fetch_add(1, std::memory_order_release);
    return hd::kCallbackContinue;
  }

  // Takes the driver's complaints about this frame; false if what was read in it is void.
  bool note_errors() noexcept {
    bool valid = true;
    for (int i = 0; i < kMostErrorsAFrame; ++i) {
      const unsigned code = api_.get_error().code;
      if (code == 0) break;
      const auto known = std::find(kWarnings.begin(), kWarnings.end(), code);
      if (known != kWarnings.end()) warned_[static_cast<std::size_t>(known - kWarnings.begin())].store(true);
      const unsigned kind = code >> 8;
      if (kind == hd::kCommError >> 8) {
        unsigned none = 0;
        fault_code_.compare_exchange_strong(none, code);
      } else if (known == kWarnings.end()) {
        other_code_.store(code);
      }
      if (kind != hd::kWarmMotors >> 8) valid = false;  // those of force say nothing against the reading
    }
    return valid;
  }

  SingleOwner owner_;
  hd::Api api_;
  DeviceInfo info_;
  unsigned handle_ = hd::kInvalidHandle;
  unsigned long schedule_ = 0;
  bool scheduled_ = false;
  bool closed_ = false;

  // The servo thread's.
  StallWatch watch_;
  Command command_;

  LatestValue<Command> commands_;
  LatestValue<DeviceReading> readings_;
  std::atomic<bool> ending_{false};
  std::atomic<std::uint64_t> frames_{0};
  std::atomic<std::uint64_t> silent_frames_{0};
  std::atomic<unsigned> fault_code_{0};
  std::atomic<unsigned> other_code_{0};
  std::array<std::atomic<bool>, kWarnings.size()> warned_{};

  // The vendor's thread's.
  DeviceReading reading_;
  std::uint64_t taken_ = 0;
  long unrenewed_frames_ = 0;
  long force_lasts_frames_ = 0;
  double gain_ = 0.0;
  double gain_step_ = 1.0;
};

}  // namespace

std::unique_ptr<HapticDevice> open_openhaptics(const OpenHapticsConfig& config) {
  check_config("openhaptics", config);
  return std::make_unique<OpenHapticsDevice>(config);
}

}  // namespace asperity
