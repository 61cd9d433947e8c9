#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace asperity {

// checksums.txt of a recording: a line a block of a stream, `probe.csv 0 65573 9ae0daaf`: the file, the block's first
// byte, its length in bytes, and its CRC-32 as in zip, hexadecimal. A block ends where a line ends. Lines that begin
// with # are remarks. What no block holds is not checked.
inline constexpr const char* kChecksumFile = "checksums.txt";

struct BlockChecksum {
  std::uint64_t begin = 0;
  std::uint64_t bytes = 0;
  std::uint32_t crc = 0;
};

std::string checksum_header();
void append_checksum(std::string& out, std::string_view file, const BlockChecksum& block);

// The CRC-32 of a stream's blocks while it is written.
class BlockSum {
 public:
  void add(std::string_view lines);
  bool is_full() const { return block_.bytes >= kBlock_bytes; }
  bool is_empty() const { return block_.bytes == 0; }
  // The block so far; the next begins behind it.
  BlockChecksum take();

 private:
  static constexpr std::uint64_t kBlock_bytes = 64 * 1024;
  BlockChecksum block_;
};

// The lines of checksums.txt for a whole file.
std::string checksum_lines(std::string_view file, std::string_view content);
// The same of a file on disk, by its name, without holding it. Throws Error if it cannot be read.
std::string checksum_lines_of_file(const std::filesystem::path& path);

// The blocks of `file` that `text` (checksums.txt) lists, in order. A line that is not one is passed over: what it
// spoke of is not checked.
std::vector<BlockChecksum> parse_checksums(std::string_view text, std::string_view file);

// Bytes of a stream, [begin, end), that are not what its checksum says; none (begin = end) where bytes have gone.
struct ChangedBytes {
  std::uint64_t begin = 0;
  std::uint64_t end = 0;
};

// Where `content` differs from its blocks, in order, neighbours joined. Where bytes have gone or come in between, the
// blocks behind are looked for at the lines nearby, at most 16 times: only what lies between blocks that were found is
// changed. Bytes behind the last listed block are not judged. `bytes_summed` gets what was summed for that: a few times
// the content at most.
std::vector<ChangedBytes> find_changes(std::string_view content, const std::vector<BlockChecksum>& blocks,
                                       std::uint64_t* bytes_summed = nullptr);

}  // namespace asperity
