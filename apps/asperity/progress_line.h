#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "asperity/base/progress.h"

namespace asperity::app {

// One line on standard error that shows how far a stage is, from the first second on, if standard
// error is a terminal. Gone when the object goes.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  // Reports here and stops on interrupted(). Valid as long as this object.
  Observer observer();
  void clear();

 private:
  void show(std::string_view stage, double fraction);

  using Clock = std::chrono::steady_clock;
  bool enabled_;
  bool visible_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_{};
};

}  // namespace asperity::app
