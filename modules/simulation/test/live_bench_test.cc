#include "asperity/simulation/live_bench.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <string>
#include <string_view>
#include <thread>

#include "asperity/base/error.h"
#include "asperity/image/y4m.h"
#include "asperity/simulation/bench_camera.h"
#include "asperity/simulation/calibration_motion.h"
#include "asperity/simulation/probe_device.h"
#include "asperity/simulation/simulate_motion.h"
#include "asperity/testkit/temp_dir.h"

namespace asperity {
namespace {

namespace fs = std::filesystem;

SimulationConfig short_config(std::string_view probe) {
  SimulationConfig config = without_link_faults(make_simulation_config("protoboard", probe));
  config.step_s = 1e-4;
  return config;
}

Recording shaken(const SimulationConfig& config, const LiveBenchConfig& live, double duration_s) {
  ShakeMotion shake;
  shake.rest_s = 0.0;
  Recording recording = simulate_motion(
      config, shake_motion(shake, Eigen::Vector3d(config.probe.tip_in_marker_m.data())), duration_s, "shaken");
  add_bench_camera(recording, live);
  return recording;
}

// Everything that comes from `path` until its other end is closed.
std::string read_all(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_NOCTTY | O_CLOEXEC);
  std::string out;
  char bytes[65536];
  while (true) {
    const ssize_t count = ::read(file, bytes, sizeof bytes);
    if (count <= 0) break;
    out.append(bytes, static_cast<std::size_t>(count));
  }
  ::close(file);
  return out;
}

struct Played {
  std::string probe;
  std::string camera;
  LiveReport report;
};

Played play(LiveBench& bench) {
  Played out;
  std::thread camera([&] { out.camera = read_all(bench.camera()); });
  std::atomic<bool> done{false};
  // A pseudo-terminal's near end stays open as long as the bench lives: read what is there until the bench is done.
  std::thread probe([&] {
    const int file = ::open(bench.port().c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
    pollfd state{file, POLLIN, 0};
    char bytes[4096];
    while (true) {
      const bool last = done;
      if (::poll(&state, 1, 20) > 0) {
        const ssize_t count = ::read(file, bytes, sizeof bytes);
        if (count > 0) {
          out.probe.append(bytes, static_cast<std::size_t>(count));
          continue;
        }
      }
      if (last) break;
    }
    ::close(file);
  });
  EXPECT_TRUE(bench.wait_for_readers());
  out.report = bench.play();
  done = true;
  probe.join();
  camera.join();
  return out;
}

struct Frames {
  std::vector<std::int64_t> t_ns;
  std::vector<std::string_view> pixels;
};

Frames split_y4m(std::string_view stream) {
  Frames out;
  const std::size_t header_end = stream.find('\n');
  const Y4mHeader header = parse_y4m_header(stream.substr(0, header_end), "stream");
  std::size_t at = header_end + 1;
  while (at < stream.size()) {
    const std::size_t line_end = stream.find('\n', at);
    out.t_ns.push_back(parse_y4m_frame_line(stream.substr(at, line_end - at), "stream").value());
    out.pixels.push_back(stream.substr(line_end + 1, header.luma_bytes()));
    at = line_end + 1 + header.luma_bytes();
  }
  return out;
}

TEST(LiveBench, SendsTheProbesBytesAndTheCamerasFrames) {
  const SimulationConfig config = short_config("what");
  LiveBenchConfig live;
  live.linger_s = 0.2;
  const Recording recording = shaken(config, live, 0.4);
  const testkit::TempDir folder;
  LiveBench bench(recording, config.probe, live, folder.path());
  const Played played = play(bench);

  std::string expected;
  for (const ProbeBytes& bytes : send_recording(recording, config.probe))
    expected.append(bytes.bytes.begin(), bytes.bytes.end());
  EXPECT_EQ(played.probe, expected);
  EXPECT_EQ(played.report.probe_bytes, expected.size());
  EXPECT_EQ(played.report.probe_bytes_lost, 0U);
  EXPECT_EQ(expected.size(), 5 * recording.probe.size());

  BenchCamera camera(live.camera, recording.calibration.markers, recording, recording.calibration.tracker.latency_s,
                     live.stamp_jitter_s);
  const Frames frames = split_y4m(played.camera);
  ASSERT_EQ(frames.t_ns.size(), camera.frames());
  EXPECT_EQ(played.report.frames, camera.frames());
  const Recording on_host = bench.on_host_clock();
  EXPECT_EQ(frames.t_ns, on_host.tracker.t_ns);
  EXPECT_EQ(on_host.truth->t_ns.front() - recording.truth->t_ns.front(),
            on_host.probe.t_ns.back() - recording.probe.t_ns.back());
  GrayImage image;
  camera.render(7, image);
  EXPECT_TRUE(std::equal(image.pixels.begin(), image.pixels.end(), frames.pixels[7].begin(), frames.pixels[7].end(),
                         [](std::uint8_t a, char b) { return a == static_cast<std::uint8_t>(b); }));
}

TEST(LiveBench, TheOpenProbesFramesGoThroughALinkWithFaults) {
  const SimulationConfig config = short_config("open");
  LiveBenchConfig live;
  live.linger_s = 0.2;
  live.drop_chance = 0.01;
  live.insert_chance = 0.02;
  const Recording recording = shaken(config, live, 0.3);
  const testkit::TempDir folder;
  LiveBench bench(recording, config.probe, live, folder.path());
  const Played played = play(bench);
  EXPECT_EQ(played.probe.size(), played.report.probe_bytes);
  EXPECT_GT(played.report.dropped, 50U);
  EXPECT_GT(played.report.inserted, played.report.dropped);
  // 16 rows a frame, a zero byte behind each; some are lost, some are made by the faults.
  const auto zeros = std::count(played.probe.begin(), played.probe.end(), '\0');
  EXPECT_NEAR(static_cast<double>(zeros), static_cast<double>(recording.probe.size()) / 16.0, 12.0);
}

// 2000 frames a second of 640 x 480 px are more than this machine, or the next, can draw and a pipe can carry.
TEST(LiveBench, LateFramesAreDroppedAndTheOthersKeepTheirTime) {
  const SimulationConfig config = short_config("what");
  LiveBenchConfig live;
  live.linger_s = 0.2;
  live.camera.rate_Hz = 2000.0;
  live.camera.exposure_s = 2e-4;
  live.drop_after_s = 2e-3;
  const Recording recording = shaken(config, live, 0.4);
  const testkit::TempDir folder;
  LiveBench bench(recording, config.probe, live, folder.path());
  const Played played = play(bench);
  EXPECT_GT(played.report.frames_dropped, 0U);
  const std::vector<std::int64_t> all = bench.on_host_clock().tracker.t_ns;
  EXPECT_EQ(played.report.frames + played.report.frames_dropped + played.report.frames_lost, all.size());
  const Frames frames = split_y4m(played.camera);
  EXPECT_EQ(frames.t_ns.size(), played.report.frames);
  EXPECT_TRUE(std::includes(all.begin(), all.end(), frames.t_ns.begin(), frames.t_ns.end()));
}

TEST(LiveBench, WaitsForReadersAndLeavesNothingBehind) {
  const SimulationConfig config = short_config("what");
  LiveBenchConfig live;
  live.wait_s = 0.05;
  const testkit::TempDir folder;
  std::string fifo;
  {
    LiveBench bench(shaken(config, live, 0.1), config.probe, live, folder.path());
    fifo = bench.camera();
    EXPECT_TRUE(fs::is_fifo(fifo));
    EXPECT_FALSE(bench.wait_for_readers());
    EXPECT_THROW(LiveBench(shaken(config, live, 0.1), config.probe, live, folder.path()), Error);
  }
  EXPECT_FALSE(fs::exists(fifo));
}

TEST(LiveBench, IsStoppedInTheMiddle) {
  const SimulationConfig config = short_config("what");
  LiveBenchConfig live;
  const testkit::TempDir folder;
  LiveBench bench(shaken(config, live, 20.0), config.probe, live, folder.path());
  Observer observer;
  int asked = 0;
  observer.cancelled = [&asked] { return ++asked > 3; };
  // Without readers: what is sent is lost.
  EXPECT_THROW(bench.play(observer), Cancelled);
}

}  // namespace
}  // namespace asperity
