// What a link that flips, drops and inserts bytes does to both probe protocols (docs/probe-links.md).
//
//   link_corruption [FRAMES [SEEDS]]
//
// open: frames whose rows carry their number; false rows, and the losses that the decoder counts against the true ones.
// what: the share of frames damaged in silence, and the losses estimated from time; then scans over such a line,
// processed. Speeds are of the decoder alone, on one core. Ends with 1 if a false row was accepted or a loss of `open`
// was not counted.

#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/link/probe_decoder.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/simulation/simulate_recording.h"
#include "asperity/testkit/corrupt_bytes.h"
#include "asperity/testkit/what_line.h"
#include "numbered_stream.h"
#include "what_recording.h"

namespace {

using namespace asperity;

constexpr testkit::Corruption kCorruption{0.003, 0.003, 0.003};
constexpr std::size_t kPiece_bytes = 256;

// The processor's time of this thread.
double thread_s() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Decoded {
  std::vector<ProbeSample> samples;
  LinkStatistics statistics;
  double MB_per_s = 0.0;
};

Decoded decode_open(std::span<const std::uint8_t> bytes) {
  const auto decoder = make_probe_decoder(ProbeProtocol::kOpen);
  Decoded out;
  out.samples.reserve(bytes.size() / 8);
  std::int64_t arrival_ns = 0;
  const double begin_s = thread_s();
  for (std::size_t at = 0; at < bytes.size(); at += kPiece_bytes) {
    arrival_ns += 3'000'000;
    decoder->push(bytes.subspan(at, std::min(kPiece_bytes, bytes.size() - at)), arrival_ns, out.samples);
  }
  const double taken_s = thread_s() - begin_s;
  out.statistics = decoder->statistics();
  out.MB_per_s = 1e-6 * static_cast<double>(bytes.size()) / taken_s;
  return out;
}

bool run_open(std::uint32_t frames, std::uint64_t seed) {
  const testkit::NumberedStream sent = testkit::numbered_stream(frames, seed);
  std::vector<std::uint8_t> bytes;
  Random random(seed, 1);
  testkit::corrupt_bytes(sent.bytes, kCorruption, random, bytes);
  const Decoded clean = decode_open(sent.bytes);
  const Decoded damaged = decode_open(bytes);
  const testkit::StreamTruth truth = testkit::compare_with_sent(sent, damaged.samples);
  const LinkStatistics& counted = damaged.statistics;
  std::printf("open, seed %d: %u frames, %zu rows, %zu bytes\n", static_cast<int>(seed), frames,
              static_cast<std::size_t>(sent.first_row.back()), sent.bytes.size());
  std::printf("  accepted     %llu frames, %llu rows, %llu of these false\n",
              static_cast<unsigned long long>(counted.frames), static_cast<unsigned long long>(counted.samples),
              static_cast<unsigned long long>(truth.false_rows));
  std::printf("  lost frames  %llu, counted %llu\n", static_cast<unsigned long long>(truth.missing_frames),
              static_cast<unsigned long long>(counted.lost_frames));
  std::printf("  lost rows    %llu, counted %llu\n", static_cast<unsigned long long>(truth.missing_rows),
              static_cast<unsigned long long>(counted.lost_samples));
  std::printf("  decoder      %.0f MB/s, clean %.0f MB/s\n", damaged.MB_per_s, clean.MB_per_s);
  return truth.false_rows == 0 && truth.missing_frames == counted.lost_frames &&
         truth.missing_rows == counted.lost_samples && clean.statistics.frames == frames &&
         clean.statistics.lost_frames == 0;
}

// Data that carry the frame's number: 19 bits of it and 13 of a hash.
std::array<std::uint8_t, 4> numbered_data(std::uint32_t number) {
  const std::uint32_t word = (number & 0x7FFFFU) | (number * 2654435761U >> 19) << 19;
  return {static_cast<std::uint8_t>(word), static_cast<std::uint8_t>(word >> 8), static_cast<std::uint8_t>(word >> 16),
          static_cast<std::uint8_t>(word >> 24)};
}

void run_what(std::uint32_t frames, std::uint64_t seed) {
  constexpr double kRate_Hz = 447.0;
  std::vector<testkit::WhatSent> sent(frames);
  for (std::uint32_t i = 0; i < frames; ++i) sent[i] = {std::llround(1e9 * i / kRate_Hz), numbered_data(i)};
  testkit::WhatLineConfig line;
  line.corruption = kCorruption;
  Random random(seed, 2);
  const auto reads = testkit::what_line(sent, line, random);
  const auto decoder = make_probe_decoder(ProbeProtocol::kWhat);
  std::vector<ProbeSample> samples;
  samples.reserve(frames);
  const double begin_s = thread_s();
  for (const auto& read : reads) decoder->push(read.bytes, read.arrival_ns, samples);
  const double taken_s = thread_s() - begin_s;

  // The frame that a sample is, looked for near the time that it was given.
  const auto is = [&](const ProbeSample& sample, std::int64_t n) {
    if (n < 0 || n >= static_cast<std::int64_t>(frames)) return false;
    const auto data = numbered_data(static_cast<std::uint32_t>(n));
    return sample.accel_counts[0] == data[0] && sample.accel_counts[1] == data[1] &&
           sample.accel_counts[2] == data[2] && sample.force_counts == data[3];
  };
  std::uint64_t silent = 0;
  std::uint64_t misplaced = 0;
  for (const ProbeSample& sample : samples) {
    const std::int64_t guess = std::llround(1e-9 * static_cast<double>(sample.t_ns) * kRate_Hz);
    std::int64_t off = 0;
    while (off < 100 && !is(sample, guess + off) && !is(sample, guess - off)) ++off;
    if (off == 100) ++silent;
    if (off > 0 && off < 100) ++misplaced;
  }
  const LinkStatistics& counted = decoder->statistics();
  const auto percent = [&](std::uint64_t count) {
    return 100.0 * static_cast<double>(count) / static_cast<double>(samples.size());
  };
  std::printf("what, seed %d: %u frames\n", static_cast<int>(seed), frames);
  std::printf("  given             %zu frames, %.3f %% of these damaged and not detected, %llu resyncs\n",
              samples.size(), percent(silent), static_cast<unsigned long long>(counted.resyncs));
  std::printf("  lost              %llu, estimated from time %llu\n",
              static_cast<unsigned long long>(frames - samples.size()),
              static_cast<unsigned long long>(counted.lost_frames));
  std::printf("  at a wrong time   %.3f %% (nearer to that of another frame)\n", percent(misplaced));
  std::printf("  decoder           %.0f MB/s in reads of a millisecond\n",
              1e-6 * static_cast<double>(counted.bytes) / taken_s);
}

// As the trajectory tells it.
std::size_t rejected_samples(const ProcessResult& result) {
  std::size_t count = 0;
  for (const Problem& problem : result.problems) {
    if (problem.kind == "spike" || problem.kind == "probe_spikes") count += problem.count;
  }
  return count;
}

void run_pipeline(const char* surface, int seeds) {
  for (int seed = 1; seed <= seeds; ++seed) {
    const Recording sent = simulate_recording(faultless_what_config(surface, static_cast<std::uint64_t>(seed)));
    const ProcessConfig config;
    for (const bool damaged : {false, true}) {
      testkit::WhatLineConfig line;
      if (damaged) line.corruption = kCorruption;
      const LineResult received = through_what_line(sent, line, static_cast<std::uint64_t>(seed));
      const ProcessResult result = process_recording(received.recording, config);
      std::printf("| %s | %d | %s | %zu | %zu | %.3f ± %.3f | %.3f | %.3f | %.1f |\n", surface, seed,
                  damaged ? "damaged" : "clean", received.recording.probe.size(), rejected_samples(result),
                  1e3 * result.periodicity.pitch_m, 1e3 * result.periodicity.pitch_stderr_m,
                  1e3 * result.periodicity.depth_m, result.accuracy->profile->correlation,
                  result.accuracy->profile->rms_um);
    }
  }
}

int whole_number(const char* text) {
  const auto value = parse_int64(text);
  if (!value || *value < 1 || *value > 100'000'000) throw Error(std::string("'") + text + "' is not a count");
  return static_cast<int>(*value);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const auto frames = static_cast<std::uint32_t>(argc > 1 ? whole_number(argv[1]) : 1'000'000);
    const int seeds = argc > 2 ? whole_number(argv[2]) : 3;
    const bool exact = run_open(frames, 1);
    run_what(frames, 1);
    std::printf("\n| surface | seed | line | samples | rejected | pitch, mm | depth, mm | correlation | RMS, µm |\n");
    std::printf("|---|---|---|---|---|---|---|---|---|\n");
    for (const char* surface : {"protoboard", "sine"}) run_pipeline(surface, seeds);
    return exact ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "link_corruption: %s\n", error.what());
    return 1;
  }
}
