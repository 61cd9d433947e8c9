#pragma once

#include <filesystem>
#include <vector>

#include "asperity/recording/recording.h"

namespace asperity {

// True if a row's time lies in none of `segments`. Throws Error if the file cannot be read.
bool has_other_rows(const std::filesystem::path& path, const std::vector<Segment>& segments);

// Takes the rows whose time (the first cell) lies in none of `segments` out of a stream, piece by piece, and
// replaces the file by rename. The header stays. Throws Error if a file cannot be read or written.
void keep_rows(const std::filesystem::path& path, const std::vector<Segment>& segments);

}  // namespace asperity
