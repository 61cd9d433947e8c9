#pragma once

#include <future>
#include <system_error>

namespace asperity {

// Runs `work` in a thread of its own, or, where no thread is to be had, when its result is asked for. What it throws
// comes out of get(); the future waits for it when it goes. For reading and writing of files beside the computation:
// the bytes do not depend on it.
template <class Work>
auto in_background(const Work& work) -> std::future<decltype(work())> {
  try {
    return std::async(std::launch::async, work);
  } catch (const std::system_error&) {
    return std::async(std::launch::deferred, work);
  }
}

}  // namespace asperity
