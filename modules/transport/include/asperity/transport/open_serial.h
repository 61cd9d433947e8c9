#pragma once

#include <memory>
#include <string>

#include "asperity/transport/byte_source.h"

namespace asperity {

// Opens the serial port (or pseudo-terminal) at `path`, raw, 8 data bits, no parity, 1 stop bit, no flow control, at
// `baud` bits per second. Nobody else may have it meanwhile: it is locked (flock) and marked exclusive (TIOCEXCL). Its
// settings are not touched before it is ours. Reading throws LinkLost when the port is unplugged or the other side of a
// pseudo-terminal is closed. Throws Error naming the port and what to do: absent, not permitted (dialout), in use (by
// whom), not a terminal, a baud rate that there is not.
std::unique_ptr<ByteSource> open_serial(const std::string& path, int baud);

}  // namespace asperity
