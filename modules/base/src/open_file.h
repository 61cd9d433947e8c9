#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>

namespace asperity {

struct OpenFile {
  std::ifstream stream;
  std::uint64_t bytes = 0;
};

// A regular file, to be read. Throws Error naming it if it is none, cannot be opened or has more than `limit_bytes`.
OpenFile open_file(const std::filesystem::path& path, std::uint64_t limit_bytes);

// Throws Error naming the file if reading has failed.
void check_read(const std::ifstream& stream, const std::filesystem::path& path);

}  // namespace asperity
