#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

// A reader of docs/probe-protocol.md that shares nothing with the firmware or the host's decoder, and is as slow and
// plain as the document: the oracle of the firmware's tests.
namespace asperity::reference {

struct Row {
  std::array<int, 3> accel{};
  std::array<int, 3> gyro{};
  bool operator==(const Row&) const = default;
};

struct Force {
  std::int32_t offset_us = 0;
  std::array<std::int32_t, 3> counts{};
  bool operator==(const Force&) const = default;
};

struct SampleFrame {
  bool start = false;
  bool overrun = false;
  bool gyro = false;
  bool force3 = false;
  std::uint32_t sequence = 0;
  std::uint32_t imu_index = 0;
  std::uint64_t time_us = 0;
  std::uint32_t imu_period_ns = 0;
  std::vector<Row> rows;
  std::vector<Force> forces;
};

struct Decoded {
  std::vector<SampleFrame> samples;
  std::vector<std::string> descriptions;
  std::vector<char> order;  // 's' or 'd', as they came
  int damaged = 0;          // blocks that are no frames
};

std::uint32_t crc32(std::span<const std::uint8_t> bytes);

// The payload of the block between two zero bytes; nullopt if it is not one.
std::optional<std::vector<std::uint8_t>> payload_of(std::span<const std::uint8_t> block);

// Frame on the line of a payload.
std::vector<std::uint8_t> frame_of(std::span<const std::uint8_t> payload);

// Throws std::runtime_error for a sound frame that breaks the document.
Decoded decode(std::span<const std::uint8_t> bytes);

}  // namespace asperity::reference
