#include "asperity/device/open_haply.h"

#include <algorithm>
#include <atomic>
#include <optional>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/device/supervisor.h"
#include "check_config.h"
#include "haply_protocol.h"
#include "inverse_service_client.h"
#include "io_device.h"
#include "open_questions.h"

namespace asperity {

namespace {

constexpr int kMostUnasked = 100;                 // at a time
constexpr std::chrono::milliseconds kSilence{1};  // after which no more states are to come that nobody asked for

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
    for (bool first = true; first || !current_; first = false) {
      if (Clock::now() >= until) fail_late(false);
      send(Eigen::Vector3d::Zero(), first, until);
      await_state(until);
    }
    pass_on();
    write_haply_command(text_, device_id_, Eigen::Vector3d::Zero(), force_key_, false);
    supervisor_.emplace(client_.descriptor(), websocket_frame(text_));
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

  // True if a state came; `current_` says whether it may be used as the position now.
  bool receive_state(Clock::time_point until) {
    if (!client_.receive(text_, until, stop_)) return false;
    current_ = questions_.answer(Clock::now());
    state_ = parse_haply_frame(text_, device_id_.empty() ? config_.device_id : device_id_);
    return true;
  }

  // States that nobody asked for would be taken for the answers to later messages, each older than the one before. True
  // if there were any.
  bool drop_unasked() {
    int dropped = 0;
    for (; client_.receive(text_, Clock::now(), stop_); ++dropped) {
      if (dropped == kMostUnasked)
        throw Error(fmt::format("haply: device '{}': states that nobody asked for", device_id_));
    }
    return dropped > 0;
  }

  void await_state(Clock::time_point until) {
    if (receive_state(until)) return;
    throw Error(fmt::format("haply: no state from {}:{} within {} s", config_.host, config_.port,
                            number_text(config_.open_timeout_s)));
  }

  void send(const Eigen::Vector3d& force_N, bool first, Clock::time_point until) {
    write_haply_command(text_, device_id_, R_device_service_.transpose() * force_N, force_key_, first);
    client_.send(text_, until);
    questions_.ask(Clock::now());
    has_pushed_ = has_pushed_ || !force_N.isZero();
  }

  // The watch begins with the first force: opening may take longer than it allows.
  void beat() {
    if (!has_pushed_ || supervisor_->beat()) return;
    throw Error(
        fmt::format("haply: device '{}': this process was stopped and its force was ended, or the process that "
                    "watches it has ended",
                    device_id_));
  }

  // As receive_state(); who waits is there, however long it takes.
  bool receive_state_beating(Clock::time_point until) {
    constexpr auto kSlice = std::chrono::milliseconds(20);
    while (true) {
      const auto slice = std::min(until, Clock::now() + kSlice);
      const bool received = receive_state(slice);
      beat();
      if (received) return true;
      if (slice == until || stop_.load()) return false;
    }
  }

  void pass_on() { news_.publish({R_device_service_ * state_.p_m, R_device_service_ * state_.v_mps, ++sequence_}); }

  void serve_and_leave() {
    run([this] { serve(); });
    try {
      send_last_force();
    } catch (const std::exception&) {
      // The connection is gone, and the force with it: the service holds none beyond its session.
    }
    // It holds the connection open, too.
    supervisor_.reset();
    client_.close(Clock::now() + seconds(0.1));
  }

  void serve() {
    const auto lost_after = seconds(config_.lost_after_s), period = seconds(1.0 / config_.max_rate_Hz);
    const auto force_timeout = seconds(config_.force_timeout_s), stall_after = seconds(config_.stall_after_s);
    auto last_state = Clock::now(), last_current = last_state, last_answer = last_state, next_send = last_state;
    bool zero_sent = false;
    // A state that nobody asked for may have others behind it that are still to come: taken for an answer, each of them
    // would have a message sent, and where the service is late these wait there, and the forces in them. So the next
    // message waits for silence, though not so long that the force stalls.
    const auto wait_for_silence = [&](Clock::time_point now) {
      next_send = std::max(next_send, std::min(now + kSilence, last_answer + stall_after));
    };
    while (!stop_.load()) {
      auto now = Clock::now();
      if (now - last_state > OpenQuestions::kGiveUpAfter) questions_.give_up();
      if (questions_.open() == 0 && now >= next_send) {
        if (drop_unasked()) wait_for_silence(now);
        if (now >= next_send) {
          send(zero_sent ? Eigen::Vector3d::Zero() : forces_.take(now, force_timeout), false, now + lost_after);
          next_send = std::max(next_send + period, now);
        }
      }
      const auto silent_at = (zero_sent ? now : last_state) + stall_after;
      const bool asked = questions_.open() > 0;
      if (receive_state_beating(asked ? silent_at : next_send)) {
        last_state = Clock::now();
        if (asked) {
          last_answer = last_state;
        } else {
          wait_for_silence(last_state);
        }
        if (current_) {
          pass_on();
          last_current = last_state;
          zero_sent = false;
        }
      }
      now = Clock::now();
      if (now - last_current > lost_after) fail_late(last_state == last_current);
      if (questions_.open() > 0 && now - last_state >= stall_after && !zero_sent) {
        // A service that wakes finds a zero force behind the stale one. Its answers are then two.
        send(Eigen::Vector3d::Zero(), false, last_state + lost_after);
        zero_sent = true;
      }
    }
  }

  [[noreturn]] void fail_late(bool silent) const {
    if (silent) {
      throw Error(fmt::format("haply: device '{}': no state for {} s", device_id_, number_text(config_.lost_after_s)));
    }
    throw Error(fmt::format("haply: device '{}': its states come {} ms late", device_id_,
                            std::chrono::round<std::chrono::milliseconds>(questions_.last_age()).count()));
  }

  void send_last_force() {
    const auto until = Clock::now() + seconds(0.2);
    const std::atomic<bool> never = false;
    send(Eigen::Vector3d::Zero(), false, until);
    while (questions_.open() > 0 && client_.receive(text_, until, never)) questions_.answer(Clock::now());
  }

  HaplyConfig config_;
  Eigen::Matrix3d R_device_service_;

  // The I/O thread's.
  InverseServiceClient client_;
  HaplyForceKey force_key_ = HaplyForceKey::kVector;
  std::string device_id_, text_;
  HaplyState state_;
  OpenQuestions questions_{seconds(config_.late_after_s)};
  bool current_ = false;
  bool has_pushed_ = false;
  std::optional<Supervisor> supervisor_;
  std::uint64_t sequence_ = 0;
  std::thread thread_;
};

}  // namespace

std::unique_ptr<HapticDevice> open_haply(const HaplyConfig& config) {
  check_config("haply", config);
  return std::make_unique<HaplyDevice>(config);
}

}  // namespace asperity
