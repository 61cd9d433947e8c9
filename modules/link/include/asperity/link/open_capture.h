#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "asperity/transport/byte_source.h"

namespace asperity {

struct CaptureConfig {
  double bytes_per_s = 0.0;   // at which the bytes are said to have come; 0: as PATH.arrivals.csv says
  std::int64_t start_ns = 0;  // when they began to come
  bool real_time = false;     // wait as long as that took; else as fast as they are read
};

// A file of captured bytes as if they came from a probe: the same bytes in the same pieces with the same arrival times
// each time, wherever it is read. Without arrivals the pieces are of one millisecond. LinkLost at its end. Throws Error
// naming the file if it cannot be read, its arrivals are not what capture_to_file writes, or there are neither arrivals
// nor a rate.
std::unique_ptr<ByteSource> open_capture(const std::filesystem::path& path, const CaptureConfig& config);

}  // namespace asperity
