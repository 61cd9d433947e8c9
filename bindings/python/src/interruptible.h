#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <thread>
#include <type_traits>

#include <pybind11/pybind11.h>

#include "asperity/base/progress.h"
#include "python_lock.h"

namespace asperity::python {

// Runs `work(observer)` without Python's lock. Ctrl-C, looked for twenty times a second, ends it with
// KeyboardInterrupt; so does whatever a handler of another signal raises.
template <class Work>
auto interruptible(const Work& work) {
  namespace py = pybind11;
  using Clock = std::chrono::steady_clock;
  constexpr auto kBetween = std::chrono::milliseconds(50);
  std::atomic<bool> interrupted = false;
  const std::thread::id caller = std::this_thread::get_id();
  Clock::time_point next = Clock::now() + kBetween;
  LockFreed* free = nullptr;
  Observer observer;
  observer.cancelled = [&] {
    // Threads of the work's own only follow: signals are the calling thread's.
    if (interrupted || std::this_thread::get_id() != caller || Clock::now() < next) return interrupted.load();
    next = Clock::now() + kBetween;
    free->with_lock([&] { interrupted = PyErr_CheckSignals() != 0; });
    return interrupted.load();
  };
  const auto unlocked = [&] {
    LockFreed lock;
    free = &lock;
    return work(observer);
  };
  try {
    if constexpr (std::is_void_v<decltype(work(observer))>) {
      unlocked();
      if (interrupted) throw py::error_already_set();
    } else {
      auto out = unlocked();
      if (interrupted) throw py::error_already_set();
      return out;
    }
  } catch (const py::error_already_set&) {
    throw;
  } catch (...) {
    if (interrupted) throw py::error_already_set();
    throw;
  }
}

inline constexpr std::size_t kBlock = 1024;

// Many small steps of one kind: work(i) for each i below `count`. Between blocks of them the observer is asked.
template <class Step>
void in_blocks(const Observer& observer, std::size_t count, const Step& step) {
  for (std::size_t first = 0; first < count; first += kBlock) {
    if (first > 0) observer.update("", 0.0);
    const std::size_t last = std::min(first + kBlock, count);
    for (std::size_t i = first; i < last; ++i) step(i);
  }
}

}  // namespace asperity::python
