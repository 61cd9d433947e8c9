#include "find_block.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "asperity/base/crc32.h"
#include "asperity/base/random.h"

namespace asperity {
namespace {

std::string lines(Random& random, std::size_t bytes) {
  std::string out;
  while (out.size() < bytes) out += random.uniform() < 0.2 ? '\n' : static_cast<char>('0' + int(10 * random.uniform()));
  return out;
}

// By the definition: the sum of each piece for itself.
std::optional<std::uint64_t> find_slowly(const std::string& text, std::uint64_t first, std::uint64_t last,
                                         const BlockChecksum& block) {
  for (std::uint64_t at = first; at < last && at + block.bytes <= text.size(); ++at) {
    if (at != first && text[at - 1] != '\n') continue;
    if (crc32(std::string_view(text).substr(at, block.bytes)) == block.crc) return at;
  }
  return std::nullopt;
}

TEST(FindBlock, IsWhereTheSumOfThePieceSaysSo) {
  Random random(3);
  int found = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const std::string text = lines(random, 1 + static_cast<std::size_t>(400 * random.uniform()));
    const auto below = [&](double most) { return static_cast<std::uint64_t>(most * random.uniform()); };
    const std::uint64_t begin = below(static_cast<double>(text.size()));
    const std::uint64_t bytes = 1 + below(static_cast<double>(text.size() - begin));
    const std::uint64_t first = below(static_cast<double>(begin) + 1.0), last = first + below(500.0);
    BlockChecksum block{begin, bytes, crc32(std::string_view(text).substr(begin, bytes))};
    if (trial % 5 == 0) block.crc ^= 1;
    std::uint64_t summed = 0;
    const auto place = find_block(text, first, last, block, summed);
    EXPECT_EQ(place, find_slowly(text, first, last, block)) << trial;
    EXPECT_LE(summed, block.bytes + 2 * text.size());
    found += place.has_value();
  }
  EXPECT_GT(found, 30);
}

// A file that lists blocks which are nowhere, in a stream whose every byte begins a line: what is summed is in
// proportion to the stream, and the searches are as many as ever.
TEST(FindBlock, WorkOfForeignChecksumsIsLinear) {
  const auto work = [](std::size_t bytes) {
    const std::string text(bytes, '\n');
    std::vector<BlockChecksum> blocks;
    for (std::uint64_t at = 0; at + 65'536 <= bytes; at += 65'536) blocks.push_back({at, 65'536, 0x12345678u});
    std::uint64_t summed = 0;
    EXPECT_FALSE(find_changes(text, blocks, &summed).empty());
    return summed;
  };
  const std::uint64_t small = work(std::size_t{1} << 20), large = work(std::size_t{4} << 20);
  EXPECT_LE(small, std::uint64_t{14} << 20);
  EXPECT_LE(large, 4 * small);
}

}  // namespace
}  // namespace asperity
