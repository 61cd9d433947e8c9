#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>
#include <thread>

namespace asperity::cli {

// A probe on a pseudo-terminal that speaks the open protocol: 1000 samples a second at rest, level with gravity along
// +y of the marker frame, 100 counts per m/s² and per newton.
class LiveProbe {
 public:
  LiveProbe();
  ~LiveProbe();
  LiveProbe(const LiveProbe&) = delete;
  LiveProbe& operator=(const LiveProbe&) = delete;

  const std::string& port() const { return port_; }
  // When it last handed bytes to the line, by the host's clock; 0: never.
  std::int64_t delivered_ns() const { return delivered_ns_; }
  // Returns when so many frames (of 10 ms) with this force are sent, or false when `done`: a busy machine sends them
  // late.
  bool press(double force_N, int frames, const std::atomic<bool>& done);

 private:
  void run();

  int master_ = -1;
  std::string port_;
  std::atomic<double> force_counts_{0.0};
  std::atomic<std::int64_t> delivered_ns_{0};
  std::atomic<std::int64_t> frames_{0};
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

// A tracker that writes lines into a FIFO: 100 poses a second at rest, times those of their arrival.
class LivePoses {
 public:
  explicit LivePoses(const std::filesystem::path& fifo);
  ~LivePoses();
  LivePoses(const LivePoses&) = delete;
  LivePoses& operator=(const LivePoses&) = delete;

 private:
  void run();

  int file_ = -1;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

// The calibration of that probe.
void write_live_calibration(const std::filesystem::path& path);

}  // namespace asperity::cli
