#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "asperity/base/progress.h"
#include "asperity/recording/recording.h"
#include "asperity/simulation/live_bench_config.h"
#include "asperity/simulation/simulation_config.h"

namespace asperity {

// What left the bench.
struct LiveReport {
  std::uint64_t probe_bytes = 0;
  std::uint64_t probe_bytes_lost = 0;  // nobody read them, or not in time
  std::uint64_t frames = 0;
  std::uint64_t frames_lost = 0;                         // nobody read them
  std::uint64_t frames_dropped = 0;                      // later than drop_after_s
  double latest_frame_s = 0.0;                           // the most that a frame left after its time stamp
  double latest_probe_s = 0.0;                           // the most that the probe's bytes left late
  std::uint64_t flipped = 0, dropped = 0, inserted = 0;  // bytes, by the link
};

// Plays a simulated scan in real time as a probe and a camera would send it (docs/live-bench.md): the probe's bytes
// over a pseudo-terminal, paced by the probe's own clock, and the camera's view of its tags as a YUV4MPEG2 stream
// (image/y4m.h) over a FIFO, each from a thread of its own. Linux. Thread-safe: no.
class LiveBench {
 public:
  // `recording` has its truth and all of its samples (simulate_live_recording). Makes `folder`/camera.y4m, a FIFO, and
  // opens the pseudo-terminal. Throws Error if the system refuses.
  LiveBench(Recording recording, const SimulatedProbeConfig& probe, const LiveBenchConfig& config,
            const std::filesystem::path& folder);
  // Stops the threads and removes the FIFO.
  ~LiveBench();
  LiveBench(const LiveBench&) = delete;
  LiveBench& operator=(const LiveBench&) = delete;

  std::string port() const;    // the pseudo-terminal, "/dev/pts/3"
  std::string camera() const;  // the FIFO
  double duration_s() const;

  // True as soon as both are open at their other ends, false after `wait_s`. Throws Cancelled.
  bool wait_for_readers(const Observer& observer = {});

  // Sends all. A reader that goes away loses what is sent meanwhile, and is served again when it returns. Ends early,
  // and throws Cancelled, if the observer says so.
  LiveReport play(const Observer& observer = {});

  // After play(): the recording with all its times on the host's monotonic clock.
  Recording on_host_clock() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// The scan that a LiveBench plays: simulate_recording without faults, with the exact calibration, camera and tags
// included, and as tracker.csv what a tracker without error would have made of the frames. Problems as there.
Recording simulate_live_recording(const SimulationConfig& simulation, const LiveBenchConfig& live,
                                  const Observer& observer = {}, Problems* problems = nullptr);

// The same for any recording of the bench without link faults: adds camera, tags and true poses.
void add_bench_camera(Recording& recording, const LiveBenchConfig& live);

}  // namespace asperity
