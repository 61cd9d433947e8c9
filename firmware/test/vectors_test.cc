// The document's vectors and conformance files. Their bytes were made by neither of the two implementations.

#include <gmock/gmock.h>
#include <deque>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <sstream>

#include "asperity_firmware/probe.h"
#include "reference_decoder.h"

namespace asperity {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes from_hex(const std::string& text) {
  std::istringstream in(text);
  Bytes out;
  for (unsigned value = 0; in >> std::hex >> value;) out.push_back(static_cast<std::uint8_t>(value));
  return out;
}

// Gives what it was given, and keeps what was written.
struct ListBoard {
  std::deque<asp_imu_row> rows;
  std::deque<asp_force_sample> forces;
  std::uint64_t now_us = 0;
  Bytes written;
  asp_board board = {this, clock, read_imu, read_force, write, nullptr, nullptr};

  ListBoard() = default;
  ListBoard(const ListBoard&) = delete;
  ListBoard& operator=(const ListBoard&) = delete;

  static std::uint64_t clock(void* context) { return static_cast<ListBoard*>(context)->now_us; }
  static std::size_t read_imu(void* context, asp_imu_row* rows, std::size_t capacity) {
    auto& waiting = static_cast<ListBoard*>(context)->rows;
    std::size_t count = 0;
    for (; count < capacity && !waiting.empty(); ++count) {
      rows[count] = waiting.front();
      waiting.pop_front();
    }
    return count;
  }
  static bool read_force(void* context, asp_force_sample* sample) {
    auto& waiting = static_cast<ListBoard*>(context)->forces;
    if (waiting.empty()) return false;
    *sample = waiting.front();
    waiting.pop_front();
    return true;
  }
  static std::size_t write(void* context, const std::uint8_t* bytes, std::size_t count) {
    auto& written = static_cast<ListBoard*>(context)->written;
    written.insert(written.end(), bytes, bytes + count);
    return count;
  }
};

struct Counters {
  std::uint32_t sequence = 0;
  std::uint32_t index = 0;
  bool start = false;
};

// The one sample frame that the probe makes of what the board has.
Bytes frame_of(ListBoard& board, bool gyro, bool force3, std::uint64_t time_us, const Counters& counters) {
  const asp_description description = {"p", "1", 4000, -32768, 32767, 200.0, gyro, 900.0, force3 ? 3 : 1, 1000, 1e-6};
  const auto probe = std::make_unique<asp_probe>();
  board.now_us = time_us;
  EXPECT_TRUE(asp_probe_init(probe.get(), &board.board, &description, nullptr));
  probe->sequence = counters.sequence;
  probe->next_index = probe->expected_index = counters.index;
  probe->start = counters.start;
  asp_probe_step(probe.get());
  board.written.clear();  // the description
  board.now_us += 20'000;
  asp_probe_step(probe.get());
  return board.written;
}

TEST(FirmwareVectors, SamplesWithGyroscope) {
  ListBoard board;
  board.rows = {{1'000'000'000, {1, -2, 2049}, {3, -4, 5}, 0}, {1'000'250'000, {0, 256, -256}, {-32768, 32767, 0}, 0}};
  board.forces = {{998'500, {123456, 0, 0}}};
  EXPECT_EQ(frame_of(board, true, false, 1'000'400, {7, 28, false}),
            from_hex("06 01 01 04 02 01 01 01 02 07 01 01 02 1c 01 01 04 40 42 0f 01 01 01 01 04 90 d0 03 02 01 06 fe "
                     "ff 01 08 03 04 fc ff 05 01 01 01 02 01 02 ff 04 80 ff 7f 01 08 24 fa ff ff 40 e2 01 05 65 b4 f0 "
                     "bf 00"));
}

TEST(FirmwareVectors, SamplesWithout) {
  ListBoard board;
  board.rows = {{1'000'500'000, {10, 20, 30}, {1, 2, 3}, 0}};
  EXPECT_EQ(frame_of(board, false, false, 1'000'500, {8, 30, false}),
            from_hex("03 01 01 02 01 01 01 01 02 08 01 01 02 1e 01 01 04 34 44 0f 01 01 01 01 01 01 01 01 02 0a 02 14 "
                     "02 1e 05 1d 94 c2 18 00"));
}

TEST(FirmwareVectors, ThreeAxisForceAtTheStart) {
  ListBoard board;
  board.rows = {{5'000'000'000'000, {1, 2, 3}, {}, 0}, {5'000'000'250'000, {4, 5, 6}, {}, 0}};
  board.forces = {{5'000'000'100, {-1, 2, -300'000}}};
  EXPECT_EQ(frame_of(board, false, true, 5'000'000'300, {0, 0, true}),
            from_hex("06 01 01 09 02 01 01 01 01 01 01 01 01 01 01 01 01 05 f2 05 2a 01 01 01 04 90 d0 03 02 01 02 02 "
                     "02 03 02 04 02 05 02 06 02 64 01 01 06 ff ff ff ff 02 01 01 09 20 6c fb ff c2 1c 62 dd 00"));
}

TEST(FirmwareVectors, RequestIsHeard) {
  asp_request_reader reader{};
  int heard = 0;
  for (const std::uint8_t byte : from_hex("07 01 81 08 90 7d c2 00")) heard += asp_request_put(&reader, byte) ? 1 : 0;
  EXPECT_EQ(heard, 1);
}

Bytes written_by_firmware(std::span<const std::uint8_t> payload) {
  Bytes out(ASP_FRAME_BYTES(payload.size()));
  asp_frame_writer writer;
  asp_frame_begin(&writer, out.data(), out.size());
  asp_frame_put_bytes(&writer, payload.data(), payload.size());
  out.resize(asp_frame_end(&writer));
  return out;
}

// A block may end with an empty group after a full one, which the firmware leaves out.
bool ends_with_an_empty_group(const Bytes& block, const Bytes& again) {
  return block.size() == again.size() + 1 && block.back() == 1;
}

TEST(FirmwareVectors, ConformanceFilesFramesAreTheSameBytes) {
  int frames = 0;
  for (const auto& entry : std::filesystem::directory_iterator(ASPERITY_PROTOCOL_DATA)) {
    if (entry.path().extension() != ".bin") continue;
    std::ifstream file(entry.path(), std::ios::binary);
    Bytes block;
    for (std::istreambuf_iterator<char> at(file), end; at != end; ++at) {
      block.push_back(static_cast<std::uint8_t>(*at));
      if (block.back() != 0) continue;
      block.pop_back();
      if (const auto payload = reference::payload_of(block)) {  // others are damaged on purpose
        Bytes again = written_by_firmware(*payload);
        again.pop_back();
        if (!ends_with_an_empty_group(block, again)) {
          EXPECT_EQ(again, block) << entry.path();
        }
        ++frames;
      }
      block.clear();
    }
  }
  EXPECT_GT(frames, 50);
}

}  // namespace
}  // namespace asperity
