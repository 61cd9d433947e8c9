#include <gmock/gmock.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <new>
#include <thread>

#include "asperity/base/random.h"
#include "asperity/recorder/recorder.h"
#include "asperity/recording/read_recording.h"
#include "asperity/testkit/temp_dir.h"
#include "fake_sensors.h"

namespace asperity {
namespace {

constexpr std::int64_t kLossAllowed_ns = 200'000'000;

// What the process that is killed leaves behind in memory that is shared.
struct Witness {
  FakeControl probe;
  std::atomic<bool> ready{false};
  std::atomic<std::int64_t> longest_stall_ns{0};  // of a thread that only sleeps 5 ms at a time
};

// Records until it is killed.
[[noreturn]] void record(const std::filesystem::path& folder, Witness& witness) {
  try {
    Calibration calibration;
    calibration.accelerometer.B = 100.0 * Eigen::Matrix3d::Identity();
    calibration.tip_in_marker_m = {0.0, 0.1, 0.0};
    const std::shared_ptr<FakeControl> probe(&witness.probe, [](FakeControl*) {});
    Recorder recorder(folder, {}, calibration,
                      {open_fake_probe(probe), open_fake_poses(std::make_shared<FakeControl>())});
    // Segments come and go; then one stays open.
    for (int i = 0; i < 5; ++i) {
      recorder.start_segment();
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      if (i % 2 == 0) recorder.stop_segment();
      if (i % 3 == 0) recorder.discard_segment();
    }
    recorder.start_segment("last");
    for (witness.ready = true;;) {
      const std::int64_t before_ns = host_now_ns();
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      witness.longest_stall_ns = std::max<std::int64_t>(witness.longest_stall_ns, host_now_ns() - before_ns);
    }
  } catch (...) {
    ::_exit(1);
  }
}

TEST(RecorderKill, LosesAtMostTheLastFifthOfASecond) {
  Random random(5);
  for (int trial = 0; trial < 6; ++trial) {
    const testkit::TempDir dir;
    void* memory = ::mmap(nullptr, sizeof(Witness), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    ASSERT_NE(memory, MAP_FAILED);
    auto* witness = new (memory) Witness;
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) record(dir / "rec", *witness);
    int status = 0;
    while (!witness->ready) {
      ASSERT_EQ(::waitpid(child, &status, WNOHANG), 0) << "it ended before it recorded";
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    // Rows are delivered, however slow the machine is, for longer than may be lost.
    const std::int64_t ready_ns = host_now_ns();
    while (witness->probe.delivered_ns < ready_ns + kLossAllowed_ns) {
      ASSERT_EQ(::waitpid(child, &status, WNOHANG), 0) << "it ended while it recorded";
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(static_cast<int>(400.0 * random.uniform())));
    const std::int64_t killed_ns = host_now_ns();
    ASSERT_EQ(::kill(child, SIGKILL), 0);
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status));

    const Recording recording = read_recording(dir / "rec");
    for (const Problem& problem : recording.problems) {
      EXPECT_THAT(problem.kind, testing::AnyOf("truncated", "unfinished", "discarded_rows")) << problem.message;
    }
    // Every row is the sensor's; none is missing but where a segment ended.
    constexpr std::int64_t kPeriod_ns = 250'000;
    for (std::size_t i = 1; i < recording.probe.size(); ++i) {
      const std::int64_t step_ns = recording.probe.t_ns[i] - recording.probe.t_ns[i - 1];
      const double rows = recording.probe.accel_counts[i].x() - recording.probe.accel_counts[i - 1].x();
      ASSERT_EQ(step_ns, kPeriod_ns * static_cast<std::int64_t>(rows));
      const bool in_last = recording.probe.t_ns[i - 1] >= recording.info.segments.back().start_ns;
      ASSERT_TRUE(rows == 1.0 || !in_last);
    }
    // A machine that did not let the process run for a while is not the recorder's fault.
    const std::int64_t due_ns =
        std::min<std::int64_t>(witness->probe.delivered_ns, killed_ns - kLossAllowed_ns - witness->longest_stall_ns);
    ASSERT_FALSE(recording.info.segments.empty());
    const std::int64_t kept_ns = recording.probe.t_ns.back();
    EXPECT_EQ(recording.info.segments.back().end_ns, std::max(kept_ns, recording.tracker.t_ns.back()));
    EXPECT_GE(kept_ns, due_ns) << "lost " << 1e-6 * static_cast<double>(killed_ns - kept_ns) << " ms";
    ::munmap(memory, sizeof(Witness));
  }
}

}  // namespace
}  // namespace asperity
