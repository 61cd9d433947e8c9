#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "asperity/base/error.h"

namespace asperity {

// The other end is gone: the cable was pulled, the file is at its end, the socket was closed.
class LinkLost : public Error {
 public:
  using Error::Error;
};

// Bytes that arrived together.
struct Arrival {
  std::size_t count = 0;        // bytes; 0: none came in time
  std::int64_t arrival_ns = 0;  // on the host's monotonic clock, taken as soon as they were there
};

// Where a probe's bytes come from: a serial port, a UDP socket, a file. One thread at a time.
class ByteSource {
 public:
  virtual ~ByteSource() = default;

  // Waits at most `timeout` for bytes and puts those that are there into `into`. Throws LinkLost when no
  // more can come, Error for anything else that fails.
  virtual Arrival read(std::span<std::uint8_t> into, std::chrono::milliseconds timeout) = 0;

  // Sends bytes to the probe; false where it has no way back. Throws LinkLost.
  virtual bool write(std::span<const std::uint8_t> bytes) = 0;

  // For messages: "serial:/dev/ttyUSB0".
  virtual std::string name() const = 0;
};

}  // namespace asperity
