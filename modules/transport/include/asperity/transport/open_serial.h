#pragma once

#include <memory>
#include <string>

#include "asperity/transport/byte_source.h"

namespace asperity {

// The serial port (serial_port.h) at `path`, a probe's, at `baud` bits per second. Throws as SerialPort does.
std::unique_ptr<ByteSource> open_serial(const std::string& path, int baud);

}  // namespace asperity
