// Program × device × fault: the force is at zero in time, or no larger than before. Each cell prints a row;
// FAULT_MATRIX=FILE appends them to a file, from which scripts/fault_matrix makes the table of docs/safety-tests.md.
// FAULT_MATRIX_TALLY=FILE gets a line for each cell, "DEVICE measured" or "DEVICE open" (tests/fault_matrix).
#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "asperity/testkit/temp_dir.h"
#include "line_probe.h"
#include "played_device.h"
#include "run_asperity.h"
#include "studio_window.h"

namespace asperity::cli {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double kPromised_ms = 150.0;
constexpr double kKick_N = 0.1;
constexpr double kHolds_N = 0.3;   // the hand is against the block
constexpr double kSteady_N = 0.2;  // and rests there: the force varies by no more
// A machine that is busy with other things may itself make answers late. Such an attempt proves nothing: the test's own
// thread was not run, or its own line was late, for so long. What fails on such a machine alone is left open.
constexpr double kBusy_ms = 8.0;
constexpr int kAttempts = 6;
// The hand moves for half a second before it meets the block, so that the loop runs; a busy machine needs longer.
constexpr double kAway_m = 12e-3;

struct Cell {
  std::string program;  // "feel" or "studio"
  std::string device;
  FaultKind fault;

  std::string fault_name() const { return std::string(kFaultNames[static_cast<std::size_t>(fault)]); }
  // Else the force may stay.
  bool zero_in_time() const {
    return fault != FaultKind::kGlitch && fault != FaultKind::kDuplicate && fault != FaultKind::kFast;
  }
};

void PrintTo(const Cell& cell, std::ostream* out) {
  *out << cell.program << ", " << cell.device << ", " << cell.fault_name();
}

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// The played devices and who looks at them answer in time on a busy machine too, where the system permits it: threads
// that this one starts while the object lives have a priority below the servo's.
class InTime {
 public:
  InTime() { set(SCHED_FIFO, 60); }
  ~InTime() { set(SCHED_OTHER, 0); }
  InTime(const InTime&) = delete;
  InTime& operator=(const InTime&) = delete;

 private:
  static void set(int policy, int priority) {
    sched_param parameters{};
    parameters.sched_priority = priority;
    ::pthread_setschedparam(::pthread_self(), policy, &parameters);
  }
};

std::unique_ptr<PlayedDevice> play_in_time(const std::string& name, double away_m) {
  const InTime threads;
  return play_device(name, away_m);
}

// What the device gave from 0.3 s before the fault to 1 s after it.
struct Course {
  double before_N = 0.0, most_N = 0.0;
  double last_N = -1.0;   // −1: the hand did not come to rest before
  double zero_ms = -1.0;  // from when on it is zero
  double gap_ms = 0.0;    // the longest for which nobody looked, or a serial line of the test's own was late

  std::string turns;  // when the force was gone and there again

  bool proves() const { return last_N >= 0.0 && gap_ms < kBusy_ms; }
};

// Whether it is what is promised.
bool holds(const Cell& cell, const Course& course) {
  if (course.last_N < 0.0 || course.most_N >= course.before_N + kKick_N) return false;
  return !cell.zero_in_time() || (course.last_N == 0.0 && course.zero_ms >= 0.0 && course.zero_ms < kPromised_ms);
}

void tell(const Cell& cell, const Course& course) {
  const std::string kick = fmt::format("{:+.2f} N", course.most_N - course.before_N);
  const std::string zero = course.zero_ms >= 0.0 ? fmt::format("zero after {:.0f} ms", course.zero_ms) : "";
  const std::string bound = cell.zero_in_time() ? fmt::format("{:.0f} ms", kPromised_ms) : "";
  const std::string row = fmt::format("{}|{}|{}|{}|{}\n", cell.device, cell.fault_name(), bound, cell.program,
                                      zero.empty() ? kick : kick + ", " + zero);
  std::fputs(row.c_str(), stdout);
  if (const char* file = ::getenv("FAULT_MATRIX")) std::ofstream(file, std::ios::app) << row;
}

// The name of its test.
std::string name_of(const Cell& cell) {
  std::string name = cell.program + "_" + cell.device + "_" + cell.fault_name();
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return name;
}

void count(const Cell& cell, const char* how) {
  if (const char* file = ::getenv("FAULT_MATRIX_TALLY"))
    std::ofstream(file, std::ios::app) << cell.device + " " + how + " " + name_of(cell) + "\n";
}

class FaultMatrix : public testing::TestWithParam<Cell> {
 protected:
  std::string path(const std::string& name) const { return (dir_ / name).string(); }

  std::vector<std::string> words(const PlayedDevice& device) const {
    const std::vector<std::string> common{"--set", device.setting(), "--set", "servo.frame.translation_m=[1e-9, 0, 0]"};
    std::vector<std::string> out{"studio", dir_.path().string(), "--no-open"};
    if (GetParam().program == "feel") {
      out = {"feel", path("block.obj"), "--mesh-unit", "m", "--device", GetParam().device, "--duration", "60s"};
    }
    out.insert(out.end(), common.begin(), common.end());
    return out;
  }

  // A window of the studio that has begun to feel the block.
  std::unique_ptr<StudioWindow> begin_in_studio() const {
    auto window = std::make_unique<StudioWindow>(path("out"));
    window->edit("/feel/scene", "block.obj");
    window->edit("/feel/mesh_unit", "m");
    window->edit("/feel/device", GetParam().device);
    window->keep_lease();
    window->call("feel.start");
    return window;
  }

  Course watch(PlayedDevice& device, pid_t program) const {
    Course out;
    double least_N = 0.0, late_ms = 0.0;
    const auto start = Clock::now();
    auto looked = start;
    for (auto rests = start; ms_since(rests) < 300.0;) {
      late_ms = std::max(late_ms, ms_since(looked));
      looked = Clock::now();
      if (ms_since(start) > 8e3) {
        out.gap_ms = late_ms;
        return out;
      }
      const double now_N = device.force_N();
      if (out.before_N == 0.0) least_N = now_N;
      least_N = std::min(least_N, now_N);
      out.before_N = std::max(out.before_N, now_N);
      if (!(least_N > kHolds_N) || out.before_N - least_N > kSteady_N) {
        rests = Clock::now();
        out.before_N = 0.0;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    LineProbe line;
    const auto begins = Clock::now();
    device.begin(GetParam().fault, program, path("clock_ahead"));
    bool was_held = true;
    for (double last_ms = 0.0; last_ms < 1000.0;) {
      out.last_N = device.force_N();
      out.most_N = std::max(out.most_N, out.last_N);
      const double now_ms = ms_since(begins);
      const bool held = out.last_N > 0.0;
      if (held != was_held) out.turns += fmt::format(" {} at {:.1f} ms", held ? "force" : "zero", now_ms);
      was_held = held;
      if (out.last_N > 0.0) out.zero_ms = -1.0;
      if (out.last_N == 0.0 && out.zero_ms < 0.0) out.zero_ms = now_ms;
      out.gap_ms = std::max({out.gap_ms, now_ms - last_ms, line.longest_ms()});
      last_ms = now_ms;
      std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
    return out;
  }

  struct Attempt {
    Course course;
    Outcome outcome;
    std::string refused;
  };

  Attempt attempt(const Cell& cell, double away_m) const {
    const bool suspends = cell.fault == FaultKind::kSuspend;
    const std::unique_ptr<PlayedDevice> device = play_in_time(cell.device, away_m);
    write_text(path("block.obj"), block_obj(device->low_m, device->high_m));
    write_text(path("clock_ahead"), std::string(8, '\0'));
    std::filesystem::remove(path("out"));
    if (suspends) {
      ::setenv("LD_PRELOAD", CLOCK_SHIM, 1);
      ::setenv("CLOCK_AHEAD", path("clock_ahead").c_str(), 1);
    }
    Attempt out;
    const auto meddle = [&](pid_t program) {
      ::unsetenv("LD_PRELOAD");
      ::unsetenv("CLOCK_AHEAD");
      const InTime us;
      std::unique_ptr<StudioWindow> window;
      try {
        if (cell.program == "studio") window = begin_in_studio();
        out.course = watch(*device, program);
      } catch (const std::exception& error) {
        out.refused = error.what();
      }
      ::kill(program, SIGCONT);
      ::kill(program, SIGTERM);
    };
    out.outcome = run_and_meddle(words(*device), meddle, path("out"));
    return out;
  }

  testkit::TempDir dir_;
};

TEST_P(FaultMatrix, Cell) {
  const Cell& cell = GetParam();
  if (cell.fault == FaultKind::kSuspend && std::string_view(CLOCK_SHIM).empty())
    GTEST_SKIP() << "a sanitizer's runtime bears no preloaded shim";
  Attempt tried = attempt(cell, kAway_m);
  for (int i = 1; i < kAttempts && !tried.course.proves(); ++i) tried = attempt(cell, (1 + i) * kAway_m);
  const auto& [course, outcome, refused] = tried;
  ASSERT_EQ(refused, "") << outcome.err;
  if (course.gap_ms >= kBusy_ms && !holds(cell, course)) {
    count(cell, "open");
    GTEST_SKIP() << "the machine was busy: the test was late by " << course.gap_ms << " ms";
  }
  count(cell, "measured");
  ASSERT_GE(course.last_N, 0.0) << "the hand did not come to rest: " << outcome.err;
  const int ends_by = cell.fault == FaultKind::kKill ? SIGKILL : SIGTERM;
  EXPECT_TRUE(outcome.code < 128 || outcome.code == 128 + ends_by) << outcome.code << outcome.err;
  EXPECT_LT(course.most_N, course.before_N + kKick_N)
      << course.turns << "; the test was late by " << course.gap_ms << " ms; " << outcome.err;
  if (cell.zero_in_time()) {
    EXPECT_EQ(course.last_N, 0.0) << outcome.err;
    EXPECT_GE(course.zero_ms, 0.0) << outcome.err;
    EXPECT_LT(course.zero_ms, kPromised_ms)
        << course.turns << "; the test was late by " << course.gap_ms << " ms; " << outcome.err;
  }
  tell(cell, course);
}

std::vector<Cell> cells() {
  std::vector<Cell> out;
  // A maker's call returns one position: there is no answer that could come twice, late or in another order.
  const auto has = [](const std::string& device, FaultKind kind) {
    switch (kind) {
      case FaultKind::kDuplicate:
      case FaultKind::kLate:
      case FaultKind::kSlow:
      case FaultKind::kFast:
      case FaultKind::kOutOfOrder:
        return device == "2diy" || device == "haply";
      case FaultKind::kCut:
        return device == "haply";  // a 2diy's cable is the plug
      case FaultKind::kDriverStopped:
      case FaultKind::kDriverKilled:
        return device == "openhaptics";
      default:
        return true;
    }
  };
  for (const char* device : {"2diy", "haply", "dhd", "openhaptics"}) {
    for (std::size_t i = 0; i < kFaultNames.size(); ++i) {
      const auto kind = static_cast<FaultKind>(i);
      if (!has(device, kind)) continue;
      for (const char* program : {"feel", "studio"}) out.push_back({program, device, kind});
    }
  }
  return out;
}

INSTANTIATE_TEST_SUITE_P(Programs, FaultMatrix, testing::ValuesIn(cells()),
                         [](const auto& one) { return name_of(one.param); });

}  // namespace
}  // namespace asperity::cli
