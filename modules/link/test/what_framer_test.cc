#include "../src/what_framer.h"

#include <gmock/gmock.h>
#include <algorithm>
#include <cstdio>

#include "asperity/base/random.h"
#include "asperity/testkit/corrupt_bytes.h"

namespace asperity {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Data = std::array<std::uint8_t, 4>;

std::vector<WhatFrame> frames_of(const Bytes& bytes, std::size_t piece = 7) {
  WhatFramer framer;
  std::vector<WhatFrame> frames;
  for (std::size_t at = 0; at < bytes.size(); at += piece) {
    framer.push(std::span(bytes).subspan(at, std::min(piece, bytes.size() - at)), frames);
  }
  return frames;
}

// Frames of noisy sensors; `stuck` of the four sends FFh.
std::vector<Data> random_data(int count, int stuck, double full_chance, Random& random) {
  std::vector<Data> out(static_cast<std::size_t>(count));
  for (auto& data : out) {
    for (int i = 0; i < 4; ++i) {
      const bool full = i == stuck || random.chance(full_chance);
      data[static_cast<std::size_t>(i)] = full ? 0xFF : static_cast<std::uint8_t>(random.bits() >> 56);
    }
  }
  return out;
}

Bytes bytes_of(const std::vector<Data>& frames) {
  Bytes out;
  for (const Data& data : frames) {
    out.push_back(0xFF);
    out.insert(out.end(), data.begin(), data.end());
  }
  return out;
}

std::vector<Data> data_of(const std::vector<WhatFrame>& frames) {
  std::vector<Data> out;
  for (const WhatFrame& frame : frames) out.push_back(frame.data);
  return out;
}

TEST(WhatFramer, CleanStreamIsReadWhole) {
  Random random(1);
  for (const double full_chance : {0.0, 0.1, 0.4}) {
    const auto sent = random_data(2000, -1, full_chance, random);
    for (const std::size_t piece : {1, 3, 5, 64, 100'000}) {
      const auto got = data_of(frames_of(bytes_of(sent), piece));
      // The first may have gone by before the step was certain, the last waits for the next one's start byte.
      ASSERT_GE(got.size(), full_chance < 0.2 ? 1998u : 1980u);
      EXPECT_TRUE(std::equal(got.rbegin(), got.rend(), sent.rbegin() + 1)) << piece;
    }
  }
}

// One byte damaged, lost or too many in a stream that was read before: never more than a frame of what comes after the
// damage is given wrong, and from the fifth clean frame on all are there. Also with a sensor at its stop, whose byte is
// FFh always.
TEST(WhatFramer, BackWithinFiveCleanFrames) {
  Random random(2);
  for (const int stuck : {-1, 0, 2, 3}) {
    // A sensor that is at its stop was not always.
    auto sent = random_data(60, -1, 0.02, random);
    const auto later = random_data(160, stuck, 0.02, random);
    sent.insert(sent.end(), later.begin(), later.end());
    const Bytes whole = bytes_of(sent);
    for (std::size_t at = 800; at < 825; ++at) {
      const auto place = static_cast<std::ptrdiff_t>(at);
      std::vector<Bytes> damaged;
      for (int bit = 0; bit < 8; ++bit) {
        damaged.push_back(whole);
        damaged.back()[at] ^= static_cast<std::uint8_t>(1U << bit);
      }
      for (const int count : {1, 2, 3, 4, 5, 7}) {
        damaged.push_back(whole);
        damaged.back().erase(damaged.back().begin() + place, damaged.back().begin() + place + count);
        damaged.push_back(whole);
        Bytes extra(static_cast<std::size_t>(count));
        for (auto& byte : extra) byte = static_cast<std::uint8_t>(random.bits() >> 56);
        damaged.back().insert(damaged.back().begin() + place, extra.begin(), extra.end());
      }
      for (std::size_t c = 0; c < damaged.size(); ++c) {
        const Bytes& bytes = damaged[c];
        const auto got = data_of(frames_of(bytes));
        // The damage ends at the latest in frame 160 + 3 + 1; five clean frames later all are there.
        const std::size_t tail = sent.size() - 1 - 169;
        ASSERT_GE(got.size(), tail);
        EXPECT_TRUE(std::equal(got.rbegin(), got.rbegin() + static_cast<std::ptrdiff_t>(tail), sent.rbegin() + 1))
            << "byte " << at << ", sensor " << stuck << ", damage " << c;
        const auto before = static_cast<std::size_t>(
            std::mismatch(got.begin(), got.end(), sent.begin(), sent.end()).first - got.begin());
        EXPECT_GE(before, 158u);
      }
    }
  }
}

TEST(WhatFramer, EveryFrameHadItsStartByte) {
  Random random(3);
  for (int run = 0; run < 20; ++run) {
    Bytes bytes;
    testkit::corrupt_bytes(bytes_of(random_data(1000, run % 6 - 1, 0.05, random)), {0.02, 0.02, 0.02}, random, bytes);
    const auto frames = frames_of(bytes);
    std::uint64_t before = 0;
    bool is_first = true;
    for (const WhatFrame& frame : frames) {
      const std::size_t start = frame.end - 5;
      ASSERT_EQ(bytes[start], 0xFF);
      ASSERT_TRUE(
          std::equal(frame.data.begin(), frame.data.end(), bytes.begin() + static_cast<std::ptrdiff_t>(start) + 1));
      ASSERT_GE(start, before);
      if (!is_first) {
        EXPECT_EQ(frame.skipped, start - before);
      }
      is_first = false;
      before = frame.end;
    }
  }
}

// What cannot be told apart is not guessed: no phase of a line of FFh is likelier than another.
TEST(WhatFramer, NothingIsMadeOfNothing) {
  EXPECT_TRUE(frames_of(Bytes(10'000, 0xFF)).empty());
  EXPECT_TRUE(frames_of(Bytes(10'000, 0x00)).empty());
  Random random(4);
  Bytes noise(100'000);
  for (auto& byte : noise) byte = static_cast<std::uint8_t>(random.bits() >> 56);
  EXPECT_LT(frames_of(noise).size(), 20u);
}

// 0.3 % of the bytes flipped, dropped and inserted: which frames are given wrong, and how many are lost.
TEST(WhatFramer, DamageInSilence) {
  Random random(5);
  std::vector<Data> sent(50'000);
  for (std::size_t i = 0; i < sent.size(); ++i) {
    // The number, so that a frame that was not sent is known: 19 bits of it and 9 that check it; at times a byte is
    // FFh.
    const std::uint32_t check = (static_cast<std::uint32_t>(i) * 2654435761U) >> 19;
    const std::uint32_t word = static_cast<std::uint32_t>(i) | check << 19;
    for (std::size_t k = 0; k < 4; ++k) sent[i][k] = static_cast<std::uint8_t>(word >> (8 * k));
  }
  Bytes bytes;
  testkit::corrupt_bytes(bytes_of(sent), {0.003, 0.003, 0.003}, random, bytes);
  const auto got = data_of(frames_of(bytes));
  std::size_t wrong = 0;
  for (const Data& data : got) {
    const std::uint32_t word = data[0] | data[1] << 8 | data[2] << 16 | static_cast<std::uint32_t>(data[3]) << 24;
    const std::uint32_t number = word & 0x7FFFFU;
    if (number >= sent.size() || sent[number] != data) ++wrong;
  }
  const auto share = static_cast<double>(wrong) / static_cast<double>(got.size());
  std::printf("frames: sent %zu, given %zu, of these damaged in silence %.2f %%\n", sent.size(), got.size(),
              100.0 * share);
  // A bit flipped in one of four data bytes: 1.2 % cannot be seen.
  EXPECT_NEAR(share, 0.012, 0.003);
  EXPECT_GT(got.size(), sent.size() * 93 / 100);
}

}  // namespace
}  // namespace asperity
