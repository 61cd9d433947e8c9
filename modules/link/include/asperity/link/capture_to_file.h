#pragma once

#include <filesystem>
#include <memory>

#include "asperity/link/capture_failure.h"
#include "asperity/transport/byte_source.h"

namespace asperity {

// `source`, whose bytes are also written to a new file at `path`, and how many came when to `path`.arrivals.csv
// ("bytes,arrival_ns", one line an arrival): open_capture replays both. Each arrival is handed to the operating system
// before read() returns, and all is forced to the disk when the source is destroyed. Throws Error if a file exists
// already or cannot be made. What the disk refuses later is no fault of the source: it is noted in `failure`, and the
// source goes on without a capture.
std::unique_ptr<ByteSource> capture_to_file(std::unique_ptr<ByteSource> source, const std::filesystem::path& path,
                                            std::shared_ptr<CaptureFailure> failure);

}  // namespace asperity
