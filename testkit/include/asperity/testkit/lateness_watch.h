#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

namespace asperity::testkit {

// How late the machine runs a thread while this lives: one of its own wakes up every millisecond. A bound of time that
// was missed while others were late too proves nothing.
class LatenessWatch {
 public:
  static constexpr double kBusy_ms = 3.0;

  LatenessWatch() : thread_([this] { watch(); }) {}
  ~LatenessWatch() {
    done_ = true;
    thread_.join();
  }
  LatenessWatch(const LatenessWatch&) = delete;
  LatenessWatch& operator=(const LatenessWatch&) = delete;

  bool was_busy() const { return longest_ms_ >= kBusy_ms; }

 private:
  void watch() {
    auto due = std::chrono::steady_clock::now();
    while (!done_) {
      due += std::chrono::milliseconds(1);
      std::this_thread::sleep_until(due);
      const auto now = std::chrono::steady_clock::now();
      longest_ms_ = std::max(longest_ms_.load(), std::chrono::duration<double, std::milli>(now - due).count());
      due = now;
    }
  }

  std::atomic<bool> done_{false};
  std::atomic<double> longest_ms_{0.0};
  std::thread thread_;
};

// What `measure` returns must stay below `bound`. Repeated, four times at most, while it does not on a machine that was
// busy.
template <class Measure>
double measure_on_a_free_machine(double bound, const Measure& measure) {
  for (int attempt = 1;; ++attempt) {
    const LatenessWatch lateness;
    const double measured = measure();
    if (measured < bound || !lateness.was_busy() || attempt == 4) return measured;
  }
}

// The same for what `holds` says by true.
template <class Holds>
bool holds_on_a_free_machine(const Holds& holds) {
  return measure_on_a_free_machine(0.5, [&] { return holds() ? 0.0 : 1.0; }) == 0.0;
}

}  // namespace asperity::testkit
