#include "progress_line.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "asperity/session/interrupt.h"

namespace asperity::app {

ProgressLine::ProgressLine(bool quiet) : enabled_(!quiet && ::isatty(STDERR_FILENO) == 1) {}

ProgressLine::~ProgressLine() { clear(); }

Observer ProgressLine::observer() {
  Observer observer;
  observer.cancelled = interrupted;
  if (enabled_) observer.progress = [this](std::string_view stage, double fraction) { show(stage, fraction); };
  return observer;
}

void ProgressLine::clear() {
  if (visible_) std::fputs("\r\033[K", stderr);
  visible_ = false;
}

void ProgressLine::show(std::string_view stage, double fraction) {
  using namespace std::chrono_literals;
  const auto now = Clock::now();
  if (now - start_ < 1s || now - last_ < 100ms) return;
  last_ = now;
  visible_ = true;
  const int percent = static_cast<int>(std::lround(100.0 * std::clamp(fraction, 0.0, 1.0)));
  std::fprintf(stderr, "\r\033[K%.*s %3d %%", static_cast<int>(std::min<std::size_t>(stage.size(), 60)), stage.data(),
               percent);
  std::fflush(stderr);
}

}  // namespace asperity::app
