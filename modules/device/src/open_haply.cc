#include "asperity/device/open_haply.h"

#include <algorithm>
#include <atomic>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "check_config.h"
#include "haply_protocol.h"
#include "inverse_service_client.h"
#include "io_device.h"

namespace asperity {

namespace {

class HaplyDevice final : public IoDevice {
 public:
  explicit HaplyDevice(const HaplyConfig& config)
      : IoDevice(config.stall_after_s),
        config_(config),
        R_device_service_(parse_haply_axes(config.axes)),
        client_(config.host, config.port) {
    const auto until = Clock::now() + seconds(config.open_timeout_s);
    force_key_ = parse_service_version(client_.get("/version", until));
    client_.connect(until);
    await_state(until);
    device_id_ = state_.device_id;
    info_.name = "haply";
    info_.model = (state_.model.empty() ? "Inverse3" : state_.model) + " " + device_id_;
    // The session's first message, with zero force; its answer is the first state of this session.
    send(Eigen::Vector3d::Zero(), true, until);
    await_state(until);
    pass_on();
    thread_ = std::thread([this] { serve_and_leave(); });
  }

  ~HaplyDevice() override { close(); }

  void close() noexcept override {
    stop_.store(true);
    client_.wake();
    if (thread_.joinable()) thread_.join();
  }

 private:
  // All below: the thread that opens, then the I/O thread.

  bool receive_state(Clock::time_point until) {
    if (!client_.receive(text_, until, stop_)) return false;
    outstanding_ = std::max(outstanding_ - 1, 0);
    state_ = parse_haply_frame(text_, device_id_.empty() ? config_.device_id : device_id_);
    return true;
  }

  void await_state(Clock::time_point until) {
    if (receive_state(until)) return;
    throw Error(fmt::format("haply: no state from {}:{} within {} s", config_.host, config_.port,
                            number_text(config_.open_timeout_s)));
  }

  void send(const Eigen::Vector3d& force_N, bool first, Clock::time_point until) {
    write_haply_command(text_, device_id_, R_device_service_.transpose() * force_N, force_key_, first);
    client_.send(text_, until);
    ++outstanding_;
  }

  void pass_on() { news_.publish({R_device_service_ * state_.p_m, R_device_service_ * state_.v_mps, ++sequence_}); }

  void serve_and_leave() {
    run([this] { serve(); });
    try {
      send_last_force();
    } catch (const std::exception&) {
      // The connection is gone, and the force with it: the service holds none beyond its session.
    }
    client_.close(Clock::now() + seconds(0.1));
  }

  void serve() {
    const auto lost_after = seconds(config_.lost_after_s), period = seconds(1.0 / config_.max_rate_Hz);
    const auto force_timeout = seconds(config_.force_timeout_s);
    auto last_state = Clock::now(), next_send = last_state;
    bool zero_sent = false;
    while (!stop_.load()) {
      auto now = Clock::now();
      if (outstanding_ == 0 && now >= next_send) {
        send(forces_.take(now, force_timeout), false, now + lost_after);
        next_send = std::max(next_send + period, now);
      }
      const auto silent_at = last_state + (zero_sent ? lost_after : seconds(config_.stall_after_s));
      if (receive_state(outstanding_ == 0 ? next_send : silent_at)) {
        pass_on();
        last_state = Clock::now();
        zero_sent = false;
        continue;
      }
      now = Clock::now();
      if (now - last_state > lost_after) {
        throw Error(
            fmt::format("haply: device '{}': no state for {} s", device_id_, number_text(config_.lost_after_s)));
      }
      if (outstanding_ > 0 && now >= silent_at && !zero_sent) {
        // A service that wakes finds a zero force behind the stale one. Its answers are then two.
        send(Eigen::Vector3d::Zero(), false, last_state + lost_after);
        zero_sent = true;
      }
    }
  }

  void send_last_force() {
    const auto until = Clock::now() + seconds(0.2);
    const std::atomic<bool> never = false;
    send(Eigen::Vector3d::Zero(), false, until);
    while (outstanding_ > 0 && client_.receive(text_, until, never)) --outstanding_;
  }

  HaplyConfig config_;
  Eigen::Matrix3d R_device_service_;

  // The I/O thread's.
  InverseServiceClient client_;
  HaplyForceKey force_key_ = HaplyForceKey::kVector;
  std::string device_id_, text_;
  HaplyState state_;
  int outstanding_ = 0;  // messages sent and not yet answered
  std::uint64_t sequence_ = 0;
  std::thread thread_;
};

}  // namespace

std::unique_ptr<HapticDevice> open_haply(const HaplyConfig& config) {
  check_config("haply", config);
  return std::make_unique<HaplyDevice>(config);
}

}  // namespace asperity
