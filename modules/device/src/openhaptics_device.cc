#include "asperity/device/openhaptics_device.h"

#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <thread>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "check_config.h"
#include "driver_process.h"
#include "hd_api.h"
#include "hd_mailbox.h"
#include "openhaptics_in_time.h"
#include "real_time.h"
#include "single_owner.h"
#include "stall_watch.h"

namespace asperity {

namespace {

using std::chrono::milliseconds;

constexpr milliseconds kOpensWithin{30'000};
constexpr milliseconds kEndsWithin{1000};
constexpr milliseconds kRound{10};  // between two looks at the process
constexpr int kRoundsMissed = 5;  // that the driver must have missed besides: this thread may itself not have been run

std::atomic<bool> openhaptics_owned{false};

// A page that both processes see, and its file.
class SharedMailbox {
 public:
  SharedMailbox() : file_(::memfd_create("asperity_openhaptics", MFD_CLOEXEC)) {
    void* page = MAP_FAILED;
    if (file_ >= 0 && ::ftruncate(file_, sizeof(hd::Mailbox)) == 0) {
      page = ::mmap(nullptr, sizeof(hd::Mailbox), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_POPULATE, file_, 0);
    }
    if (page == MAP_FAILED) {
      const int error = errno;
      if (file_ >= 0) ::close(file_);
      throw Error(std::string("openhaptics: no shared memory: ") + std::strerror(error));
    }
    mailbox_ = new (page) hd::Mailbox;
  }
  ~SharedMailbox() {
    ::munmap(mailbox_, sizeof(hd::Mailbox));
    ::close(file_);
  }
  SharedMailbox(const SharedMailbox&) = delete;
  SharedMailbox& operator=(const SharedMailbox&) = delete;

  hd::Mailbox& operator*() const noexcept { return *mailbox_; }
  hd::Mailbox* operator->() const noexcept { return mailbox_; }
  int file() const noexcept { return file_; }

 private:
  int file_;
  hd::Mailbox* mailbox_ = nullptr;
};

template <std::size_t n>
void copy_name(const std::string& what, const std::string& name, std::array<char, n>& out) {
  if (name.size() >= n) throw Error("openhaptics." + what + " has more than " + std::to_string(n - 1) + " bytes");
  std::copy(name.begin(), name.end(), out.begin());
}

class OpenHapticsDevice final : public HapticDevice {
 public:
  OpenHapticsDevice(const OpenHapticsConfig& config, double hang_after_s)
      : owner_(openhaptics_owned, "openhaptics"), watch_(config.stall_after_s) {
    copy_name("library", config.library, mailbox_->library);
    copy_name("device", config.device, mailbox_->device);
    mailbox_->rate_Hz = config.rate_Hz;
    mailbox_->force_timeout_s = config.force_timeout_s;
    mailbox_->hang_after_s = hang_after_s;
    process_.emplace("asperity_openhaptics", mailbox_.file());
    wait_until_open();
    describe();
    watcher_ = std::thread([this] { watch_process(); });
  }

  ~OpenHapticsDevice() override { close(); }

  const DeviceInfo& info() const noexcept override { return info_; }

  DeviceReading read(std::int64_t t_ns) noexcept override {
    DeviceReading reading = mailbox_->readings.take();
    if (watch_.stalled(t_ns, reading.sequence)) reading.status = DeviceStatus::kStalled;
    if (closed_) reading.status = DeviceStatus::kEnded;
    if (lost_.load(std::memory_order_acquire) || mailbox_->fault_code.load(std::memory_order_relaxed) != 0) {
      reading.status = DeviceStatus::kFault;
    }
    return reading;
  }

  void write(const Eigen::Vector3d& force_N) noexcept override {
    if (closed_) return;
    command_.force_N = force_N.allFinite() ? force_N : Eigen::Vector3d::Zero();
    ++command_.sequence;
    mailbox_->commands.publish(command_);
  }

  void close() noexcept override {
    if (closed_) return;
    closed_ = true;
    mailbox_->ending.store(true, std::memory_order_release);
    stop_.store(true);
    if (watcher_.joinable()) watcher_.join();
    process_->send(hd::kClose);
    if (!process_->has_ended(kEndsWithin)) process_->kill();
  }

  std::string fault() const override {
    std::string out;
    const auto say = [&out](const std::string& words) { out += (out.empty() ? "" : "; ") + words; };
    if (lost_.load(std::memory_order_acquire)) say(why_lost_);
    if (const unsigned code = mailbox_->fault_code.load(); code != 0) say(hd::error_text(code));
    for (std::size_t i = 0; i < hd::kWarnings.size(); ++i) {
      if (mailbox_->warned[i].load()) say(hd::error_text(hd::kWarnings[i]));
    }
    if (const unsigned code = mailbox_->other_code.load(); code != 0) say(hd::error_text(code));
    return out;
  }

 private:
  void wait_until_open() {
    const auto until = std::chrono::steady_clock::now() + kOpensWithin;
    for (;;) {
      // In this order: what it wrote before its end is seen.
      const bool ended = process_->has_ended(kRound);
      const hd::Mailbox::State state = mailbox_->state.load();
      if (state == hd::Mailbox::State::kOpen) return;
      if (state == hd::Mailbox::State::kRefused) throw Error(mailbox_->refusal.data());
      if (ended) throw Error("openhaptics: the driver's process ended " + process_->end());
      if (std::chrono::steady_clock::now() > until) throw Error("openhaptics: the driver does not open within 30 s");
    }
  }

  void describe() {
    const hd::Description& told = mailbox_->description;
    info_.name = "openhaptics";
    info_.model = printable(told.model.data());
    info_.rate_Hz = told.rate_Hz;
    info_.max_force_N = told.max_force_N;
    info_.max_continuous_force_N = told.max_continuous_force_N;
    info_.max_stiffness_N_per_m = told.max_stiffness_N_per_m;
    info_.workspace_min_m = Eigen::Vector3d::Map(told.workspace_min_m.data());
    info_.workspace_max_m = Eigen::Vector3d::Map(told.workspace_max_m.data());
  }

  void lose(const std::string& why) {
    why_lost_ = why;
    lost_.store(true, std::memory_order_release);
  }

  // A thread of its own: the process that does not serve its driver is ended, and its end is the device's fault.
  void watch_process() {
    std::string refused;
    take_real_time_priority(refused);
    const std::string hung =
        "the driver has not returned for " + number_text(mailbox_->hang_after_s) + " s; its process was ended";
    std::uint64_t frames = 0;
    auto moved = std::chrono::steady_clock::now();
    int rounds = 0;
    while (!stop_.load()) {
      if (process_->has_ended(kRound)) {
        lose(mailbox_->hung.load() ? hung : "the driver's process ended " + process_->end());
        return;
      }
      const auto now = std::chrono::steady_clock::now();
      if (const std::uint64_t newest = mailbox_->frames.load(); newest != frames) {
        frames = newest;
        moved = now;
        rounds = 0;
      }
      // Its own watch is first where it runs.
      const bool silent = std::chrono::duration<double>(now - moved - kRound).count() > mailbox_->hang_after_s;
      if (++rounds <= kRoundsMissed || !silent) continue;
      process_->kill();
      lose(hung);
      return;
    }
  }

  SingleOwner owner_;
  SharedMailbox mailbox_;
  DeviceInfo info_;
  bool closed_ = false;

  // The servo thread's.
  StallWatch watch_;
  hd::Command command_;

  std::atomic<bool> stop_{false};
  std::atomic<bool> lost_{false};
  std::string why_lost_;  // before lost_
  std::optional<DriverProcess> process_;
  std::thread watcher_;
};

}  // namespace

std::unique_ptr<HapticDevice> open_openhaptics_in_time(const OpenHapticsConfig& config, double hang_after_s) {
  check_config("openhaptics", config);
  return std::make_unique<OpenHapticsDevice>(config, hang_after_s);
}

std::unique_ptr<HapticDevice> open_openhaptics(const OpenHapticsConfig& config) {
  return open_openhaptics_in_time(config, kOpenHapticsHangAfter_s);
}

}  // namespace asperity
