#pragma once

#include <memory>
#include <string>

#include "asperity/transport/byte_source.h"

namespace asperity {

// The bytes of a regular file or a FIFO as they come. LinkLost at the file's end, or once the FIFO's writer has gone.
// Opening a FIFO does not wait for its writer. Throws Error for what is neither.
std::unique_ptr<ByteSource> open_path(const std::string& path);

}  // namespace asperity
