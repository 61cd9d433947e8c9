#include "fake_two_diy_board.h"

#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <mutex>
#include <numbers>
#include <thread>
#include <utility>
#include <vector>

#include <Eigen/LU>

#include "asperity/base/error.h"

namespace asperity {

using Clock = std::chrono::steady_clock;

namespace {

constexpr double kProximal_m = 0.05, kDistal_m = 0.07, kBase_m = 0.02;
constexpr double kDegree = std::numbers::pi / 180.0;

double turn_between(double r_m) {
  return std::acos((kProximal_m * kProximal_m + r_m * r_m - kDistal_m * kDistal_m) / (2.0 * kProximal_m * r_m));
}

Eigen::Matrix2d dtheta_dp(const Eigen::Vector2d& p_m) {
  constexpr double kStep_m = 1e-6;
  Eigen::Matrix2d result;
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d step = kStep_m * Eigen::Vector2d::Unit(i);
    result.col(i) = (pantograph_angles_rad(p_m + step) - pantograph_angles_rad(p_m - step)) / (2.0 * kStep_m);
  }
  return result;
}

}  // namespace

Eigen::Vector2d pantograph_angles_rad(const Eigen::Vector2d& p_m) {
  const Eigen::Vector2d from2 = p_m - Eigen::Vector2d(kBase_m, 0.0);
  return {std::atan2(p_m.y(), p_m.x()) + turn_between(p_m.norm()),
          std::atan2(from2.y(), from2.x()) - turn_between(from2.norm())};
}

struct FakeTwoDiyBoard::Impl {
  explicit Impl(const FakeBoardConfig& new_config) : config(new_config) {
    master = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
    if (master < 0 || ::grantpt(master) != 0 || ::unlockpt(master) != 0) throw Error("no pseudo-terminal");
    char name[100];
    if (::ptsname_r(master, name, sizeof name) != 0) throw Error("no pseudo-terminal");
    path = name;
    // Held open: a terminal without any other side would report its end.
    slave = ::open(name, O_RDWR | O_NOCTTY | O_CLOEXEC);
    termios raw{};
    ::tcgetattr(slave, &raw);
    ::cfmakeraw(&raw);
    ::tcsetattr(slave, TCSANOW, &raw);
    thread = std::thread([this] { run(); });
  }

  ~Impl() {
    stopping = true;
    thread.join();
    ::close(slave);
    if (master >= 0) ::close(master);
  }

  void run() {
    while (!stopping) {
      if (gone) {
        if (master >= 0) ::close(master);
        master = -1;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        continue;
      }
      pollfd one{master, POLLIN, 0};
      ::poll(&one, 1, 2);
      unsigned char bytes[256];
      const ssize_t count = ::read(master, bytes, sizeof bytes);
      if (count > 0) came.insert(came.end(), bytes, bytes + count);
      if (!stalled) {
        while (take()) {
        }
      }
      const std::lock_guard lock(mutex);
      flush();
    }
  }

  float float_at(std::size_t place) const {
    float value = 0.0F;
    std::memcpy(&value, came.data() + place, sizeof value);
    return value;
  }

  // One message, if there is a whole one.
  bool take() {
    const std::lock_guard lock(mutex);
    if (came.size() < 2) return false;
    std::size_t length = 2;
    if (came[0] == 0) {
      ++resets;
      set_up = false;
      torque_N_m.setZero();
    } else if (came[0] == 1) {
      const std::size_t header = config.directions ? 10 : 6;
      length = header + 4 * sizeof(float);
      if (came.size() < length) return false;
      const bool masks = came[2] == 3 && came[config.directions ? 5 : 3] == 3;
      set_up = masks && came[header - 2] == 0 && came[header - 1] == 0;
      for (int i = 0; i < 2; ++i) {
        offset_deg[i] = static_cast<double>(float_at(header + 8 * static_cast<std::size_t>(i)));
        resolution[i] = static_cast<double>(float_at(header + 8 * static_cast<std::size_t>(i) + 4));
      }
    } else if (came[0] == 2) {
      length = 2 + 2 * sizeof(float);
      if (came.size() < length) return false;
      move();
      if (set_up) {
        torque_N_m = {static_cast<double>(float_at(2)), static_cast<double>(float_at(6))};
        answer(came[1]);
      }
    }
    came.erase(came.begin(), came.begin() + static_cast<std::ptrdiff_t>(length));
    return true;
  }

  void answer(unsigned char id) {
    const Eigen::Vector2d start_deg(180.0, 0.0);
    const Eigen::Vector2d turned_deg = pantograph_angles_rad(p_m) / kDegree - start_deg;
    unsigned char bytes[9] = {id};
    for (int i = 0; i < 2; ++i) {
      const double counts = std::round(turned_deg[i] / 360.0 * resolution[i]);
      const auto degrees = static_cast<float>(offset_deg[i] + counts * 360.0 / resolution[i]);
      std::memcpy(bytes + 1 + sizeof(float) * static_cast<std::size_t>(i), &degrees, sizeof degrees);
    }
    if (nonsense) std::memset(bytes, 0xff, sizeof bytes);
    send({bytes, bytes + sizeof bytes});
  }

  using Bytes = std::vector<unsigned char>;

  void send(Bytes bytes) {
    const BoardTrouble kind = trouble;
    if (kind == BoardTrouble::kMute) return;
    if (kind == BoardTrouble::kGlitch && glitches < 8) {
      ++glitches;
      for (const std::size_t place : {1U, 5U}) {
        float degrees = 0.0F;
        std::memcpy(&degrees, &bytes[place], sizeof degrees);
        degrees += place == 1U ? -25.0F : 25.0F;  // both arms: some 30 mm
        std::memcpy(&bytes[place], &degrees, sizeof degrees);
      }
    }
    if (kind == BoardTrouble::kOutOfOrder && held.empty()) {
      held = std::move(bytes);
      return;
    }
    const int late_ms = kind == BoardTrouble::kLate ? 60 : kind == BoardTrouble::kSlow ? 15 : 0;
    const auto due = Clock::now() + std::chrono::milliseconds(late_ms);
    const int copies = kind == BoardTrouble::kDuplicate ? 2 : kind == BoardTrouble::kFast ? 4 : 1;
    for (int i = 0; i < copies; ++i) outbox.emplace_back(due, bytes);
    if (!held.empty()) outbox.emplace_back(due, std::move(held));
    held.clear();
    flush();
  }

  void flush() {
    while (!outbox.empty() && outbox.front().first <= Clock::now()) {
      if (::write(master, outbox.front().second.data(), outbox.front().second.size()) < 0) gone = true;
      outbox.pop_front();
    }
  }

  void move() {
    constexpr double kStep_s = 1e-4;
    const auto now = Clock::now();
    if (moved_to + std::chrono::microseconds(100) > now) return;
    const Eigen::Matrix2d inverse = dtheta_dp(p_m);
    const Eigen::Vector2d at_tip_N = inverse.transpose() * torque_N_m;
    for (; moved_to + std::chrono::microseconds(100) <= now; moved_to += std::chrono::microseconds(100)) {
      v_mps += kStep_s / config.mass_kg * (pull_N() + at_tip_N - config.damping_N_s_per_m * v_mps);
      p_m += kStep_s * v_mps;
      // Lifted, it rests where it began.
      if (config.lifts_every_s > 0.0 && p_m.y() < begun_m.y()) {
        p_m.y() = begun_m.y();
        v_mps.setZero();
      }
      // The arms' reach.
      if (p_m.y() > 0.1) {
        p_m.y() = 0.1;
        v_mps.setZero();
      }
    }
  }

  Eigen::Vector2d pull_N() const {
    if (config.lifts_every_s <= 0.0) return config.pull_N;
    const double since_s = std::chrono::duration<double>(moved_to - begun).count();
    const bool lifts = std::fmod(since_s, config.lifts_every_s) > config.lifts_every_s * 2.0 / 3.0;
    return lifts ? Eigen::Vector2d(-config.pull_N) : config.pull_N;
  }

  FakeBoardConfig config;
  std::string path;
  int master = -1, slave = -1;
  std::thread thread;
  std::atomic<bool> stopping{false}, stalled{false}, gone{false}, nonsense{false};
  std::vector<unsigned char> came;

  std::atomic<BoardTrouble> trouble{BoardTrouble::kNone};
  int glitches = 0;
  Bytes held;
  std::deque<std::pair<Clock::time_point, Bytes>> outbox;

  mutable std::mutex mutex;
  bool set_up = false;
  int resets = 0;
  Eigen::Vector2d offset_deg = Eigen::Vector2d::Zero(), resolution = Eigen::Vector2d::Ones();
  Eigen::Vector2d torque_N_m = Eigen::Vector2d::Zero(), v_mps = Eigen::Vector2d::Zero();
  // The tip while the arms are at 180° and 0°: midway between the motors.
  Eigen::Vector2d p_m{0.5 * kBase_m, std::sqrt(kDistal_m* kDistal_m - std::pow(kProximal_m + 0.5 * kBase_m, 2))};
  Eigen::Vector2d begun_m = p_m;
  Clock::time_point begun = Clock::now(), moved_to = begun;
};

FakeTwoDiyBoard::FakeTwoDiyBoard(const FakeBoardConfig& config) : impl_(std::make_unique<Impl>(config)) {}
FakeTwoDiyBoard::~FakeTwoDiyBoard() = default;

std::string FakeTwoDiyBoard::port() const { return impl_->path; }

Eigen::Vector2d FakeTwoDiyBoard::p_m() const {
  const std::lock_guard lock(impl_->mutex);
  impl_->move();
  return impl_->p_m;
}

Eigen::Vector2d FakeTwoDiyBoard::torque_N_m() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->gone ? Eigen::Vector2d::Zero() : impl_->torque_N_m;
}

Eigen::Vector2d FakeTwoDiyBoard::force_N() const {
  const Eigen::Vector2d torque = torque_N_m();
  return dtheta_dp(p_m()).transpose() * torque;
}

int FakeTwoDiyBoard::resets() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->resets;
}

void FakeTwoDiyBoard::unplug() { impl_->gone = true; }
void FakeTwoDiyBoard::stall(bool on) { impl_->stalled = on; }
void FakeTwoDiyBoard::answer_nonsense() { impl_->nonsense = true; }
void FakeTwoDiyBoard::trouble(BoardTrouble kind) { impl_->trouble = kind; }

}  // namespace asperity
