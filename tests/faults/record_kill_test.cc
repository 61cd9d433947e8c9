// `asperity record` is killed at random moments: what it has loses at most the last 0.2 s. RECORD_KILLS says how many
// times; scripts/check takes 200.
#include <gmock/gmock.h>
#include <signal.h>
#include <stdlib.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <deque>
#include <fstream>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "asperity/base/host_clock.h"
#include "asperity/base/random.h"
#include "asperity/recording/read_recording.h"
#include "asperity/testkit/temp_dir.h"
#include "live_rig.h"
#include "run_asperity.h"

namespace asperity::cli {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

constexpr std::int64_t kLossAllowed_ns = 200'000'000;

// How long the machine lets a thread wait that wants to run every 5 ms, as the probe's here: not the recorder's loss.
class StallWatch {
 public:
  StallWatch() : thread_([this] { run(); }) {}
  ~StallWatch() {
    stop_ = true;
    thread_.join();
  }
  StallWatch(const StallWatch&) = delete;
  StallWatch& operator=(const StallWatch&) = delete;
  std::int64_t longest_ns() const { return longest_ns_; }

 private:
  void run() {
    while (!stop_) {
      const std::int64_t before_ns = host_now_ns();
      std::this_thread::sleep_for(milliseconds(5));
      longest_ns_ = std::max<std::int64_t>(longest_ns_, host_now_ns() - before_ns - 5'000'000);
    }
  }
  std::atomic<bool> stop_{false};
  std::atomic<std::int64_t> longest_ns_{0};
  std::thread thread_;
};

// How long each thread of a process has waited so far for a processor that it could have used, in ns.
std::map<std::string, std::int64_t> waits_ns(pid_t process) {
  std::map<std::string, std::int64_t> out;
  std::error_code error;
  for (const auto& task : fs::directory_iterator("/proc/" + std::to_string(process) + "/task", error)) {
    std::int64_t ran = 0, waited = 0;
    std::ifstream(task.path() / "schedstat") >> ran >> waited;
    out[task.path().filename().string()] = waited;
  }
  return out;
}

// Waits so long, and tells how much of the last 0.4 s of it the thread that was kept from running longest was kept.
std::int64_t wait_and_watch(pid_t process, milliseconds time) {
  std::deque<std::map<std::string, std::int64_t>> samples{waits_ns(process)};
  for (const auto end = std::chrono::steady_clock::now() + time; std::chrono::steady_clock::now() < end;) {
    std::this_thread::sleep_for(milliseconds(20));
    samples.push_back(waits_ns(process));
    if (samples.size() > 20) samples.pop_front();
  }
  std::int64_t longest_ns = 0;
  for (auto& [thread, waited] : samples.back()) longest_ns = std::max(longest_ns, waited - samples.front()[thread]);
  return longest_ns;
}

bool has_rows(const fs::path& file) {
  std::error_code error;
  const auto size = fs::file_size(file, error);
  return !error && size > 400;
}

double ms(std::int64_t ns) { return 1e-6 * static_cast<double>(ns); }

TEST(RecordKill, LosesAtMostAFifthOfASecond) {
  const char* wanted = ::getenv("RECORD_KILLS");
  const int kills = wanted == nullptr ? 3 : std::atoi(wanted);
  Random random(7);
  std::vector<double> probe_ms, poses_ms;
  double longest_stall_ms = 0.0;
  for (int kill = 0; kill < kills; ++kill) {
    const testkit::TempDir dir;
    write_live_calibration(dir / "calibration.json");
    const LiveProbe probe;
    const LivePoses poses(dir / "poses");
    const StallWatch stalls;
    std::int64_t killed_ns = 0, kept_ns = 0;
    const Outcome outcome = run_and_meddle(
        {"record", "--probe", "serial:" + probe.port(), "--poses", "pipe:" + (dir / "poses").string(), "--calibration",
         dir / "calibration.json", "--set", "recorder.sync_s=0.5", "--duration", "60s", "-o", dir / "rec"},
        [&](pid_t process) {
          for (int i = 0; i < 3000; ++i) {
            if (has_rows(dir / "rec/probe.csv") && has_rows(dir / "rec/tracker.csv")) break;
            std::this_thread::sleep_for(milliseconds(10));
          }
          kept_ns = wait_and_watch(process, milliseconds(400 + static_cast<int>(1200.0 * random.uniform())));
          killed_ns = host_now_ns();
          ::kill(process, SIGKILL);
        });
    ASSERT_EQ(outcome.code, 128 + SIGKILL) << outcome.err;
    const Recording recording = read_recording(dir / "rec");
    for (const Problem& problem : recording.problems) {
      EXPECT_THAT(problem.kind, testing::AnyOf("truncated", "unfinished")) << problem.message;
    }
    // None is missing between: a row's last count is its number modulo 2, its first that of its frame of ten rows.
    const auto at = [&](std::size_t row, int axis) { return std::lround(recording.probe.accel_counts[row][axis]); };
    for (std::size_t row = 1; row < recording.probe.size(); ++row) {
      ASSERT_NE(at(row, 2), at(row - 1, 2)) << "kill " << kill << ", row " << row;
      ASSERT_TRUE(row < 10 || at(row, 0) != at(row - 10, 0)) << "kill " << kill << ", row " << row;
    }
    const std::int64_t allowed_ns = kLossAllowed_ns + stalls.longest_ns() + kept_ns;
    const std::int64_t probe_lost_ns = std::min(killed_ns, probe.delivered_ns()) - recording.probe.t_ns.back();
    const std::int64_t poses_lost_ns = killed_ns - recording.tracker.t_ns.back();
    EXPECT_LE(probe_lost_ns, allowed_ns) << "kill " << kill;
    EXPECT_LE(poses_lost_ns, allowed_ns) << "kill " << kill;
    probe_ms.push_back(ms(probe_lost_ns));
    poses_ms.push_back(ms(poses_lost_ns));
    longest_stall_ms = std::max(longest_stall_ms, ms(stalls.longest_ns() + kept_ns));
  }
  std::sort(probe_ms.begin(), probe_ms.end());
  std::sort(poses_ms.begin(), poses_ms.end());
  std::printf(
      "record: %d kills; lost of the probe %.0f ms at the median, %.0f at most, of the poses %.0f and %.0f; the "
      "machine's longest stall %.0f ms\n",
      kills, probe_ms[probe_ms.size() / 2], probe_ms.back(), poses_ms[poses_ms.size() / 2], poses_ms.back(),
      longest_stall_ms);
}

}  // namespace
}  // namespace asperity::cli
