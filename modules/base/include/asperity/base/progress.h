#pragma once

#include <cstddef>
#include <functional>
#include <string_view>

#include "asperity/base/error.h"

namespace asperity {

// How a long stage reports and is stopped. Both functions may be empty.
struct Observer {
  std::function<void(std::string_view stage, double fraction)> progress;
  std::function<bool()> cancelled;

  // Reports `fraction` in [0, 1]; throws Cancelled if the user has asked to stop.
  void update(std::string_view stage, double fraction) const {
    if (cancelled && cancelled()) throw Cancelled();
    if (progress) progress(stage, fraction);
  }
  // For a part of a stage: asks the same, reports nothing.
  Observer without_progress() const { return {{}, cancelled}; }
};

// For a loop over many rows: asks once in 4096 of them whether to stop.
class RowWatch {
 public:
  explicit RowWatch(const Observer& observer = {}) : cancelled_(observer.cancelled) {}

  // Throws Cancelled.
  void next() {
    if ((++rows_ & 4095U) == 0 && cancelled_ && cancelled_()) throw Cancelled();
  }

 private:
  std::function<bool()> cancelled_;
  std::size_t rows_ = 0;
};

}  // namespace asperity
