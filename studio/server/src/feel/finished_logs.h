#pragma once

#include <mutex>
#include <utility>
#include <vector>

#include "feel/run_log.h"

namespace asperity::studio {

// Logs that a run has done with, until the studio's thread takes them.
struct FinishedLogs {
  std::mutex lock;
  std::vector<FinishedLog> logs;

  std::vector<FinishedLog> take() {
    const std::lock_guard guard(lock);
    return std::exchange(logs, {});
  }
};

}  // namespace asperity::studio
