#include "python_lock.h"

#include <unistd.h>

namespace asperity::python {

void take_lock(PyThreadState* state) noexcept {
  try {
    PyEval_RestoreThread(state);
  } catch (...) {  // the unwinding; it is not left
    for (;;) pause();
  }
}

}  // namespace asperity::python
