// What the open decoder makes of damaged streams. Rows carry their own number, so that a row that was not sent is
// known.
#include <gmock/gmock.h>
#include <algorithm>

#include "asperity/base/random.h"
#include "asperity/link/open_protocol.h"
#include "asperity/testkit/corrupt_bytes.h"
#include "numbered_stream.h"

namespace asperity {
namespace {

using Bytes = std::vector<std::uint8_t>;

struct Received {
  std::vector<ProbeSample> samples;
  LinkStatistics statistics;
};

Received receive(std::span<const std::uint8_t> bytes) {
  const auto decoder = make_probe_decoder(ProbeProtocol::kOpen);
  Received received;
  std::int64_t arrival_ns = 0;
  for (std::size_t at = 0; at < bytes.size(); at += 512) {
    arrival_ns += 4'000'000;
    decoder->push(bytes.subspan(at, std::min<std::size_t>(512, bytes.size() - at)), arrival_ns, received.samples);
  }
  received.statistics = decoder->statistics();
  return received;
}

void expect_exact(const testkit::NumberedStream& sent, const Received& received) {
  const LinkStatistics& statistics = received.statistics;
  const testkit::StreamTruth truth = testkit::compare_with_sent(sent, received.samples);
  EXPECT_EQ(truth.false_rows, 0u);
  EXPECT_EQ(statistics.samples, received.samples.size());
  EXPECT_EQ(statistics.lost_samples, truth.missing_rows);
  EXPECT_EQ(statistics.frames, truth.frames);
  EXPECT_EQ(statistics.lost_frames, truth.missing_frames);
  EXPECT_EQ(statistics.restarts, 0u);
  for (std::size_t i = 1; i < received.samples.size(); ++i) {
    ASSERT_LT(received.samples[i - 1].t_ns, received.samples[i].t_ns);
  }
}

TEST(OpenDamage, WholeStreamComesThroughWhole) {
  const auto sent = testkit::numbered_stream(3000, 1);
  const Received received = receive(sent.bytes);
  EXPECT_EQ(received.statistics.frames, 3000u);
  EXPECT_EQ(received.statistics.lost_frames, 0u);
  EXPECT_EQ(received.statistics.damaged_frames, 0u);
  EXPECT_EQ(received.samples.size(), sent.first_row.back());
  expect_exact(sent, received);
}

// Each byte of a frame between two others: damaged in each of its bits, dropped, doubled, and one put before it.
TEST(OpenDamage, EachByteOfAFrame) {
  const auto sent = testkit::numbered_stream(3, 2);
  const auto frame_begin =
      static_cast<std::size_t>(std::find(sent.bytes.begin(), sent.bytes.end(), 0) - sent.bytes.begin() + 1);
  const auto frame_end = static_cast<std::size_t>(
      std::find(sent.bytes.begin() + static_cast<std::ptrdiff_t>(frame_begin), sent.bytes.end(), 0) -
      sent.bytes.begin());
  for (std::size_t at = frame_begin; at <= frame_end; ++at) {
    const auto place = static_cast<std::ptrdiff_t>(at);
    for (int bit = 0; bit < 8; ++bit) {
      auto damaged = sent;
      damaged.bytes[at] ^= static_cast<std::uint8_t>(1U << bit);
      const Received received = receive(damaged.bytes);
      // Of a damaged delimiter the next frame falls too.
      EXPECT_EQ(received.statistics.frames, at == frame_end ? 1u : 2u);
      EXPECT_GE(received.statistics.damaged_frames, 1u);
      expect_exact(sent, received);
    }
    auto dropped = sent;
    dropped.bytes.erase(dropped.bytes.begin() + place);
    expect_exact(sent, receive(dropped.bytes));
    EXPECT_EQ(receive(dropped.bytes).statistics.frames, at == frame_end ? 1u : 2u);
    for (int value = 0; value < 256; value += 15) {
      auto inserted = sent;
      inserted.bytes.insert(inserted.bytes.begin() + place, static_cast<std::uint8_t>(value));
      const Received received = receive(inserted.bytes);
      expect_exact(sent, received);
      // A zero byte before the first byte is an empty block.
      EXPECT_EQ(received.statistics.frames, value == 0 && (at == frame_begin || at == frame_end) ? 3u : 2u);
    }
  }
}

TEST(OpenDamage, NoFalseFrameAndLossesExact) {
  const auto sent = testkit::numbered_stream(20'000, 3);
  Random random(4);
  Bytes bytes;
  testkit::corrupt_bytes(sent.bytes, {0.003, 0.003, 0.003}, random, bytes);
  const Received received = receive(bytes);
  expect_exact(sent, received);
  // Frames of 45 to 130 bytes, 0.9 % of them damaged: a third to two thirds come through.
  EXPECT_GT(received.statistics.frames, 6'000u);
  EXPECT_LT(received.statistics.frames, 14'000u);
}

TEST(OpenDamage, WholeFramesLostLateAndTwice) {
  const auto sent = testkit::numbered_stream(5000, 5);
  Random random(6);
  std::vector<std::span<const std::uint8_t>> frames;
  std::span<const std::uint8_t> rest = sent.bytes;
  while (!rest.empty()) {
    const auto size = static_cast<std::size_t>(std::find(rest.begin(), rest.end(), 0) - rest.begin()) + 1;
    frames.push_back(rest.first(size));
    rest = rest.subspan(size);
  }
  Bytes bytes;
  std::uint64_t late = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (random.chance(0.1) && i > 0) continue;
    bytes.insert(bytes.end(), frames[i].begin(), frames[i].end());
    if (!random.chance(0.1)) continue;
    const std::size_t old = i - std::min(i, static_cast<std::size_t>(random.uniform(0.0, 20.0)));
    bytes.insert(bytes.end(), frames[old].begin(), frames[old].end());
    ++late;
  }
  const Received received = receive(bytes);
  EXPECT_EQ(received.statistics.late_frames, late);
  EXPECT_EQ(received.statistics.damaged_frames, 0u);
  expect_exact(sent, received);
}

// The first frame after a restart is lost; the later ones look late until they have done so for half a second.
TEST(OpenDamage, RestartWhoseFirstFrameWasLost) {
  const auto decoder = make_probe_decoder(ProbeProtocol::kOpen);
  std::vector<ProbeSample> samples;
  OpenSamples frame;
  frame.row_count = 1;
  Bytes bytes;
  const auto push = [&](std::uint32_t sequence, std::uint64_t time_us, std::int64_t arrival_ns) {
    frame.sequence = frame.imu_index = sequence;
    frame.time_us = time_us;
    bytes.clear();
    append_open_samples(frame, bytes);
    decoder->push(bytes, arrival_ns, samples);
  };
  for (std::uint32_t i = 0; i < 100; ++i) push(900'000 + i, 5'000'000'000 + i * 10'000, i * 10'000'000);
  for (std::uint32_t i = 1; i < 200; ++i) push(i, i * 10'000, 2'000'000'000 + std::int64_t{i} * 10'000'000);
  EXPECT_EQ(decoder->statistics().restarts, 1u);
  EXPECT_EQ(decoder->statistics().late_frames, 50u);
  EXPECT_EQ(decoder->statistics().frames, 100u + 149u);
  EXPECT_EQ(decoder->statistics().lost_frames, 0u);
}

// Rows at 4 kHz, forces at 330 Hz in the next frame sent, each in the row nearest to the middle of its conversion among
// those not yet given out.
TEST(OpenForces, GoToTheNearestRow) {
  OpenSamples frame;
  frame.row_count = 4;
  frame.imu_period_ns = 250'000;
  frame.force_count = 3;
  frame.forces[0] = {-1000, {10, 0, 0}};  // before the first row
  frame.forces[1] = {300, {20, 0, 0}};    // row 1
  frame.forces[2] = {900, {30, 0, 0}};    // nearer to the next frame's first row
  Bytes bytes;
  append_open_samples(frame, bytes);
  frame.sequence = 1;
  frame.imu_index = 4;
  frame.time_us = 1000;
  frame.force_count = 2;
  frame.forces[0] = {20, {40, 0, 0}};       // shares the first row
  frame.forces[1] = {-30'000, {50, 0, 0}};  // of rows long past
  append_open_samples(frame, bytes);
  const auto decoder = make_probe_decoder(ProbeProtocol::kOpen);
  std::vector<ProbeSample> samples;
  decoder->push(bytes, 0, samples);
  ASSERT_EQ(samples.size(), 8u);
  std::vector<double> forces;
  for (const ProbeSample& sample : samples) forces.push_back(sample.force_counts);
  using testing::IsNan;
  EXPECT_THAT(forces, testing::ElementsAre(10.0, 20.0, IsNan(), IsNan(), 35.0, IsNan(), IsNan(), IsNan()));
  EXPECT_EQ(decoder->statistics().force_samples, 4u);
}

// What a frame does not have is no reading of zero.
TEST(OpenRows, SensorsThatAreAbsentAreNan) {
  OpenSamples frame;
  frame.row_count = 1;
  Bytes bytes;
  append_open_samples(frame, bytes);
  frame.sequence = frame.imu_index = 1;
  frame.time_us = 250;
  frame.has_gyro = true;
  frame.rows[0].gyro = {1, 2, 3};
  append_open_samples(frame, bytes);
  const auto decoder = make_probe_decoder(ProbeProtocol::kOpen);
  std::vector<ProbeSample> samples;
  decoder->push(bytes, 0, samples);
  ASSERT_EQ(samples.size(), 2u);
  EXPECT_TRUE(samples[0].gyro_counts.array().isNaN().all());
  EXPECT_EQ(samples[1].gyro_counts, Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_TRUE(samples[1].force3_counts.array().isNaN().all());
}

TEST(OpenForces, FramesOfOneRow) {
  const auto decoder = make_probe_decoder(ProbeProtocol::kOpen);
  std::vector<ProbeSample> samples;
  Bytes bytes;
  OpenSamples frame;
  frame.row_count = 1;
  for (std::uint32_t i = 0; i < 4; ++i) {
    frame.sequence = frame.imu_index = i;
    frame.time_us = 1000 * i;
    frame.force_count = i == 2 ? 2 : 0;
    frame.forces[0] = {400, {1, 0, 0}};
    frame.forces[1] = {600, {2, 0, 0}};
    append_open_samples(frame, bytes);
  }
  decoder->push(bytes, 0, samples);
  ASSERT_EQ(samples.size(), 4u);
  EXPECT_EQ(samples[2].force_counts, 1.0);
  EXPECT_EQ(samples[3].force_counts, 2.0);
}

}  // namespace
}  // namespace asperity
