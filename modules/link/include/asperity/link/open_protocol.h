#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/link/probe_description.h"
#include "asperity/link/probe_faults.h"

namespace asperity {

// The open probe's frames as plain data (docs/probe-protocol.md), both ways. Nothing here keeps state.

inline constexpr std::uint8_t kOpenVersion = 1;
inline constexpr std::uint8_t kOpenSamplesType = 0x01;
inline constexpr std::uint8_t kOpenDescriptionType = 0x02;
inline constexpr std::uint8_t kOpenFaultsType = 0x03;
inline constexpr std::uint8_t kOpenRequestType = 0x81;

inline constexpr std::size_t kOpenMaxPayload_bytes = 1200;
inline constexpr std::size_t kOpenMaxBlock_bytes = 1209;  // of COBS, the CRC included, the delimiter not
inline constexpr std::size_t kOpenMaxRows = 64;
inline constexpr std::size_t kOpenMaxForces = 16;
inline constexpr std::size_t kOpenMaxDescription_bytes = 1024;
inline constexpr std::size_t kOpenMaxName_bytes = 64;

struct OpenRow {
  std::array<std::int16_t, 3> accel{};
  std::array<std::int16_t, 3> gyro{};
};

struct OpenForce {
  std::int32_t offset_us = 0;            // the middle of its conversion, after the frame's time
  std::array<std::int32_t, 3> counts{};  // one axis: the first alone
};

// A frame of samples; times are of the probe's clock.
struct OpenSamples {
  bool start = false;
  bool overrun = false;
  bool has_gyro = false;
  bool has_force3 = false;
  std::uint32_t sequence = 0;
  std::uint32_t imu_index = 0;
  std::uint64_t time_us = 0;
  std::uint32_t imu_period_ns = 0;
  std::size_t row_count = 0;
  std::size_t force_count = 0;
  std::array<OpenRow, kOpenMaxRows> rows{};
  std::array<OpenForce, kOpenMaxForces> forces{};
};

using OpenPayload = std::array<std::uint8_t, kOpenMaxPayload_bytes + 4>;  // with its CRC behind

// The payload of a block between two delimiters, in the front of `room`; nullopt unless the block is COBS of 2 to 1200
// bytes and their CRC-32.
std::optional<std::span<const std::uint8_t>> open_block_payload(std::span<const std::uint8_t> block,
                                                                OpenPayload& room) noexcept;

// Reads a payload of version 1 and type 01h; false, with `out` unspecified, if it is none or its length is not
// what its counts and flags say, or a count is above its limit, or two rows or more have no period.
bool parse_open_samples(std::span<const std::uint8_t> payload, OpenSamples& out) noexcept;

// Reads a payload of version 1 and type 03h; nullopt if it is none or is shorter than the document's 36 bytes. What
// follows these is ignored.
std::optional<ProbeFaults> parse_open_faults(std::span<const std::uint8_t> payload) noexcept;

// Appends a whole frame: COBS of `payload` and its CRC, and the delimiter. Throws Error if the payload has not 2 to
// 1200 bytes.
void append_open_frame(std::span<const std::uint8_t> payload, std::vector<std::uint8_t>& out);

// Appends the frame of `samples`. Throws Error for a count above its limit, or two rows or more without a period.
void append_open_samples(const OpenSamples& samples, std::vector<std::uint8_t>& out);

// Appends the host's request for a description.
void append_open_request(std::vector<std::uint8_t>& out);

// Appends a frame with `json` as the description. Throws Error if it is longer than 1024 bytes.
void append_open_description(std::string_view json, std::vector<std::uint8_t>& out);

// The description that `json` (what follows the two first bytes of a payload of type 02h) gives; nullopt if it is no
// sound one.
std::optional<ProbeDescription> parse_open_description(std::string_view json);

// `description` as JSON in the order of the document. Throws Error for a text or figure that the protocol does not
// allow.
std::string format_open_description(const ProbeDescription& description);

}  // namespace asperity
