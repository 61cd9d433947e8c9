#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "asperity/recording/recover_recording.h"

namespace asperity {

// True if `file` is in the folder, links followed, and is not outside. Throws Error if the disk cannot say so: what
// cannot be looked up is not lost.
bool is_own_file(const std::filesystem::path& folder, const std::string& file);

// The whole rows of a stream, with its header; empty if nothing is to be had. `checksums` is the content of
// checksums.txt. Throws Error if the file cannot be read or is too large.
std::string recover_stream(const std::filesystem::path& folder, const std::string& file, std::string_view checksums,
                           const RecoverOptions& options, const ReadLimits& limits, RecoveredStream& stream);

}  // namespace asperity
