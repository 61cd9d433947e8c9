#include "asperity_firmware/frame.h"

#include <gmock/gmock.h>
#include <cstring>
#include <string_view>

#include "asperity/base/random.h"
#include "asperity_firmware/crc32.h"
#include "reference_decoder.h"

namespace asperity {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes written(const Bytes& payload, std::size_t capacity = 2048) {
  Bytes out(capacity);
  asp_frame_writer writer;
  asp_frame_begin(&writer, out.data(), out.size());
  asp_frame_put_bytes(&writer, payload.data(), payload.size());
  out.resize(asp_frame_end(&writer));
  return out;
}

Bytes random_payload(Random& random, std::size_t size, double zero_share) {
  Bytes out(size);
  for (auto& byte : out) {
    byte = random.uniform() < zero_share ? 0 : static_cast<std::uint8_t>(random.uniform() * 256.0);
  }
  return out;
}

TEST(FirmwareCrc, IsTheDocumentsCheckValue) {
  std::uint32_t state = ASP_CRC32_START;
  for (const char c : std::string_view("123456789")) state = asp_crc32_put(state, static_cast<std::uint8_t>(c));
  EXPECT_EQ(asp_crc32_result(state), 0xCBF43926u);
}

TEST(FirmwareFrame, IsWhatTheReferenceReads) {
  Random random(1);
  for (const double zero_share : {0.0, 0.01, 0.3, 1.0}) {
    for (std::size_t size = 2; size <= 1200; size += size < 600 ? 1 : 37) {
      const Bytes payload = random_payload(random, size, zero_share);
      const Bytes frame = written(payload);
      ASSERT_EQ(frame, reference::frame_of(payload)) << size << " bytes, zeros " << zero_share;
      ASSERT_LE(frame.size(), ASP_FRAME_BYTES(size));
      ASSERT_EQ(frame.back(), 0);
      const auto read = reference::payload_of(std::span(frame).first(frame.size() - 1));
      ASSERT_TRUE(read.has_value());
      ASSERT_EQ(*read, payload);
    }
  }
}

TEST(FirmwareFrame, HasItsBoundWhereNoByteIsZero) {
  // 0x55 throughout with its CRC gives no zero byte at these sizes, so that every group is full.
  for (const std::size_t size : {250u, 504u, 758u}) {
    Bytes payload(size, 0x55);
    Bytes frame = written(payload);
    while (std::count(frame.begin(), frame.end() - 1, 0) != 0 || frame.size() != ASP_FRAME_BYTES(size)) {
      ++payload[0];
      ASSERT_NE(payload[0], 0x55);
      frame = written(payload);
    }
    EXPECT_EQ(*reference::payload_of(std::span(frame).first(frame.size() - 1)), payload);
  }
}

TEST(FirmwareFrame, WritesNumbersLittleEndian) {
  Bytes out(64);
  asp_frame_writer writer;
  asp_frame_begin(&writer, out.data(), out.size());
  asp_frame_put_u8(&writer, 0x01);
  asp_frame_put_u16(&writer, 0x0302);
  asp_frame_put_u32(&writer, 0x07060504);
  asp_frame_put_u64(&writer, 0x0F0E0D0C0B0A0908);
  out.resize(asp_frame_end(&writer));
  const auto read = reference::payload_of(std::span(out).first(out.size() - 1));
  ASSERT_TRUE(read.has_value());
  for (std::size_t i = 0; i < read->size(); ++i) EXPECT_EQ(read->at(i), i + 1);
}

TEST(FirmwareFrame, ThatDoesNotFitIsNoneAndWritesNoByteTooMany) {
  Random random(2);
  for (const double zero_share : {0.0, 0.3, 1.0}) {
    const Bytes payload = random_payload(random, 300, zero_share);
    const std::size_t size = written(payload).size();
    for (std::size_t capacity = 0; capacity < size; ++capacity) {
      Bytes out(capacity + 8, 0xAB);
      asp_frame_writer writer;
      asp_frame_begin(&writer, out.data(), capacity);
      asp_frame_put_bytes(&writer, payload.data(), payload.size());
      ASSERT_EQ(asp_frame_end(&writer), 0u) << capacity;
      for (std::size_t i = capacity; i < out.size(); ++i) ASSERT_EQ(out[i], 0xAB);
    }
    EXPECT_EQ(written(payload, size).size(), size);
  }
}

}  // namespace
}  // namespace asperity
