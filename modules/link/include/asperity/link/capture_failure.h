#pragma once

#include <mutex>
#include <string>
#include <utility>

namespace asperity {

// The first reason why a capture cannot be written, told by the thread that reads the probe. Thread-safe.
class CaptureFailure {
 public:
  void note(std::string reason) {
    const std::lock_guard lock(mutex_);
    if (reason_.empty()) reason_ = std::move(reason);
  }
  // Names the file; empty: nothing is wrong.
  std::string reason() const {
    const std::lock_guard lock(mutex_);
    return reason_;
  }

 private:
  mutable std::mutex mutex_;
  std::string reason_;
};

}  // namespace asperity
