#include "numbered_stream.h"

#include <algorithm>
#include <optional>

#include "asperity/base/random.h"
#include "asperity/link/open_protocol.h"

namespace asperity::testkit {

namespace {

std::int16_t mixed(std::uint32_t number, std::uint32_t which) {
  std::uint32_t x = number * 2654435761U + which * 40503U;
  x ^= x >> 15;
  return static_cast<std::int16_t>(x * 2246822519U >> 16);
}

OpenRow row_of(std::uint32_t number) {
  OpenRow row;
  row.accel = {static_cast<std::int16_t>(number & 0xFFFFU), static_cast<std::int16_t>(number >> 16), mixed(number, 0)};
  row.gyro = {mixed(number, 1), mixed(number, 2), 0};
  return row;
}

std::optional<std::uint32_t> number_of(const ProbeSample& sample) {
  const auto low = static_cast<std::uint16_t>(static_cast<std::int16_t>(sample.accel_counts[0]));
  const auto high = static_cast<std::uint16_t>(static_cast<std::int16_t>(sample.accel_counts[1]));
  const std::uint32_t number = std::uint32_t{high} << 16 | low;
  const OpenRow row = row_of(number);
  for (int axis = 0; axis < 3; ++axis) {
    if (sample.accel_counts[axis] != row.accel[static_cast<std::size_t>(axis)]) return std::nullopt;
    if (sample.gyro_counts[axis] != row.gyro[static_cast<std::size_t>(axis)]) return std::nullopt;
  }
  return number;
}

}  // namespace

NumberedStream numbered_stream(std::uint32_t frames, std::uint64_t seed) {
  Random random(seed);
  NumberedStream sent;
  std::uint32_t row = 0;
  OpenSamples samples;
  samples.has_gyro = true;
  samples.imu_period_ns = 250'000;
  for (std::uint32_t i = 0; i < frames; ++i) {
    samples.start = i == 0;
    samples.sequence = i;
    samples.imu_index = row;
    samples.time_us = 1'000'000 + std::uint64_t{row} * 250;
    samples.row_count = 1 + (random.bits() >> 61);
    for (std::size_t k = 0; k < samples.row_count; ++k) samples.rows[k] = row_of(row + static_cast<std::uint32_t>(k));
    samples.force_count = random.chance(0.5) ? 1 : 0;
    samples.forces[0] = {250, {static_cast<std::int32_t>(row), 0, 0}};
    append_open_samples(samples, sent.bytes);
    sent.first_row.push_back(row);
    row += static_cast<std::uint32_t>(samples.row_count);
  }
  sent.first_row.push_back(row);
  return sent;
}

StreamTruth compare_with_sent(const NumberedStream& sent, std::span<const ProbeSample> received) {
  StreamTruth truth;
  std::optional<std::uint32_t> first;
  std::optional<std::uint32_t> before;
  std::uint64_t rows = 0;
  for (const ProbeSample& sample : received) {
    const auto number = number_of(sample);
    if (!number || *number >= sent.first_row.back() || (before && *number <= *before)) {
      ++truth.false_rows;
      continue;
    }
    ++rows;
    if (std::binary_search(sent.first_row.begin(), sent.first_row.end(), *number)) ++truth.frames;
    if (!first) first = number;
    before = number;
  }
  if (!first) return truth;
  const auto frame_of = [&](std::uint32_t row) {
    return static_cast<std::uint64_t>(std::upper_bound(sent.first_row.begin(), sent.first_row.end(), row) -
                                      sent.first_row.begin());
  };
  truth.missing_rows = *before - *first + 1 - rows;
  truth.missing_frames = frame_of(*before) - frame_of(*first) + 1 - truth.frames;
  return truth;
}

}  // namespace asperity::testkit
