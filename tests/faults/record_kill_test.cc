// `asperity record` is killed at random moments: what it has loses at most the last 0.2 s. RECORD_KILLS says how many
// times; scripts/check takes 200.
#include <gmock/gmock.h>
#include <signal.h>
#include <stdlib.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdlib>
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

// How long the machine lets a thread wait that wants to run every 5 ms: that is not the recorder's loss.
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
    std::int64_t killed_ns = 0;
    const Outcome outcome = run_and_meddle(
        {"record", "--probe", "serial:" + probe.port(), "--poses", "pipe:" + (dir / "poses").string(), "--calibration",
         dir / "calibration.json", "--set", "recorder.sync_s=0.5", "--duration", "60s", "-o", dir / "rec"},
        [&](pid_t process) {
          for (int i = 0; i < 3000; ++i) {
            if (has_rows(dir / "rec/probe.csv") && has_rows(dir / "rec/tracker.csv")) break;
            std::this_thread::sleep_for(milliseconds(10));
          }
          std::this_thread::sleep_for(milliseconds(static_cast<int>(1500.0 * random.uniform())));
          killed_ns = host_now_ns();
          ::kill(process, SIGKILL);
        });
    ASSERT_EQ(outcome.code, 128 + SIGKILL) << outcome.err;
    const Recording recording = read_recording(dir / "rec");
    for (const Problem& problem : recording.problems) {
      EXPECT_THAT(problem.kind, testing::AnyOf("truncated", "unfinished")) << problem.message;
    }
    // None is missing between: one row a millisecond, numbered by its last count modulo 2, its frames by their first.
    for (std::size_t i = 1; i < recording.probe.size(); ++i) {
      const Eigen::Vector3d &before = recording.probe.accel_counts[i - 1], &now = recording.probe.accel_counts[i];
      ASSERT_NE(before.z(), now.z()) << "kill " << kill << ", row " << i;
      ASSERT_LT(recording.probe.t_ns[i] - recording.probe.t_ns[i - 1], 5'000'000) << "kill " << kill << ", row " << i;
    }
    const std::int64_t allowed_ns = kLossAllowed_ns + stalls.longest_ns();
    const std::int64_t probe_lost_ns = killed_ns - recording.probe.t_ns.back();
    const std::int64_t poses_lost_ns = killed_ns - recording.tracker.t_ns.back();
    EXPECT_LE(probe_lost_ns, allowed_ns) << "kill " << kill;
    EXPECT_LE(poses_lost_ns, allowed_ns) << "kill " << kill;
    probe_ms.push_back(ms(probe_lost_ns));
    poses_ms.push_back(ms(poses_lost_ns));
    longest_stall_ms = std::max(longest_stall_ms, ms(stalls.longest_ns()));
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
