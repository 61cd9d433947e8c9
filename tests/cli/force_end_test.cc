// No force outlives attention: the program feels a wall with a 2diy, whose board holds its last torques for ever, and
// is stopped, suspended or ended in every way that a signal has.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "asperity/base/text.h"
#include "asperity/testkit/lateness_watch.h"
#include "fake_two_diy_board.h"
#include "feel_fixture.h"

namespace asperity::cli {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double kPromised_ms = 150.0;
constexpr double kNotHeld_ms =
    1e9;  // on a busy machine the hand is in the block before the loop runs, and feels nothing

class ForceEnd : public FeelCommands, public testing::WithParamInterface<int> {
 protected:
  // A new hand and a block 12 mm before it, against which it is pulled: half a second, so that the loop runs before.
  // Farther away each time: a busy machine needs longer.
  void begin() {
    board_ = std::make_unique<FakeTwoDiyBoard>();
    const double near_m = board_->p_m().y() + 12e-3 * ++begun_;
    std::string obj;
    for (const double z : {near_m, near_m + 0.1}) {
      for (const double y : {-0.1, 0.1}) {
        for (const double x : {-0.1, 0.1}) {
          obj += "v " + number_text(x) + " " + number_text(y) + " " + number_text(z) + "\n";
        }
      }
    }
    obj += "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
    write_text(path("block.obj"), obj);
  }

  std::vector<std::string> words() {
    return {"feel",        path("block.obj"),
            "--mesh-unit", "m",
            "--device",    "2diy",
            "--set",       "2diy.port=" + board_->port(),
            "--duration",  "60s",
            "--set",       "servo.frame.translation_m=[1e-9, 0, 0]"};
  }

  // ms until the torque is there, or is not; 10 s at most.
  double wait_for(bool torque) const {
    const auto start = Clock::now();
    const auto since_ms = [&] { return std::chrono::duration<double, std::milli>(Clock::now() - start).count(); };
    while (since_ms() < 10e3 && (board_->torque_N_m().norm() > 0.0) != torque) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return since_ms();
  }

  std::unique_ptr<FakeTwoDiyBoard> board_;
  int begun_ = 0;
};

class StoppedForce : public ForceEnd {};

// A sanitizer would take the signal and end the program with a code of its own.
void leave_faults_to_the_kernel() {
  for (const char* name : {"ASAN_OPTIONS", "TSAN_OPTIONS"}) {
    const char* before = ::getenv(name);
    ::setenv(name, ((before == nullptr ? "" : std::string(before) + ":") + "handle_segv=0").c_str(), 1);
  }
}

TEST_P(ForceEnd, ASignalThatEndsUs) {
  if (GetParam() == SIGSEGV) leave_faults_to_the_kernel();
  const auto measure_ms = [&] {
    begin();
    double zero_ms = -1.0;
    bool held = false;
    const Outcome outcome = run_and_meddle(words(), [&](pid_t process) {
      wait_for(true);
      held = board_->torque_N_m().norm() > 0.0;
      ::kill(process, GetParam());
      zero_ms = wait_for(false);
    });
    if (!held) return kNotHeld_ms;
    EXPECT_EQ(outcome.code, 128 + GetParam()) << outcome.err;
    return zero_ms;
  };
  EXPECT_LT(testkit::measure_on_a_free_machine(kPromised_ms, measure_ms), kPromised_ms);
}

std::string signal_name(const testing::TestParamInfo<int>& info) {
  return std::string("SIG") + sigabbrev_np(info.param);
}
INSTANTIATE_TEST_SUITE_P(TwoDiy, ForceEnd,
                         testing::Values(SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGTSTP, SIGKILL, SIGSEGV, SIGABRT),
                         signal_name);

INSTANTIATE_TEST_SUITE_P(TwoDiyStops, StoppedForce, testing::Values(SIGSTOP), signal_name);
TEST_P(StoppedForce, WakesUpToAFault) {
  const auto measure_ms = [&] {
    begin();
    double zero_ms = -1.0, later_N_m = -1.0;
    bool held = false;
    const Outcome outcome = run_and_meddle(words(), [&](pid_t process) {
      wait_for(true);
      held = board_->torque_N_m().norm() > 0.0;
      ::kill(process, held ? SIGSTOP : SIGTERM);
      if (!held) return;
      zero_ms = wait_for(false);
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
      later_N_m = board_->torque_N_m().norm();
      ::kill(process, SIGCONT);
    });
    if (!held) return kNotHeld_ms;
    EXPECT_EQ(later_N_m, 0.0);
    EXPECT_EQ(board_->torque_N_m().norm(), 0.0);
    EXPECT_NE(outcome.code, 0);
    EXPECT_THAT(outcome.err, testing::HasSubstr("fault"));
    return zero_ms;
  };
  EXPECT_LT(testkit::measure_on_a_free_machine(kPromised_ms, measure_ms), kPromised_ms);
}

}  // namespace
}  // namespace asperity::cli
