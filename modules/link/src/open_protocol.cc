#include "asperity/link/open_protocol.h"

#include <fmt/format.h>

#include "asperity/base/crc32.h"
#include "asperity/base/error.h"
#include "asperity/base/little_endian.h"
#include "asperity/link/cobs.h"

namespace asperity {

namespace {

constexpr std::size_t kHeader_bytes = 28;
constexpr std::size_t kCrc_bytes = 4;
constexpr std::size_t kFaults_bytes = 36;

constexpr std::uint8_t kStart = 0x01;
constexpr std::uint8_t kOverrun = 0x02;
constexpr std::uint8_t kGyro = 0x04;
constexpr std::uint8_t kForce3 = 0x08;

static_assert(cobs_bound(kOpenMaxPayload_bytes + kCrc_bytes) == kOpenMaxBlock_bytes);
static_assert(kHeader_bytes + kOpenMaxRows * 12 + kOpenMaxForces * 16 <= kOpenMaxPayload_bytes);

}  // namespace

std::optional<std::span<const std::uint8_t>> open_block_payload(std::span<const std::uint8_t> block,
                                                                OpenPayload& room) noexcept {
  const auto size = decode_cobs(block, room);
  if (!size || *size < 2 + kCrc_bytes) return std::nullopt;
  const std::span<const std::uint8_t> payload(room.data(), *size - kCrc_bytes);
  std::size_t at = payload.size();
  if (take_little_endian<std::uint32_t>(room, at) != crc32(payload)) return std::nullopt;
  return payload;
}

bool parse_open_samples(std::span<const std::uint8_t> payload, OpenSamples& out) noexcept {
  if (payload.size() < kHeader_bytes || payload[0] != kOpenVersion || payload[1] != kOpenSamplesType) return false;
  const std::uint8_t flags = payload[2];
  out.start = (flags & kStart) != 0;
  out.overrun = (flags & kOverrun) != 0;
  out.has_gyro = (flags & kGyro) != 0;
  out.has_force3 = (flags & kForce3) != 0;
  out.row_count = payload[3];
  out.force_count = payload[4];
  if (out.row_count > kOpenMaxRows || out.force_count > kOpenMaxForces) return false;
  const std::size_t row_bytes = out.has_gyro ? 12 : 6;
  const std::size_t force_bytes = out.has_force3 ? 16 : 8;
  if (payload.size() != kHeader_bytes + out.row_count * row_bytes + out.force_count * force_bytes) return false;
  std::size_t at = 8;
  out.sequence = take_little_endian<std::uint32_t>(payload, at);
  out.imu_index = take_little_endian<std::uint32_t>(payload, at);
  out.time_us = take_little_endian<std::uint64_t>(payload, at);
  out.imu_period_ns = take_little_endian<std::uint32_t>(payload, at);
  if (out.row_count > 1 && out.imu_period_ns == 0) return false;
  for (std::size_t i = 0; i < out.row_count; ++i) {
    for (auto& value : out.rows[i].accel) value = take_little_endian<std::int16_t>(payload, at);
    out.rows[i].gyro = {};
    if (!out.has_gyro) continue;
    for (auto& value : out.rows[i].gyro) value = take_little_endian<std::int16_t>(payload, at);
  }
  for (std::size_t i = 0; i < out.force_count; ++i) {
    out.forces[i].offset_us = take_little_endian<std::int32_t>(payload, at);
    out.forces[i].counts = {};
    for (std::size_t axis = 0; axis < (out.has_force3 ? 3U : 1U); ++axis) {
      out.forces[i].counts[axis] = take_little_endian<std::int32_t>(payload, at);
    }
  }
  return true;
}

std::optional<ProbeFaults> parse_open_faults(std::span<const std::uint8_t> payload) noexcept {
  if (payload.size() < kFaults_bytes || payload[0] != kOpenVersion || payload[1] != kOpenFaultsType)
    return std::nullopt;
  ProbeFaults out;
  out.imu_state = payload[2];
  out.force_state = payload[3];
  std::size_t at = 4;
  for (std::uint32_t* count : {&out.imu_bus_failures, &out.imu_overflows, &out.imu_lost_sync, &out.imu_invalid_rows,
                               &out.imu_restarts, &out.force_bus_failures, &out.force_skipped, &out.force_restarts}) {
    *count = take_little_endian<std::uint32_t>(payload, at);
  }
  return out;
}

void append_open_frame(std::span<const std::uint8_t> payload, std::vector<std::uint8_t>& out) {
  if (payload.size() < 2 || payload.size() > kOpenMaxPayload_bytes) {
    throw Error(
        fmt::format("open protocol: a payload has 2 to {} bytes, not {}", kOpenMaxPayload_bytes, payload.size()));
  }
  std::vector<std::uint8_t> checked(payload.begin(), payload.end());
  append_little_endian(checked, crc32(payload));
  append_cobs(checked, out);
  out.push_back(0);
}

void append_open_samples(const OpenSamples& samples, std::vector<std::uint8_t>& out) {
  if (samples.row_count > kOpenMaxRows || samples.force_count > kOpenMaxForces) {
    throw Error(fmt::format("open protocol: a frame has at most {} rows and {} forces, not {} and {}", kOpenMaxRows,
                            kOpenMaxForces, samples.row_count, samples.force_count));
  }
  if (samples.row_count > 1 && samples.imu_period_ns == 0) throw Error("open protocol: rows need a period");
  std::vector<std::uint8_t> payload;
  payload.reserve(kOpenMaxPayload_bytes);
  payload.push_back(kOpenVersion);
  payload.push_back(kOpenSamplesType);
  payload.push_back(static_cast<std::uint8_t>((samples.start ? kStart : 0) | (samples.overrun ? kOverrun : 0) |
                                              (samples.has_gyro ? kGyro : 0) | (samples.has_force3 ? kForce3 : 0)));
  payload.push_back(static_cast<std::uint8_t>(samples.row_count));
  payload.push_back(static_cast<std::uint8_t>(samples.force_count));
  payload.insert(payload.end(), 3, 0);
  append_little_endian(payload, samples.sequence);
  append_little_endian(payload, samples.imu_index);
  append_little_endian(payload, samples.time_us);
  append_little_endian(payload, samples.imu_period_ns);
  for (std::size_t i = 0; i < samples.row_count; ++i) {
    for (const auto value : samples.rows[i].accel) append_little_endian(payload, value);
    if (!samples.has_gyro) continue;
    for (const auto value : samples.rows[i].gyro) append_little_endian(payload, value);
  }
  for (std::size_t i = 0; i < samples.force_count; ++i) {
    append_little_endian(payload, samples.forces[i].offset_us);
    for (std::size_t axis = 0; axis < (samples.has_force3 ? 3U : 1U); ++axis) {
      append_little_endian(payload, samples.forces[i].counts[axis]);
    }
  }
  append_open_frame(payload, out);
}

void append_open_request(std::vector<std::uint8_t>& out) {
  const std::array<std::uint8_t, 2> payload{kOpenVersion, kOpenRequestType};
  append_open_frame(payload, out);
}

void append_open_description(std::string_view description, std::vector<std::uint8_t>& out) {
  if (description.size() > kOpenMaxDescription_bytes) {
    throw Error(fmt::format("open protocol: a description has at most {} bytes, not {}", kOpenMaxDescription_bytes,
                            description.size()));
  }
  std::vector<std::uint8_t> payload{kOpenVersion, kOpenDescriptionType};
  payload.insert(payload.end(), description.begin(), description.end());
  append_open_frame(payload, out);
}

}  // namespace asperity
