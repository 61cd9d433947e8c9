#include <gmock/gmock.h>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "asperity/link/probe_decoder.h"
#include "asperity/testkit/what_line.h"

namespace asperity {
namespace {

struct Result {
  std::vector<ProbeSample> samples;
  LinkStatistics statistics;
};

// Frames at an even pace that carry their number (accelerometer bytes, below 200 each).
std::vector<testkit::WhatSent> even_frames(int count, double rate_Hz) {
  std::vector<testkit::WhatSent> out;
  for (int i = 0; i < count; ++i) {
    const auto digit = [i](int place) { return static_cast<std::uint8_t>(i / place % 200); };
    out.push_back({7'000'000'000 + std::llround(1e9 * i / rate_Hz), {digit(1), digit(200), digit(40'000), 48}});
  }
  return out;
}

int number_of(const ProbeSample& sample) {
  return static_cast<int>(sample.accel_counts[0] + 200.0 * sample.accel_counts[1] + 40'000.0 * sample.accel_counts[2]);
}

Result receive(const std::vector<testkit::ReadBytes>& reads) {
  const auto decoder = make_probe_decoder(ProbeProtocol::kWhat);
  Result result;
  for (const auto& read : reads) decoder->push(read.bytes, read.arrival_ns, result.samples);
  result.statistics = decoder->statistics();
  for (std::size_t i = 1; i < result.samples.size(); ++i) EXPECT_LT(result.samples[i - 1].t_ns, result.samples[i].t_ns);
  return result;
}

// Errors of the sample times in µs, ascending, of frames from `first` on that were not damaged.
std::vector<double> time_errors_us(const Result& result, const std::vector<testkit::WhatSent>& sent, int first) {
  std::vector<double> out;
  for (const ProbeSample& sample : result.samples) {
    const int number = number_of(sample);
    if (number < first || number >= static_cast<int>(sent.size()) || sample.force_counts != 48.0) continue;
    out.push_back(1e-3 * std::abs(static_cast<double>(sample.t_ns - sent[static_cast<std::size_t>(number)].t_ns)));
  }
  std::sort(out.begin(), out.end());
  std::printf("error of the times, µs: median %.0f, 90 %% %.0f, 99 %% %.0f, worst %.0f\n", out[out.size() / 2],
              out[out.size() * 9 / 10], out[out.size() * 99 / 100], out.back());
  return out;
}

TEST(WhatDecoder, CleanLine) {
  for (const double rate_Hz : {400.0, 447.3, 500.0}) {
    Random random(1);
    const auto sent = even_frames(10'000, rate_Hz);
    const Result result = receive(testkit::what_line(sent, {}, random));
    EXPECT_EQ(result.statistics.frames, 9'999u);
    EXPECT_EQ(result.statistics.lost_frames, 0u);
    EXPECT_EQ(result.statistics.damaged_frames, 0u);
    EXPECT_TRUE(result.statistics.losses_are_estimated);
    ASSERT_GE(result.samples.size(), 9'990u);
    EXPECT_EQ(number_of(result.samples[5000]), 5000);
    EXPECT_EQ(result.samples[5000].force_counts, 48.0);
    // The host looks once in a millisecond; once the pace is known well, times are far better than that.
    EXPECT_LT(time_errors_us(result, sent, 128).back(), 2500.0);
    EXPECT_LT(time_errors_us(result, sent, 600).back(), 200.0);
  }
}

TEST(WhatDecoder, FirstSamplesHaveUsableTimes) {
  Random random(2);
  const auto sent = even_frames(300, 480.0);
  const Result result = receive(testkit::what_line(sent, {}, random));
  EXPECT_LT(time_errors_us(result, sent, 0).back(), 10e3);
}

// A host that is busy finds hundreds of frames waiting at each read.
TEST(WhatDecoder, AHostThatLooksSeldomLosesNothing) {
  for (const std::size_t at_once : {std::size_t{150}, std::size_t{640}, std::size_t{700}, std::size_t{5000}}) {
    Random random(5);
    const auto sent = even_frames(3'000, 471.0);
    std::vector<testkit::ReadBytes> late;
    for (const testkit::ReadBytes& read : testkit::what_line(sent, {}, random)) {
      if (late.empty() || late.back().bytes.size() >= at_once) late.push_back({});
      late.back().arrival_ns = read.arrival_ns;
      late.back().bytes.insert(late.back().bytes.end(), read.bytes.begin(), read.bytes.end());
    }
    const Result result = receive(late);
    EXPECT_EQ(result.statistics.frames, 2'999u) << at_once;
    EXPECT_LE(result.statistics.lost_frames, 2u) << at_once;
    // The pace is known from a look to the next: within a look of the truth, 5000 bytes being 2.1 s.
    const double look_us = 1e6 * static_cast<double>(at_once) / 5.0 / 471.0;
    EXPECT_LT(time_errors_us(result, sent, 0).back(), look_us + 10e3) << at_once;
  }
}

// A host that stalls for up to 80 ms some three times a second.
TEST(WhatDecoder, LateReadsAreNoLosses) {
  Random random(3);
  testkit::WhatLineConfig line;
  line.stall_chance = 0.003;
  line.stall_s = 0.08;
  const auto sent = even_frames(20'000, 471.0);
  const Result result = receive(testkit::what_line(sent, line, random));
  EXPECT_EQ(result.statistics.frames, 19'999u);
  EXPECT_LE(result.statistics.lost_frames, 2u);
  const auto errors_us = time_errors_us(result, sent, 512);
  EXPECT_LT(errors_us[errors_us.size() * 99 / 100], 500.0);
}

// A radio that loses whole frames, one to forty at a time.
TEST(WhatDecoder, FramesLostWithoutABytesTraceAreFoundInTime) {
  Random random(4);
  const auto sent = even_frames(20'000, 455.0);
  std::vector<testkit::WhatSent> through;
  std::uint64_t lost = 0;
  for (std::size_t i = 0; i < sent.size(); ++i) {
    if (i > 600 && i < 19'900 && random.chance(0.004)) {
      const auto gap = static_cast<std::size_t>(random.uniform(1.0, 41.0));
      lost += std::min(gap, sent.size() - i);
      i += gap - 1;
      continue;
    }
    through.push_back(sent[i]);
  }
  const Result result = receive(testkit::what_line(through, {}, random));
  std::printf("lost %d, estimated %d\n", static_cast<int>(lost), static_cast<int>(result.statistics.lost_frames));
  EXPECT_NEAR(static_cast<double>(result.statistics.lost_frames), static_cast<double>(lost), 2.0);
  const auto errors_us = time_errors_us(result, sent, 600);
  EXPECT_LT(errors_us[errors_us.size() * 99 / 100], 600.0);
}

TEST(WhatDecoder, DamagedBytes) {
  Random random(5);
  testkit::WhatLineConfig line;
  line.corruption = {0.003, 0.003, 0.003};
  const auto sent = even_frames(20'000, 455.0);
  const Result result = receive(testkit::what_line(sent, line, random));
  const auto missing = static_cast<double>(20'000 - result.statistics.frames);
  std::printf("missing %.0f, estimated %d\n", missing, static_cast<int>(result.statistics.lost_frames));
  EXPECT_NEAR(static_cast<double>(result.statistics.lost_frames), missing, 0.02 * missing + 3.0);
  EXPECT_GT(result.statistics.resyncs, 100u);
  const auto errors_us = time_errors_us(result, sent, 600);
  EXPECT_LT(errors_us[errors_us.size() * 98 / 100], 600.0);
}

// The pace of a probe without a crystal: 2 % in two minutes.
TEST(WhatDecoder, DriftingPace) {
  Random random(8);
  auto sent = even_frames(60'000, 450.0);
  auto t_ns = static_cast<double>(sent.front().t_ns);
  for (std::size_t i = 1; i < sent.size(); ++i) {
    t_ns += 1e9 / 450.0 * (1.0 + 0.02 * static_cast<double>(i) / 60'000.0);
    sent[i].t_ns = std::llround(t_ns);
  }
  const Result result = receive(testkit::what_line(sent, {}, random));
  EXPECT_EQ(result.statistics.lost_frames, 0u);
  // The line over 4 s misses a bend of 1.5e-4 /s by 0.5 · 1.5e-4 · 2² s = 0.3 ms.
  EXPECT_LT(time_errors_us(result, sent, 600).back(), 600.0);
}

// The probe is switched off for a while and comes back at another pace.
TEST(WhatDecoder, ComesBackAfterASilence) {
  Random random(6);
  auto sent = even_frames(6'000, 400.0);
  for (std::size_t i = 3'000; i < sent.size(); ++i) {
    sent[i].t_ns = sent[2'999].t_ns + 5'000'000'000 + static_cast<std::int64_t>(i - 3'000) * 2'000'000;
  }
  const Result result = receive(testkit::what_line(sent, {}, random));
  EXPECT_EQ(result.statistics.frames, 5'999u);
  EXPECT_NEAR(static_cast<double>(result.statistics.lost_frames), 2'000.0, 5.0);
  EXPECT_LT(time_errors_us(result, sent, 3'300).back(), 500.0);
}

TEST(WhatDecoder, AnyBytesAtAnyTimesAreSurvived) {
  Random random(7);
  const auto decoder = make_probe_decoder(ProbeProtocol::kWhat);
  std::vector<ProbeSample> samples;
  std::int64_t arrival_ns = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::vector<std::uint8_t> bytes(random.bits() >> 58);
    for (auto& byte : bytes) byte = random.chance(0.6) ? 0xFF : static_cast<std::uint8_t>(random.bits() >> 56);
    arrival_ns += static_cast<std::int64_t>(random.bits() >> (random.chance(0.01) ? 30 : 44));
    decoder->push(bytes, arrival_ns, samples);
  }
  for (std::size_t i = 1; i < samples.size(); ++i) ASSERT_LT(samples[i - 1].t_ns, samples[i].t_ns);
}

}  // namespace
}  // namespace asperity
