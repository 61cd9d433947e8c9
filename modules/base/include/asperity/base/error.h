#pragma once

#include <stdexcept>
#include <string>

namespace asperity {

// A bad file, configuration or precondition. The message names the file, place and offending value.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The user stopped a long computation; nothing was written.
class Cancelled : public Error {
 public:
  Cancelled() : Error("cancelled") {}
};

}  // namespace asperity
