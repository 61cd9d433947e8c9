#pragma once

#include <pybind11/pybind11.h>

namespace asperity::python {

// Python's lock, given back and taken by these only. When the process ends, Python ends each other thread that asks for
// the lock (a daemon) by unwinding its stack, which destructors do not survive: such a thread waits in take_lock for
// the end of the process instead.

// Takes the lock for the calling thread, whose state PyEval_SaveThread() gave.
void take_lock(PyThreadState* state) noexcept;

// Python's lock is free while this lives.
class LockFreed {
 public:
  LockFreed() : state_(PyEval_SaveThread()) {}
  LockFreed(const LockFreed&) = delete;
  LockFreed& operator=(const LockFreed&) = delete;
  ~LockFreed() { take_lock(state_); }

  // Runs `use` with the lock.
  template <class Use>
  void with_lock(const Use& use) {
    take_lock(state_);
    use();
    state_ = PyEval_SaveThread();
  }

 private:
  PyThreadState* state_;
};

}  // namespace asperity::python
