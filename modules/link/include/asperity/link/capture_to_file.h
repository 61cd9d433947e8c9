#pragma once

#include <filesystem>
#include <memory>

#include "asperity/transport/byte_source.h"

namespace asperity {

// `source`, whose bytes are also written to a new file at `path`, and how many came when to `path`.arrivals.csv
// ("bytes,arrival_ns", one line an arrival): open_capture replays both. Each arrival is handed to the operating system
// before read() returns. Throws Error if a file exists already or cannot be written.
std::unique_ptr<ByteSource> capture_to_file(std::unique_ptr<ByteSource> source, const std::filesystem::path& path);

}  // namespace asperity
