#include "played_device.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>

#include "asperity/testkit/temp_dir.h"
#include "fake_drivers.h"
#include "fake_inverse_service.h"
#include "fake_two_diy_board.h"
#include "fakes/fake_controller.h"

namespace asperity::cli {

namespace {

constexpr std::int64_t kSuspended_ns = 10'000'000'000;

class PlayedTwoDiy final : public PlayedDevice {
 public:
  explicit PlayedTwoDiy(double away_m) {
    const double near_m = board_.p_m().y() + away_m;
    low_m = {-0.1, -0.1, near_m};
    high_m = {0.1, 0.1, near_m + 0.1};
  }

  std::string setting() const override { return "2diy.port=" + board_.port(); }
  double force_N() const override { return board_.torque_N_m().norm() > 0.0 ? board_.force_N().norm() : 0.0; }

 private:
  void trouble(FaultKind kind) override {
    switch (kind) {
      case FaultKind::kUnplug:
        return board_.unplug();
      case FaultKind::kGarbage:
        return board_.answer_nonsense();
      case FaultKind::kHang:
        return board_.trouble(BoardTrouble::kMute);
      case FaultKind::kGlitch:
        return board_.trouble(BoardTrouble::kGlitch);
      case FaultKind::kDuplicate:
        return board_.trouble(BoardTrouble::kDuplicate);
      case FaultKind::kLate:
        return board_.trouble(BoardTrouble::kLate);
      case FaultKind::kSlow:
        return board_.trouble(BoardTrouble::kSlow);
      case FaultKind::kFast:
        return board_.trouble(BoardTrouble::kFast);
      default:
        return board_.trouble(BoardTrouble::kOutOfOrder);
    }
  }

  FakeTwoDiyBoard board_;
};

class PlayedHaply final : public PlayedDevice {
 public:
  explicit PlayedHaply(double away_m) {
    low_m = {-0.1, -0.1, -0.1};
    high_m = {0.1, -away_m, 0.1};
  }

  std::string setting() const override { return fmt::format("haply.port={}", service_.port()); }
  double force_N() const override { return service_.applied_N().norm(); }

 private:
  void trouble(FaultKind kind) override {
    switch (kind) {
      case FaultKind::kUnplug:
        return service_.unplug();
      case FaultKind::kCut:
        return service_.drop();
      case FaultKind::kGarbage:
        return service_.answer_with("not json");
      case FaultKind::kHang:
        return service_.stall(true);
      case FaultKind::kLate:
        return service_.answer_after(std::chrono::milliseconds(60));
      case FaultKind::kSlow:
        return service_.answer_after(std::chrono::milliseconds(15));
      case FaultKind::kGlitch:
        return service_.trouble(ServiceTrouble::kGlitch);
      case FaultKind::kDuplicate:
        return service_.trouble(ServiceTrouble::kDuplicate);
      case FaultKind::kFast:
        return service_.trouble(ServiceTrouble::kFast);
      default:
        return service_.trouble(ServiceTrouble::kOutOfOrder);
    }
  }

  FakeInverseService service_;
};

// The driver is a fake in the program itself; its controller is a page that both see, and obeys its watchdog here.
class PlayedDhd final : public PlayedDevice {
 public:
  explicit PlayedDhd(double away_m) {
    low_m = {-0.1, -0.1, -0.1};
    high_m = {0.1, kStart_m - away_m, 0.1};
    const std::string path = (dir_ / "controller").string();
    std::ofstream(path, std::ios::binary) << std::string(sizeof(fake::Controller), '\0');
    const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
    void* const at = ::mmap(nullptr, sizeof(fake::Controller), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    ::close(file);
    if (at == MAP_FAILED) throw std::runtime_error("no shared page");
    controller_ = static_cast<fake::Controller*>(at);
    ::setenv("FAKE_DHD_CONTROLLER", path.c_str(), 1);
  }
  ~PlayedDhd() override {
    ::unsetenv("FAKE_DHD_CONTROLLER");
    ::munmap(controller_, sizeof(fake::Controller));
  }

  std::string setting() const override { return std::string("dhd.library=") + FAKE_DHD; }

  double force_N() const override {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    const std::chrono::nanoseconds silence = now - std::chrono::nanoseconds(controller_->set_at_ns);
    const auto patience = std::chrono::microseconds(125) * controller_->watchdog_steps;
    const bool off = controller_->enabled == 0 || controller_->trouble == fake::Controller::kUnplugged ||
                     (controller_->watchdog_steps > 0 && silence > patience);
    return off ? 0.0 : Eigen::Vector3d(controller_->force_N).norm();
  }

 private:
  static constexpr double kStart_m = 0.02;  // where the fake's hand begins

  void trouble(FaultKind kind) override {
    controller_->trouble = kind == FaultKind::kHang     ? fake::Controller::kHangs
                           : kind == FaultKind::kUnplug ? fake::Controller::kUnplugged
                           : kind == FaultKind::kGlitch ? fake::Controller::kGlitch
                                                        : fake::Controller::kGarbage;
  }

  testkit::TempDir dir_;
  fake::Controller* controller_ = nullptr;
};

// The driver is a fake in a process of its own, whose state is a file that the test sees too. Its device holds the last
// force while the connection lasts.
class PlayedOpenHaptics final : public PlayedDevice {
 public:
  explicit PlayedOpenHaptics(double away_m) {
    low_m = {-0.1, -0.1, -0.1};
    high_m = {0.1, kStart_m - away_m, 0.1};
  }

  std::string setting() const override { return std::string("openhaptics.library=") + FAKE_HD; }
  double force_N() const override { return fake_.motor_N().norm(); }

 private:
  static constexpr double kStart_m = 0.02;  // where the fake's hand begins

  void trouble(FaultKind kind) override {
    switch (kind) {
      case FaultKind::kDriverStopped:
        ::kill(fake_.process(), SIGSTOP);
        return;
      case FaultKind::kDriverKilled:
        ::kill(fake_.process(), SIGKILL);
        return;
      case FaultKind::kHang:
        return fake_.set("hangs", 1);
      case FaultKind::kUnplug:
        return fake_.set("unplugged", 1);
      case FaultKind::kGlitch:
        return fake_.set("glitch", 1);
      default:
        return fake_.set("garbage", 1);
    }
  }

  testing_devices::FakeOpenHaptics fake_{FAKE_HD};
};

}  // namespace

void PlayedDevice::begin(FaultKind kind, pid_t program, const std::filesystem::path& clock_ahead) {
  if (kind == FaultKind::kStop) {
    ::kill(program, SIGSTOP);
  } else if (kind == FaultKind::kKill) {
    ::kill(program, SIGKILL);
  } else if (kind == FaultKind::kSuspend) {
    // In place: the program has the file mapped.
    std::fstream file(clock_ahead, std::ios::binary | std::ios::in | std::ios::out);
    file.write(reinterpret_cast<const char*>(&kSuspended_ns), sizeof kSuspended_ns);
  } else {
    trouble(kind);
  }
}

std::unique_ptr<PlayedDevice> play_device(std::string_view name, double away_m) {
  if (name == "2diy") return std::make_unique<PlayedTwoDiy>(away_m);
  if (name == "dhd") return std::make_unique<PlayedDhd>(away_m);
  if (name == "openhaptics") return std::make_unique<PlayedOpenHaptics>(away_m);
  return std::make_unique<PlayedHaply>(away_m);
}

std::string block_obj(const Eigen::Vector3d& low_m, const Eigen::Vector3d& high_m) {
  std::string obj;
  for (const double z : {low_m.z(), high_m.z()}) {
    for (const double y : {low_m.y(), high_m.y()}) {
      for (const double x : {low_m.x(), high_m.x()}) obj += fmt::format("v {} {} {}\n", x, y, z);
    }
  }
  return obj + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
}

}  // namespace asperity::cli
