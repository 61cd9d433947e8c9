#include "block_checksums.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <optional>

#include <fmt/format.h>
#include "asperity/base/crc32.h"
#include "asperity/base/error.h"
#include "find_block.h"

namespace asperity {

namespace {

constexpr int kMostSearches = 16;
constexpr std::uint64_t kReach_bytes = 128 * 1024;  // two blocks to either side

template <class T>
bool take_number(std::string_view& line, T& value, int base) {
  const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), value, base);
  if (error != std::errc()) return false;
  line.remove_prefix(static_cast<std::size_t>(end - line.data()));
  if (line.empty()) return true;
  if (line.front() != ' ') return false;
  line.remove_prefix(1);
  return true;
}

bool fits(std::string_view content, std::uint64_t begin, const BlockChecksum& block, std::uint64_t& bytes_summed) {
  if (begin > content.size() || block.bytes > content.size() - begin) return false;
  bytes_summed += block.bytes;
  return crc32(content.substr(begin, block.bytes)) == block.crc;
}

}  // namespace

std::string checksum_header() {
  return "# CRC-32 (as in zip) of the streams' blocks: file, first byte, bytes, CRC-32\n";
}

void append_checksum(std::string& out, std::string_view file, const BlockChecksum& block) {
  out += fmt::format("{} {} {} {:08x}\n", file, block.begin, block.bytes, block.crc);
}

void BlockSum::add(std::string_view lines) {
  block_.crc = crc32_of_more(block_.crc, lines);
  block_.bytes += lines.size();
}

BlockChecksum BlockSum::take() {
  const BlockChecksum out = block_;
  block_ = {out.begin + out.bytes, 0, 0};
  return out;
}

std::string checksum_lines(std::string_view file, std::string_view content) {
  std::string out;
  BlockSum sum;
  while (!content.empty()) {
    const std::size_t newline = content.find('\n');
    const std::size_t length = newline == std::string_view::npos ? content.size() : newline + 1;
    sum.add(content.substr(0, length));
    content.remove_prefix(length);
    if (sum.is_full() || content.empty()) append_checksum(out, file, sum.take());
  }
  return out;
}

std::string checksum_lines_of_file(const std::filesystem::path& path) {
  const std::string file = path.filename().string();
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error(path.string() + ": cannot be read");
  std::string out, line;
  BlockSum sum;
  while (std::getline(in, line)) {
    if (!in.eof()) line += '\n';
    sum.add(line);
    if (sum.is_full()) append_checksum(out, file, sum.take());
  }
  if (in.bad()) throw Error(path.string() + ": cannot be read");
  if (!sum.is_empty()) append_checksum(out, file, sum.take());
  return out;
}

std::vector<BlockChecksum> parse_checksums(std::string_view text, std::string_view file) {
  std::vector<BlockChecksum> out;
  while (!text.empty()) {
    const std::size_t newline = text.find('\n');
    if (newline == std::string_view::npos) break;  // cut off
    std::string_view line = text.substr(0, newline);
    text.remove_prefix(newline + 1);
    if (!line.starts_with(file) || line.size() <= file.size() || line[file.size()] != ' ') continue;
    line.remove_prefix(file.size() + 1);
    BlockChecksum block;
    if (!take_number(line, block.begin, 10) || !take_number(line, block.bytes, 10) || line.size() != 8 ||
        !take_number(line, block.crc, 16) || !line.empty())
      continue;
    const std::uint64_t end_of_last = out.empty() ? 0 : out.back().begin + out.back().bytes;
    // A block of ours is little above 64 KiB: a larger one is not, and would cost as much at each place it is looked
    // for.
    constexpr std::uint64_t kLastBegin = std::uint64_t{1} << 60, kLargest_bytes = std::uint64_t{1} << 20;
    if (block.bytes > 0 && block.begin >= end_of_last && block.begin < kLastBegin && block.bytes <= kLargest_bytes)
      out.push_back(block);
  }
  return out;
}

std::vector<ChangedBytes> find_changes(std::string_view content, const std::vector<BlockChecksum>& blocks,
                                       std::uint64_t* bytes_summed) {
  std::vector<ChangedBytes> out;
  std::uint64_t summed = 0;
  std::uint64_t found_end = 0;      // behind the last block that was found, here
  std::uint64_t found_end_was = 0;  // and there, where it was written
  bool missed = false;              // a block since then was not found
  std::uint64_t missed_end = 0;     // where the last one missed should end
  int searches = 0;
  const auto note = [&](std::uint64_t begin, std::uint64_t end) {
    end = std::min<std::uint64_t>(end, content.size());
    begin = std::min(begin, end);
    if (!out.empty() && begin == out.back().end) {
      out.back().end = std::max(out.back().end, end);
    } else {
      out.push_back({begin, end});
    }
  };
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const BlockChecksum& block = blocks[i];
    const std::uint64_t expected = found_end + (block.begin - found_end_was);
    std::optional<std::uint64_t> at;
    // A block whose follower lies where it should has other bytes, as many as before: it need not be looked for.
    const bool follower_fits =
        i + 1 < blocks.size() && fits(content, expected + (blocks[i + 1].begin - block.begin), blocks[i + 1], summed);
    if (fits(content, expected, block, summed)) {
      at = expected;
    } else if (!follower_fits && searches < kMostSearches) {
      ++searches;
      // Among the lines around the place where it should be.
      const std::uint64_t last = std::min<std::uint64_t>(content.size(), expected + kReach_bytes);
      const std::uint64_t first = std::max(found_end, expected > kReach_bytes ? expected - kReach_bytes : 0);
      at = find_block(content, first, last, block, summed);
    }
    if (!at) {
      missed = true;
      missed_end = expected + block.bytes;
      continue;
    }
    // Between two blocks lies what was missed, or what somebody has put there, or nothing where bytes have gone.
    if (missed || *at != expected) note(found_end, *at);
    found_end = *at + block.bytes;
    found_end_was = block.begin + block.bytes;
    missed = false;
  }
  if (missed) note(found_end, missed_end);
  if (bytes_summed != nullptr) *bytes_summed += summed;
  return out;
}

}  // namespace asperity
