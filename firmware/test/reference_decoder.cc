#include "reference_decoder.h"

#include <stdexcept>

namespace asperity::reference {
namespace {

class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::uint64_t take(int count) {
    std::uint64_t value = 0;
    for (int i = 0; i < count; ++i) {
      if (at_ >= bytes_.size()) throw std::runtime_error("payload too short");
      value += std::uint64_t{bytes_[at_++]} << (8 * i);
    }
    return value;
  }
  int take_i16() {
    const int value = static_cast<int>(take(2));
    return value < 32768 ? value : value - 65536;
  }
  std::int32_t take_i32() { return static_cast<std::int32_t>(static_cast<std::uint32_t>(take(4))); }
  bool at_end() const { return at_ == bytes_.size(); }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

void expect(bool holds, const char* what) {
  if (!holds) throw std::runtime_error(what);
}

SampleFrame parse_samples(std::span<const std::uint8_t> payload) {
  Reader reader(payload);
  reader.take(2);
  SampleFrame out;
  const auto flags = reader.take(1);
  out.start = (flags & 1) != 0;
  out.overrun = (flags & 2) != 0;
  out.gyro = (flags & 4) != 0;
  out.force3 = (flags & 8) != 0;
  expect((flags & 0xF0) == 0, "other flags are sent as 0");
  const auto imu_count = reader.take(1);
  const auto force_count = reader.take(1);
  expect(imu_count <= 64 && force_count <= 16, "counts");
  expect(reader.take(3) == 0, "reserved bytes are sent as 0");
  out.sequence = static_cast<std::uint32_t>(reader.take(4));
  out.imu_index = static_cast<std::uint32_t>(reader.take(4));
  out.time_us = reader.take(8);
  out.imu_period_ns = static_cast<std::uint32_t>(reader.take(4));
  expect((imu_count >= 2) == (out.imu_period_ns > 0), "the period is 0 for fewer than two rows");
  for (std::uint64_t i = 0; i < imu_count; ++i) {
    Row row;
    for (int& value : row.accel) value = reader.take_i16();
    if (out.gyro) {
      for (int& value : row.gyro) value = reader.take_i16();
    }
    out.rows.push_back(row);
  }
  for (std::uint64_t i = 0; i < force_count; ++i) {
    Force force;
    force.offset_us = reader.take_i32();
    for (int axis = 0; axis < (out.force3 ? 3 : 1); ++axis) force.counts[axis] = reader.take_i32();
    out.forces.push_back(force);
  }
  expect(reader.at_end(), "payload longer than its counts say");
  return out;
}

}  // namespace

std::uint32_t crc32(std::span<const std::uint8_t> bytes) {
  std::uint32_t crc = 0xFFFFFFFFu;
  for (const std::uint8_t byte : bytes) {
    for (int bit = 0; bit < 8; ++bit) {
      const bool one = ((crc ^ (byte >> bit)) & 1) != 0;
      crc >>= 1;
      if (one) crc ^= 0xEDB88320u;
    }
  }
  return ~crc;
}

std::optional<std::vector<std::uint8_t>> payload_of(std::span<const std::uint8_t> block) {
  std::vector<std::uint8_t> out;
  std::size_t at = 0;
  while (at < block.size()) {
    const std::size_t code = block[at];
    if (code == 0 || at + code > block.size()) return std::nullopt;
    out.insert(out.end(), block.begin() + at + 1, block.begin() + at + code);
    at += code;
    if (code < 255 && at < block.size()) out.push_back(0);
  }
  if (out.size() < 6 || out.size() > 1204) return std::nullopt;
  const std::span<const std::uint8_t> payload(out.data(), out.size() - 4);
  Reader crc(std::span<const std::uint8_t>(out).last(4));
  if (crc.take(4) != crc32(payload)) return std::nullopt;
  out.resize(out.size() - 4);
  return out;
}

std::vector<std::uint8_t> frame_of(std::span<const std::uint8_t> payload) {
  std::vector<std::uint8_t> plain(payload.begin(), payload.end());
  const std::uint32_t crc = crc32(payload);
  for (int i = 0; i < 4; ++i) plain.push_back(static_cast<std::uint8_t>(crc >> (8 * i)));
  plain.push_back(0);  // the one that COBS takes away
  std::vector<std::uint8_t> out;
  std::vector<std::uint8_t> group;
  for (std::size_t i = 0; i < plain.size(); ++i) {
    if (plain[i] != 0) group.push_back(plain[i]);
    const bool full = group.size() == 254;
    if (plain[i] != 0 && !full) continue;
    out.push_back(static_cast<std::uint8_t>(group.size() + 1));
    out.insert(out.end(), group.begin(), group.end());
    group.clear();
    if (full && i + 2 == plain.size()) break;
  }
  out.push_back(0);
  return out;
}

Decoded decode(std::span<const std::uint8_t> bytes) {
  Decoded out;
  std::vector<std::uint8_t> block;
  for (const std::uint8_t byte : bytes) {
    if (byte != 0) {
      block.push_back(byte);
      continue;
    }
    if (block.empty()) continue;
    const auto payload = payload_of(block);
    block.clear();
    if (!payload) {
      ++out.damaged;
      continue;
    }
    expect(payload->at(0) == 1, "version");
    if (payload->at(1) == 1) {
      out.samples.push_back(parse_samples(*payload));
      out.order.push_back('s');
    } else {
      expect(payload->at(1) == 2, "type");
      out.descriptions.emplace_back(payload->begin() + 2, payload->end());
      out.order.push_back('d');
    }
  }
  return out;
}

}  // namespace asperity::reference
