#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "asperity/device/servo_tick.h"
#include "asperity/session/feel_log.h"

namespace asperity::studio {

// How a log ended: whole but for its commit(), or with a fault, without a log.
struct FinishedLog {
  std::shared_ptr<FeelLog> log;
  std::string fault;
};

// The log of a run while it runs. begin() and end() are for the studio's thread and do not wait for a disk; add() and
// finish() for the run's.
class RunLog {
 public:
  // `ended` is called on the run's thread, once for each log.
  explicit RunLog(std::function<void(FinishedLog)> ended) : ended_(std::move(ended)) {}

  void begin(std::unique_ptr<FeelLog> log);
  void end();

  // A fault of the disk ends the log, not the run. So does kMostRows.
  void add(const ServoTick& tick);
  void finish();

  static constexpr std::uint64_t kMostRows = 8'000'000;  // some 2 GB

 private:
  void take_orders();

  std::function<void(FinishedLog)> ended_;
  std::atomic<bool> ordered_{false};
  std::mutex lock_;  // of the two below
  std::shared_ptr<FeelLog> next_;
  bool end_ = false;
  std::shared_ptr<FeelLog> log_;  // the run's thread alone
  std::uint64_t rows_ = 0;
};

}  // namespace asperity::studio
