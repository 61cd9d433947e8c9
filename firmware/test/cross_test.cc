// The firmware's frames against the host's decoder, which is written from the same document (docs/adr/0008).

#include <gmock/gmock.h>
#include <algorithm>
#include <cmath>
#include <memory>

#include "asperity/link/open_protocol.h"
#include "asperity/link/probe_decoder.h"
#include "asperity_firmware/probe.h"
#include "fake_board.h"
#include "reference_decoder.h"

namespace asperity {
namespace {

using Bytes = std::vector<std::uint8_t>;

asp_description test_description(bool gyro, bool force3) {
  return {"cross \"probe\" ½", "1.0.0", 4000, -32768, 32767, 208.848, gyro, 939.65, force3 ? 3 : 1, 1000, 1.2e-06};
}

std::unique_ptr<asp_probe> begin(FakeBoard& board, bool gyro, bool force3) {
  auto probe = std::make_unique<asp_probe>();
  const asp_description description = test_description(gyro, force3);
  EXPECT_TRUE(asp_probe_init(probe.get(), board.board(), &description, nullptr));
  return probe;
}

Bytes sent_by_firmware(FakeBoard& board, bool gyro, bool force3, std::uint64_t us, std::uint64_t step_us) {
  const auto probe = begin(board, gyro, force3);
  for (std::uint64_t done = 0; done < us; done += step_us) {
    board.advance(step_us);
    asp_probe_step(probe.get());
  }
  return board.received();
}

std::vector<Bytes> blocks_of(const Bytes& bytes) {
  std::vector<Bytes> out;
  Bytes block;
  for (const std::uint8_t byte : bytes) {
    if (byte != 0) {
      block.push_back(byte);
    } else if (!block.empty()) {
      out.push_back(std::move(block));
      block.clear();
    }
  }
  return out;
}

struct Case {
  bool gyro;
  bool force3;
  double imu_rate_Hz;
  double force_rate_Hz;
};

std::vector<Case> all_cases() {
  std::vector<Case> out;
  for (const bool gyro : {false, true}) {
    for (const bool force3 : {false, true}) {
      for (const double imu_rate_Hz : {200.0, 1000.0, 4000.0}) {
        for (const double force_rate_Hz : {0.0, 80.0, 2000.0})
          out.push_back({gyro, force3, imu_rate_Hz, force_rate_Hz});
      }
    }
  }
  return out;
}

// Each frame of the firmware, read by the host's parser and written by the host's writer, is the same bytes again.
void expect_the_hosts_bytes(const Case& which) {
  const auto [gyro, force3, imu_rate_Hz, force_rate_Hz] = which;
  FakeBoard::Options options;
  options.imu_rate_Hz = imu_rate_Hz;
  options.force_rate_Hz = force_rate_Hz;
  options.link_bytes_per_s = 150e3;
  FakeBoard board(options);
  const Bytes sent = sent_by_firmware(board, gyro, force3, 3'000'000, 900);
  int frames = 0;
  for (const Bytes& block : blocks_of(sent)) {
    OpenPayload room;
    const auto payload = open_block_payload(block, room);
    ASSERT_TRUE(payload.has_value());
    Bytes again;
    OpenSamples samples;
    if ((*payload)[1] == kOpenSamplesType) {
      ASSERT_TRUE(parse_open_samples(*payload, samples));
      append_open_samples(samples, again);
    } else {
      append_open_frame(*payload, again);
    }
    again.pop_back();
    ASSERT_EQ(again, block);
    ++frames;
  }
  EXPECT_GT(frames, 3);
}

// All rows in order, on a time line that differs from the probe's by a constant: what the link's delay is at least.
void expect_samples_out_of_the_hosts_decoder(const Case& which) {
  const auto [gyro, force3, imu_rate_Hz, force_rate_Hz] = which;
  FakeBoard::Options options;
  options.imu_rate_Hz = imu_rate_Hz;
  options.force_rate_Hz = force_rate_Hz;
  options.link_bytes_per_s = 150e3;
  FakeBoard board(options);
  const auto probe = begin(board, gyro, force3);
  const auto decoder = make_probe_decoder(ProbeProtocol::kOpen);
  std::vector<ProbeSample> samples;
  std::size_t pushed = 0;
  for (int step = 0; step < 3000; ++step) {
    board.advance(1000);
    asp_probe_step(probe.get());
    const Bytes& received = board.received();
    const auto now_ns = static_cast<std::int64_t>(board.now_us()) * 1000;
    decoder->push(std::span(received).subspan(pushed), now_ns, samples);
    pushed = received.size();
  }
  const LinkStatistics& statistics = decoder->statistics();
  EXPECT_EQ(statistics.lost_frames, 0u);
  EXPECT_EQ(statistics.lost_samples, 0u);
  EXPECT_EQ(statistics.damaged_frames, 0u);
  EXPECT_EQ(statistics.foreign_frames, 0u);
  EXPECT_EQ(statistics.late_frames, 0u);
  EXPECT_EQ(statistics.restarts, 0u);
  EXPECT_EQ(statistics.overruns, 0u);
  ASSERT_TRUE(decoder->description().has_value());
  const ProbeDescription description = *decoder->description();
  EXPECT_EQ(description.model, "open");
  EXPECT_EQ(description.name, "cross \"probe\" ½");
  EXPECT_EQ(description.firmware, "1.0.0");
  EXPECT_EQ(description.rate_Hz, 4000.0);
  EXPECT_EQ(description.accel_counts_per_mps2, 208.848);
  EXPECT_EQ(description.has_gyro, gyro);
  EXPECT_EQ(description.force_axes, force3 ? 3 : 1);
  EXPECT_DOUBLE_EQ(description.force_newton_per_count, 1.2e-06);
  EXPECT_EQ(samples.size(), statistics.samples);
  ASSERT_GE(static_cast<double>(samples.size()), imu_rate_Hz * 2.9);
  double least_ms = 1e9;
  double most_ms = -1e9;
  for (std::size_t n = 0; n < samples.size(); ++n) {
    const reference::Row row = fake_row(n);
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_EQ(samples[n].accel_counts[axis], row.accel[static_cast<std::size_t>(axis)]) << n;
      if (gyro) {
        ASSERT_EQ(samples[n].gyro_counts[axis], row.gyro[static_cast<std::size_t>(axis)]) << n;
      } else {
        ASSERT_TRUE(std::isnan(samples[n].gyro_counts[axis])) << n;
      }
    }
    if (n < samples.size() / 2) continue;
    const double shift_ms = (static_cast<double>(samples[n].t_ns) - board.row_time_ns(n)) * 1e-6;
    least_ms = std::min(least_ms, shift_ms);
    most_ms = std::max(most_ms, shift_ms);
  }
  EXPECT_GT(least_ms, 0.0);
  EXPECT_LT(most_ms - least_ms, 0.3);  // the rate of the line is known to some 1e-4 after 1.5 s of bursts of 1 ms
}

TEST(FirmwareCross, FramesAreTheHostsByteForByte) {
  for (const Case& which : all_cases()) expect_the_hosts_bytes(which);
}

TEST(FirmwareCross, EverySampleComesOutOfTheHostsDecoder) {
  for (const Case& which : all_cases()) expect_samples_out_of_the_hosts_decoder(which);
}

TEST(FirmwareCross, TheHostCountsExactlyWhatTheFirmwareDropped) {
  FakeBoard::Options options;
  options.link_bytes_per_s = 30000.0;
  FakeBoard board(options);
  const auto probe = begin(board, true, false);
  const auto decoder = make_probe_decoder(ProbeProtocol::kOpen);
  std::vector<ProbeSample> samples;
  std::size_t pushed = 0;
  for (int step = 0; step < 8000; ++step) {
    if (step == 5000) board.set_link_speed(1e6);
    board.advance(1000);
    asp_probe_step(probe.get());
    decoder->push(std::span(board.received()).subspan(pushed), static_cast<std::int64_t>(board.now_us()) * 1000,
                  samples);
    pushed = board.received().size();
  }
  EXPECT_GT(decoder->statistics().lost_samples, 5000u);
  EXPECT_EQ(decoder->statistics().lost_samples, probe->statistics.rows_dropped);
  EXPECT_EQ(decoder->statistics().lost_frames, 0u);
  EXPECT_GT(decoder->statistics().overruns, 100u);
}

// The reset button: the sequence and the clock begin anew.
TEST(FirmwareCross, TheHostNoticesARestart) {
  const auto decoder = make_probe_decoder(ProbeProtocol::kOpen);
  std::vector<ProbeSample> samples;
  std::int64_t host_ns = 0;
  for (std::uint64_t run = 0; run < 3; ++run) {
    FakeBoard::Options options;
    options.start_us = 1000 + 37 * run;  // two starts at the same µs would be taken for one frame that came twice
    FakeBoard board(options);
    const auto probe = begin(board, true, false);
    std::size_t pushed = 0;
    for (int step = 0; step < 2000; ++step) {
      board.advance(1000);
      host_ns += 1'000'000;
      asp_probe_step(probe.get());
      decoder->push(std::span(board.received()).subspan(pushed), host_ns, samples);
      pushed = board.received().size();
    }
    const Bytes boot_text = {'e', 't', 's', ' ', 'J', 'u', 'n', '\r', '\n', 0xFF, 0x80};
    decoder->push(boot_text, host_ns, samples);
  }
  EXPECT_EQ(decoder->statistics().restarts, 2u);
  EXPECT_EQ(decoder->statistics().lost_samples, 0u);
  EXPECT_EQ(decoder->statistics().late_frames, 0u);
  EXPECT_GT(samples.size(), 23'800u);
}

TEST(FirmwareCross, HearsTheHostsRequest) {
  Bytes request;
  append_open_request(request);
  asp_request_reader reader{};
  int heard = 0;
  for (const std::uint8_t byte : request) heard += asp_request_put(&reader, byte) ? 1 : 0;
  EXPECT_EQ(heard, 1);
}

}  // namespace
}  // namespace asperity
