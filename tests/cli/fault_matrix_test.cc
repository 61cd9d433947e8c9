// Backend × fault on the program: the force is at zero in time, or no larger than before. Each cell prints a row;
// FAULT_MATRIX=FILE appends them to a file, from which scripts/fault_matrix makes the table of docs/safety.md.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "fake_inverse_service.h"
#include "fake_two_diy_board.h"
#include "feel_fixture.h"

namespace asperity::cli {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double kAway_m = 12e-3;  // of the wall: half a second for the pulled hand, so that the loop runs before
constexpr double kPromised_ms = 150.0;
constexpr double kKick_N = 0.1;
constexpr double kLargest_N = 5.1;  // safety.max_force_N, and what the board's float rounds

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

void tell(const std::string& device, const std::string& fault, const std::string& measured) {
  const std::string row = fmt::format("| {} | {} | {} |\n", device, fault, measured);
  std::fputs(row.c_str(), stdout);
  if (const char* file = ::getenv("FAULT_MATRIX")) std::ofstream(file, std::ios::app) << row;
}

enum class Demand {
  kZeroInTime,  // the force is zero within 150 ms
  kBounded,     // it is finite, within the safety limit, and told as it was measured
  kNoKick,      // it may stay, but never rises 0.1 N above what it was
};

struct Fault {
  const char* name;
  Demand demand;
  std::function<void(pid_t)> begin;
};

class FaultMatrix : public FeelCommands {
 protected:
  // Runs the program against a wall, lets the fault begin once force is held, and watches the device for a second.
  // `force_N` is the force that the device gives now.
  void check(const std::string& device, const std::vector<std::string>& words, const Fault& fault,
             const std::function<double()>& force_N) {
    double before_N = 0.0, most_N = 0.0, zero_ms = -1.0, last_N = -1.0;
    const Outcome outcome = run_and_meddle(words, [&](pid_t process) {
      const auto start = Clock::now();
      while (ms_since(start) < 10e3 && !(force_N() > 0.3)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      for (const auto held = Clock::now(); ms_since(held) < 300.0;) {
        before_N = std::max(before_N, force_N());
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
      const auto fault_begins = Clock::now();
      fault.begin(process);
      while (ms_since(fault_begins) < 1000.0) {
        last_N = force_N();
        most_N = std::max(most_N, last_N);
        if (last_N > 0.0) zero_ms = -1.0;
        if (last_N == 0.0 && zero_ms < 0.0) zero_ms = ms_since(fault_begins);
        std::this_thread::sleep_for(std::chrono::microseconds(500));
      }
      ::kill(process, SIGCONT);
      ::kill(process, SIGTERM);
    });
    const std::string name = device + ", " + fault.name + ": " + outcome.err;
    ASSERT_GT(before_N, 0.3) << name;
    EXPECT_TRUE(outcome.code < 128 || outcome.code == 128 + SIGTERM) << name;
    EXPECT_LT(most_N, fault.demand == Demand::kBounded ? kLargest_N : before_N + kKick_N) << name;
    if (fault.demand == Demand::kZeroInTime) {
      EXPECT_EQ(last_N, 0.0) << name;
      EXPECT_GE(zero_ms, 0.0) << name;
      EXPECT_LT(zero_ms, kPromised_ms) << name;
      tell(device, fault.name, fmt::format("zero after {:.0f} ms", zero_ms));
    } else {
      tell(device, fault.name,
           fmt::format("{:+.2f} N at most{}", most_N - before_N,
                       zero_ms >= 0.0 ? fmt::format(", zero after {:.0f} ms", zero_ms) : ""));
    }
  }

  // A block between two corners, as block.obj in metres, felt where the device is.
  std::vector<std::string> feel_block(const Eigen::Vector3d& low_m, const Eigen::Vector3d& high_m,
                                      const std::string& device, const std::string& port) {
    std::string obj;
    for (const double z : {low_m.z(), high_m.z()}) {
      for (const double y : {low_m.y(), high_m.y()}) {
        for (const double x : {low_m.x(), high_m.x()}) obj += fmt::format("v {} {} {}\n", x, y, z);
      }
    }
    obj += "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
    write_text(path("block.obj"), obj);
    return {"feel",        path("block.obj"),
            "--mesh-unit", "m",
            "--device",    device,
            "--set",       port,
            "--duration",  "60s",
            "--set",       "servo.frame.translation_m=[1e-9, 0, 0]"};
  }
};

Fault by_signal(const char* name, int signal) {
  return {name, Demand::kZeroInTime, [signal](pid_t process) { ::kill(process, signal); }};
}

TEST_F(FaultMatrix, TwoDiy) {
  FakeTwoDiyBoard* board = nullptr;
  const auto trouble = [&](const char* name, Demand demand, BoardTrouble kind) {
    return Fault{name, demand, [&board, kind](pid_t) { board->trouble(kind); }};
  };
  const std::vector<Fault> faults{
      by_signal("SIGSTOP", SIGSTOP),
      trouble("does not answer", Demand::kZeroInTime, BoardTrouble::kMute),
      {"unplugged", Demand::kZeroInTime, [&](pid_t) { board->unplug(); }},
      {"garbage", Demand::kZeroInTime, [&](pid_t) { board->answer_nonsense(); }},
      trouble("glitch: 8 readings 30 mm off", Demand::kNoKick, BoardTrouble::kGlitch),
      trouble("each answer twice", Demand::kNoKick, BoardTrouble::kDuplicate),
      trouble("60 ms late", Demand::kBounded, BoardTrouble::kLate),
      trouble("four answers for one", Demand::kNoKick, BoardTrouble::kFast),
      trouble("out of order", Demand::kNoKick, BoardTrouble::kOutOfOrder),
  };
  for (const Fault& fault : faults) {
    FakeTwoDiyBoard fresh;
    board = &fresh;
    const double near_m = fresh.p_m().y() + kAway_m;
    check("2diy", feel_block({-0.1, -0.1, near_m}, {0.1, 0.1, near_m + 0.1}, "2diy", "2diy.port=" + fresh.port()),
          fault, [&] { return fresh.torque_N_m().norm() > 0.0 ? fresh.force_N().norm() : 0.0; });
  }
}

TEST_F(FaultMatrix, Haply) {
  FakeInverseService* service = nullptr;
  const std::vector<Fault> faults{
      by_signal("SIGSTOP", SIGSTOP),
      {"does not answer", Demand::kZeroInTime, [&](pid_t) { service->stall(true); }},
      {"unplugged", Demand::kZeroInTime, [&](pid_t) { service->unplug(); }},
      {"connection cut", Demand::kZeroInTime, [&](pid_t) { service->drop(); }},
      {"garbage", Demand::kZeroInTime, [&](pid_t) { service->answer_with("not json"); }},
      {"60 ms late", Demand::kBounded, [&](pid_t) { service->answer_after(std::chrono::milliseconds(60)); }},
      {"20 ms late", Demand::kBounded, [&](pid_t) { service->answer_after(std::chrono::milliseconds(20)); }},
  };
  for (const Fault& fault : faults) {
    FakeInverseService fresh;
    service = &fresh;
    check("haply",
          feel_block({-0.1, -0.1, -0.1}, {0.1, -kAway_m, 0.1}, "haply", fmt::format("haply.port={}", fresh.port())),
          fault, [&] { return fresh.applied_N().norm(); });
  }
}

}  // namespace
}  // namespace asperity::cli
