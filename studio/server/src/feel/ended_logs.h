#pragma once

#include <mutex>
#include <utility>
#include <vector>

#include "feel/run_log.h"

namespace asperity::studio {

// Logs that a run has done with, until the studio's thread takes them.
struct EndedLogs {
  std::mutex lock;
  std::vector<EndedLog> logs;

  std::vector<EndedLog> take() {
    const std::lock_guard guard(lock);
    return std::exchange(logs, {});
  }
};

}  // namespace asperity::studio
