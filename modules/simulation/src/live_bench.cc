#include "asperity/simulation/live_bench.h"

#include <fmt/format.h>
#include <pthread.h>
#include <time.h>
#include <csignal>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/host_clock.h"
#include "asperity/image/y4m.h"
#include "asperity/simulation/bench_camera.h"
#include "asperity/simulation/probe_device.h"
#include "asperity/simulation/simulate_motion.h"
#include "asperity/simulation/simulate_recording.h"
#include "asperity/simulation/tag_body.h"
#include "link_faults.h"
#include "pseudo_terminal.h"
#include "stream_fifo.h"

namespace asperity {
namespace {

using Clock = std::chrono::steady_clock;

// steady_clock is CLOCK_MONOTONIC here, as host_now_ns() is.
Clock::time_point as_time_point(std::int64_t t_ns) {
  return Clock::time_point(std::chrono::duration_cast<Clock::duration>(std::chrono::nanoseconds(t_ns)));
}

void shift_times(std::vector<std::int64_t>& t_ns, std::int64_t by_ns) {
  for (std::int64_t& t : t_ns) t += by_ns;
}

}  // namespace

struct LiveBench::Impl {
  Impl(Recording made, const SimulatedProbeConfig& probe_config, const LiveBenchConfig& live,
       const std::filesystem::path& folder)
      : config(live),
        recording(std::move(made)),
        device(make_probe_device(recording, probe_config, {live.probe_clock_start_s, live.probe_clock_fast_ppm})),
        faults(live.flip_chance, live.drop_chance, live.insert_chance, static_cast<std::uint64_t>(live.link_seed)),
        camera(live.camera, tag_body(live), recording, recording.calibration.tracker.latency_s, live.stamp_jitter_s),
        fifo(folder / "camera.y4m") {}

  // Waits until `t_ns` on the host's clock; false if it is time to stop.
  bool sleep_until(std::int64_t t_ns) {
    std::unique_lock lock(mutex);
    return !wake.wait_until(lock, as_time_point(t_ns), [this] { return stop; });
  }

  void ask_to_stop() {
    const std::lock_guard lock(mutex);
    stop = true;
    wake.notify_all();
  }

  bool stopping() {
    const std::lock_guard lock(mutex);
    return stop;
  }

  void play_probe() {
    constexpr std::int64_t kTick_ns = 250'000;           // two microframes of a fast USB link
    constexpr std::int64_t kAfterwards_ns = 50'000'000;  // the last frame is not full
    constexpr std::size_t kMostWaiting = std::size_t{1} << 18;
    const std::int64_t end_ns = recording.truth->t_ns.back() + kAfterwards_ns;
    std::vector<std::uint8_t> sent, waiting, received;
    std::int64_t due_ns = host_start_ns;
    for (bool more = true; more && sleep_until(due_ns);) {
      const std::int64_t host_ns = host_now_ns();
      const std::int64_t t_ns = std::min(host_ns - shift_ns, end_ns);
      report.latest_probe_s = std::max(report.latest_probe_s, 1e-9 * static_cast<double>(host_ns - due_ns));
      more = t_ns < end_ns;
      received.clear();
      terminal.read(received);
      device->receive(received);
      sent.clear();
      device->advance(t_ns, sent);
      const std::size_t before = waiting.size();
      faults.carry(sent, waiting);
      report.probe_bytes += waiting.size() - before;
      if (!terminal.has_reader() || waiting.size() > kMostWaiting) {
        report.probe_bytes_lost += waiting.size();
        waiting.clear();
      }
      if (!waiting.empty())
        waiting.erase(waiting.begin(), waiting.begin() + static_cast<std::ptrdiff_t>(terminal.write(waiting)));
      due_ns += kTick_ns * std::max<std::int64_t>(1, (host_ns - due_ns) / kTick_ns);
    }
    // Closing the near end would take from the reader what it has not read yet.
    const std::int64_t linger_end_ns = host_now_ns() + std::llround(config.linger_s * 1e9);
    while (terminal.has_reader() && host_now_ns() < linger_end_ns && sleep_until(host_now_ns() + 40 * kTick_ns)) {
      if (!waiting.empty())
        waiting.erase(waiting.begin(), waiting.begin() + static_cast<std::ptrdiff_t>(terminal.write(waiting)));
    }
    report.flipped = faults.flipped();
    report.dropped = faults.dropped();
    report.inserted = faults.inserted();
  }

  void play_camera() {
    Y4mHeader header;
    header.width = config.camera.width;
    header.height = config.camera.height;
    header.rate_numerator = std::llround(config.camera.rate_Hz * 1000.0);
    header.rate_denominator = 1000;
    constexpr int kPatience_ms = 50;
    const std::int64_t drop_after_ns = std::llround(config.drop_after_s * 1e9);
    GrayImage image;
    std::string bytes;
    for (std::size_t frame = 0; frame < camera.frames(); ++frame) {
      const std::int64_t stamp_ns = camera.time(frame).stamp_ns + shift_ns;
      if (host_now_ns() - stamp_ns > drop_after_ns) {
        ++report.frames_dropped;
        continue;
      }
      // Rendered before its time comes: a busy machine then delays it less.
      camera.render(frame, image);
      if (!sleep_until(stamp_ns)) return;
      bool is_new = false;
      if (!fifo.open(is_new)) {
        ++report.frames_lost;
        continue;
      }
      bytes.clear();
      if (!header_sent) bytes = format_y4m_header(header);
      header_sent = true;
      append_y4m_frame(bytes, header, image, stamp_ns);
      report.latest_frame_s = std::max(report.latest_frame_s, 1e-9 * static_cast<double>(host_now_ns() - stamp_ns));
      std::size_t written = 0;
      while (written < bytes.size() && fifo.is_open() && !stopping())
        written += fifo.write(std::span(bytes).subspan(written), kPatience_ms);
      written == bytes.size() ? ++report.frames : ++report.frames_lost;
      if (!fifo.is_open()) header_sent = false;
    }
    fifo.close();
  }

  LiveBenchConfig config;
  Recording recording;
  std::unique_ptr<ProbeDevice> device;
  LinkFaults faults;
  BenchCamera camera;
  PseudoTerminal terminal;
  StreamFifo fifo;
  bool header_sent = false;
  std::int64_t host_start_ns = 0;  // the first sample's time on the host's clock
  std::int64_t shift_ns = 0;       // from the recording's clock to the host's
  LiveReport report;               // each member belongs to one thread until both are joined

  std::mutex mutex;
  std::condition_variable wake;
  bool stop = false;
};

std::vector<MarkerPlacement> tag_body(const LiveBenchConfig& config) {
  return config.body == TagBody::kRing ? ring_tag_body() : front_tag_body();
}

LiveBench::LiveBench(Recording recording, const SimulatedProbeConfig& probe, const LiveBenchConfig& config,
                     const std::filesystem::path& folder)
    : impl_(std::make_unique<Impl>(std::move(recording), probe, config, folder)) {}

LiveBench::~LiveBench() = default;

std::string LiveBench::port() const { return impl_->terminal.port(); }
std::string LiveBench::camera() const { return impl_->fifo.path().string(); }

double LiveBench::duration_s() const {
  const Truth& truth = *impl_->recording.truth;
  return 1e-9 * static_cast<double>(truth.t_ns.back() - truth.t_ns.front());
}

bool LiveBench::wait_for_readers(const Observer& observer) {
  constexpr std::int64_t kLook_ns = 10'000'000;
  const std::int64_t start_ns = host_now_ns();
  const std::int64_t end_ns = start_ns + std::llround(impl_->config.wait_s * 1e9);
  while (true) {
    bool is_new = false;
    if (impl_->fifo.open(is_new) && impl_->terminal.has_reader()) return true;
    const std::int64_t host_ns = host_now_ns();
    if (host_ns >= end_ns) return false;
    observer.update("waiting", static_cast<double>(host_ns - start_ns) / static_cast<double>(end_ns - start_ns));
    impl_->sleep_until(host_ns + kLook_ns);
  }
}

LiveReport LiveBench::play(const Observer& observer) {
  Impl& impl = *impl_;
  impl.report = {};
  impl.stop = false;
  impl.host_start_ns = host_now_ns() + std::llround(impl.config.settle_s * 1e9);
  impl.shift_ns = impl.host_start_ns - impl.recording.truth->t_ns.front();
  std::atomic<int> running{2};
  std::exception_ptr failure;
  const auto guarded = [&](auto work) {
    return std::thread([&, work] {
      // A reader that goes away is a failed write, not a signal.
      sigset_t pipe;
      sigemptyset(&pipe);
      sigaddset(&pipe, SIGPIPE);
      pthread_sigmask(SIG_BLOCK, &pipe, nullptr);
      try {
        work();
      } catch (...) {
        const std::lock_guard lock(impl.mutex);
        failure = std::current_exception();
        impl.stop = true;
      }
      --running;
      const std::lock_guard lock(impl.mutex);
      impl.wake.notify_all();
    });
  };
  std::thread probe = guarded([&impl] { impl.play_probe(); });
  std::thread camera = guarded([&impl] { impl.play_camera(); });
  try {
    const double duration = duration_s();
    while (running > 0) {
      const double done_s = 1e-9 * static_cast<double>(host_now_ns() - impl.host_start_ns);
      observer.update("playing", std::clamp(done_s / duration, 0.0, 1.0));
      constexpr auto kLook = std::chrono::milliseconds(50);
      std::unique_lock lock(impl.mutex);
      impl.wake.wait_for(lock, kLook, [&] { return running == 0; });
    }
  } catch (...) {
    impl.ask_to_stop();
    probe.join();
    camera.join();
    throw;
  }
  probe.join();
  camera.join();
  if (failure) std::rethrow_exception(failure);
  return impl.report;
}

Recording LiveBench::on_host_clock() const {
  Recording out = impl_->recording;
  const std::int64_t by_ns = impl_->shift_ns;
  shift_times(out.probe.t_ns, by_ns);
  shift_times(out.tracker.t_ns, by_ns);
  shift_times(out.truth->t_ns, by_ns);
  for (Segment& segment : out.info.segments) {
    segment.start_ns += by_ns;
    segment.end_ns += by_ns;
  }
  return out;
}

void add_bench_camera(Recording& recording, const LiveBenchConfig& live) {
  recording.calibration.camera = camera_truth(live.camera);
  recording.calibration.markers = tag_body(live);
  const BenchCamera camera(live.camera, recording.calibration.markers, recording,
                           recording.calibration.tracker.latency_s, live.stamp_jitter_s);
  recording.tracker = camera.true_poses();
  recording.info.tracker_rate_Hz = live.camera.rate_Hz;
}

Recording simulate_live_recording(const SimulationConfig& simulation, const LiveBenchConfig& live,
                                  const Observer& observer, Problems* problems) {
  if (simulation.object.motion != SimulatedObjectMotion::kNone)
    throw Error("simulation.object.motion: the rendered camera shows the probe's body alone; choose none");
  Recording recording = simulate_recording(without_link_faults(simulation), observer, problems);
  add_bench_camera(recording, live);
  return recording;
}

}  // namespace asperity
