#pragma once

#include <atomic>
#include <string>

#include "asperity/base/error.h"

namespace asperity {

// Holds `flag` as long as it lives. Throws Error if another holds it: two owners would command one motor.
class SingleOwner {
 public:
  SingleOwner(std::atomic<bool>& flag, const std::string& device) : flag_(flag) {
    if (flag_.exchange(true)) throw Error(device + ": it is already open in this program");
  }
  ~SingleOwner() { flag_.store(false); }
  SingleOwner(const SingleOwner&) = delete;
  SingleOwner& operator=(const SingleOwner&) = delete;

 private:
  std::atomic<bool>& flag_;
};

}  // namespace asperity
