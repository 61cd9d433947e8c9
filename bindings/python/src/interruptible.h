#pragma once

#include <chrono>
#include <type_traits>

#include <pybind11/pybind11.h>

#include "asperity/base/progress.h"

namespace asperity::python {

// Runs `work(observer)` without Python's lock. Ctrl-C, looked for twenty times a second, ends it with
// KeyboardInterrupt.
template <class Work>
auto interruptible(const Work& work) {
  namespace py = pybind11;
  using Clock = std::chrono::steady_clock;
  bool interrupted = false;
  Clock::time_point next = Clock::now();
  Observer observer;
  observer.cancelled = [&] {
    if (interrupted || Clock::now() < next) return interrupted;
    next = Clock::now() + std::chrono::milliseconds(50);
    const py::gil_scoped_acquire lock;
    interrupted = PyErr_CheckSignals() != 0;
    return interrupted;
  };
  try {
    const py::gil_scoped_release unlocked;
    return work(observer);
  } catch (const Cancelled&) {
    if (interrupted) throw py::error_already_set();
    throw;
  }
}

}  // namespace asperity::python
