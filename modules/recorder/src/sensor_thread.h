#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "asperity/recorder/recorder_config.h"
#include "asperity/recorder/recorder_snapshot.h"

namespace asperity {

// What a sensor's thread does; all called in that thread. `open` and `read` throw Error.
struct SensorLoop {
  std::function<void()> open;
  std::function<void()> close;                          // never throws
  std::function<bool(std::chrono::milliseconds)> read;  // waits; true if the sensor is alive
  bool reopen = true;
  bool reopen_silent = true;  // false: after a silence the same stream goes on
};

// Reads one sensor until stop(). When it is lost, or silent for config.stale_s, it is closed and opened again with
// growing waits in between; without `reopen_silent` one that is silent is called lost but stays open.
class SensorThread {
 public:
  // The sensor is open already. `sensor` names it in messages.
  SensorThread(SensorLoop loop, const RecorderConfig& config);
  ~SensorThread() { stop(); }
  SensorThread(const SensorThread&) = delete;
  SensorThread& operator=(const SensorThread&) = delete;

  // Returns when the thread has ended.
  void stop();

  struct Health {
    SensorState state = SensorState::kSilent;
    std::string message;
    std::uint64_t lost = 0;
    std::uint64_t returned = 0;
    bool failed = false;  // ended by another error than LinkLost
  };
  Health health() const;

 private:
  using Clock = std::chrono::steady_clock;
  void run();
  void read_once();
  void open_again();
  void lose(const std::string& why);
  void report_lost(const std::string& why);
  bool wait(std::chrono::duration<double> time);
  bool stopping() const;

  SensorLoop loop_;
  RecorderConfig config_;
  bool open_ = true;
  Clock::time_point alive_at_ = Clock::now();
  std::chrono::duration<double> retry_;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool stop_ = false;
  Health health_;
  std::thread thread_;
};

}  // namespace asperity
