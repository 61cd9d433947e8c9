#include "asperity/device/open_two_diy.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <numbers>
#include <optional>
#include <span>
#include <thread>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/device/supervisor.h"
#include "asperity/device/velocity_estimator.h"
#include "asperity/transport/serial_port.h"
#include "check_config.h"
#include "io_device.h"
#include "open_questions.h"
#include "pantograph.h"
#include "two_diy_answer.h"

namespace asperity {

namespace {

using Bytes = std::vector<unsigned char>;

constexpr unsigned char kReset = 0, kSetUp = 1, kTorques = 2;
constexpr unsigned char kBothPorts = 3;  // ports 1 and 2, a bit each

void append_float(Bytes& bytes, double value) {
  const auto number = static_cast<float>(value);
  unsigned char raw[sizeof number];
  std::memcpy(raw, &number, sizeof number);
  bytes.insert(bytes.end(), raw, raw + sizeof number);
}

class TwoDiy final : public IoDevice {
 public:
  explicit TwoDiy(const TwoDiyConfig& config)
      : IoDevice(config.stall_after_s),
        config_(config),
        port_({config.port, 115200, "2diy: " + printable(config.port, 200), "the board"}),
        answers_(id()) {
    linkage_ = {config.proximal_m, config.distal_m, config.base_m};
    noise_m_ = 2.0 * std::numbers::pi / config.encoder_counts * (config.proximal_m + config.distal_m);
    const double side = config.mirror_x ? -1.0 : 1.0;
    axes_.col(0) << side, 0.0, 0.0;
    if (config.plane == TwoDiyPlane::kTable) axes_.col(1) << 0.0, 0.0, 1.0;
    if (config.plane == TwoDiyPlane::kUpright) axes_.col(1) << 0.0, -1.0, 0.0;
    info_.name = "2diy";
    info_.model = "2diy at " + printable(config.port, 200);
    info_.rate_Hz = config.rate_Hz;
    const auto until = Clock::now() + std::chrono::seconds(1);
    set_up(until);
    while (news_sequence_ == 0) {
      if (questions_.open() == 0) ask(Eigen::Vector2d::Zero(), until);
      // A board that is being reset loses questions.
      if (!take_answer(std::min(until, Clock::now() + OpenQuestions::kGiveUpAfter))) questions_.give_up();
      if (news_sequence_ == 0 && Clock::now() >= until) fail_to_open();
    }
    supervisor_.emplace(port_.descriptor(), std::as_bytes(std::span(bytes_)));  // the last question had no torque
    thread_ = std::thread([this] { serve_and_leave(); });
  }

  ~TwoDiy() override { close(); }

  void close() noexcept override {
    stop_.store(true);
    if (thread_.joinable()) thread_.join();
    supervisor_.reset();
  }

 private:
  [[noreturn]] void fail_to_open() const {
    std::string why = ": no answer within a second";
    if (questions_.last_age() > Clock::duration::zero()) why = ": its answers come " + age_text() + " late";
    if (answers_.theta_deg()) why = ": its arms are in line, where its position is not known; move the handle";
    throw Error("2diy: " + printable(config_.port, 200) + why);
  }

  std::string age_text() const {
    const double age_ms = std::chrono::duration<double, std::milli>(questions_.last_age()).count();
    return number_text(std::round(age_ms)) + " ms";
  }

  unsigned char id() const { return static_cast<unsigned char>(config_.device_id); }

  void set_up(Clock::time_point until) {
    const unsigned char reset[] = {kReset, id()};
    port_.write(reset, until);
    bytes_ = {kSetUp, id()};
    for (int motors_then_encoders = 0; motors_then_encoders < 2; ++motors_then_encoders) {
      bytes_.push_back(kBothPorts);
      if (config_.directions) bytes_.insert(bytes_.end(), 2, 1);  // counter-clockwise, as the angles are
    }
    bytes_.insert(bytes_.end(), 2, 0);  // neither sensors nor PWM pins
    for (const double offset_deg : config_.offset_deg) {
      append_float(bytes_, offset_deg);
      append_float(bytes_, config_.encoder_counts);
    }
    port_.write(bytes_, until);
  }

  void ask(const Eigen::Vector2d& torque_N_m, Clock::time_point until) {
    bytes_ = {kTorques, id()};
    append_float(bytes_, torque_N_m.x());
    append_float(bytes_, torque_N_m.y());
    if (questions_.open() == 0) {
      answered_ = 0;
      port_.flush_input();  // nobody asked for what is there
    }
    port_.write(bytes_, until);
    questions_.ask(Clock::now());
  }

  // The next answer, if it is complete by `until`.
  bool take_answer(Clock::time_point until) {
    while (answered_ < answer_.size()) {
      const std::size_t count = port_.read(std::span(answer_).subspan(answered_), until);
      if (count == 0) return false;
      answered_ += count;
    }
    answered_ = 0;
    const auto now = Clock::now();
    const bool current = questions_.answer(now);
    const double t_s = std::chrono::duration<double>(now - begin_).count();
    const TwoDiyAnswers::Kind kind = answers_.take(answer_, t_s, current);
    if (kind == TwoDiyAnswers::Kind::kFault) {
      throw Error("2diy: " + printable(config_.port, 200) + ": its answers are not valid");
    }
    if (kind == TwoDiyAnswers::Kind::kRefused || !current) return true;
    state_ = pantograph_state(linkage_, *answers_.theta_deg() * (std::numbers::pi / 180.0));
    // With its arms in line the place is not known: no news, so that the servo ramps down and starts softly again.
    if (!state_) return true;
    p_m_ = axes_ * state_->p_m;
    ++news_sequence_;
    news_.publish({p_m_, estimate_velocity(velocity_, p_m_, news_sequence_, t_s, noise_m_), news_sequence_});
    return true;
  }

  Eigen::Vector2d torque_N_m(const Eigen::Vector3d& force_N) const {
    if (!state_) return Eigen::Vector2d::Zero();
    Eigen::Vector2d torque = state_->jacobian_m.transpose() * (axes_.transpose() * force_N);
    const double most = torque.cwiseAbs().maxCoeff();
    if (most > config_.max_torque_N_m) torque *= config_.max_torque_N_m / most;
    return torque;
  }

  void serve_and_leave() {
    run([this] { serve(); });
    try {
      const auto until = Clock::now() + std::chrono::milliseconds(100);
      ask(Eigen::Vector2d::Zero(), until);
      take_answer(until);
      const unsigned char reset[] = {kReset, id()};
      port_.write(reset, until);
    } catch (const std::exception&) {
      // The port is gone: nobody can be told any more.
    }
  }

  // The watch begins with the first force: until then the board holds none, and locking the program's memory may stop
  // this thread for longer than the watch allows.
  void beat() {
    if (!has_pushed_ || supervisor_->beat()) return;
    throw Error("2diy: " + printable(config_.port, 200) +
                ": this process was stopped and its force was ended, or the process that watches it has ended");
  }

  // Until every question was answered; false if one was not by `until`. Who waits is there, however long it takes.
  bool take_answers_beating(Clock::time_point until) {
    constexpr auto kSlice = std::chrono::milliseconds(20);
    while (questions_.open() > 0) {
      const auto slice = std::min(until, Clock::now() + kSlice);
      if (take_answer(slice)) {
        heard_at_ = Clock::now();
      } else if (slice == until) {
        return false;
      }
      beat();
    }
    return true;
  }

  void serve() {
    const auto period = seconds(1.0 / config_.rate_Hz), force_timeout = seconds(config_.force_timeout_s);
    const auto stall_after = seconds(config_.stall_after_s), lost_after = seconds(config_.lost_after_s);
    auto due = Clock::now(), last_current = due;
    heard_at_ = due;
    bool stalled = false, zero_asked = false;
    while (!stop_.load()) {
      beat();
      auto now = Clock::now();
      if (now - heard_at_ > OpenQuestions::kGiveUpAfter) questions_.give_up();
      if (questions_.open() == 0 || (stalled && !zero_asked)) {
        // After a stall a question only asks: its torques would be of a place long left.
        const Eigen::Vector2d torque = stalled ? Eigen::Vector2d::Zero() : torque_N_m(forces_.take(now, force_timeout));
        if (!has_pushed_ && !torque.isZero(0.0)) {
          has_pushed_ = true;
          beat();
        }
        ask(torque, now + lost_after);
        zero_asked = stalled;
      }
      const bool answered = take_answers_beating(now + stall_after);
      now = Clock::now();
      if (!answered && !stalled) zero_asked = false;
      stalled = !answered || (stalled && !questions_.trusted());
      if (questions_.trusted() && answered) last_current = now;
      if (now - last_current > lost_after) fail_late(heard_at_ <= last_current);
      due = std::max(due + period, now);
      std::this_thread::sleep_until(due);
    }
  }

  [[noreturn]] void fail_late(bool silent) const {
    throw Error("2diy: " + printable(config_.port, 200) +
                (silent ? ": no answer for " + number_text(config_.lost_after_s) + " s"
                        : ": its answers come " + age_text() + " late"));
  }

  TwoDiyConfig config_;
  PantographConfig linkage_;
  Eigen::Matrix<double, 3, 2> axes_ = Eigen::Matrix<double, 3, 2>::Zero();  // its x and y in the device's axes
  double noise_m_ = 0.0;

  // The thread's that opens, then the I/O thread's.
  SerialPort port_;
  std::optional<Supervisor> supervisor_;
  Bytes bytes_;
  std::array<unsigned char, kTwoDiyAnswer_bytes> answer_{};
  std::size_t answered_ = 0;  // bytes of the next answer
  OpenQuestions questions_{seconds(config_.late_after_s)};
  Clock::time_point heard_at_;
  bool has_pushed_ = false;
  TwoDiyAnswers answers_;
  std::optional<PantographState> state_;
  Eigen::Vector3d p_m_ = Eigen::Vector3d::Zero();
  VelocityEstimator velocity_;
  std::uint64_t news_sequence_ = 0;
  Clock::time_point begin_ = Clock::now();
  std::thread thread_;
};

}  // namespace

std::unique_ptr<HapticDevice> open_two_diy(const TwoDiyConfig& config) {
  check_config("2diy", config);
  if (config.port.empty()) throw Error("2diy.port: the serial port is missing, as in /dev/ttyACM0");
  return std::make_unique<TwoDiy>(config);
}

}  // namespace asperity
