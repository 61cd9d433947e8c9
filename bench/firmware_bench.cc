// What a row costs the firmware's core from the sensor's queue to the link, and what its CRC and COBS alone do.

#include <benchmark/benchmark.h>
#include <cstdint>
#include <memory>
#include <vector>

#include "asperity_firmware/probe.h"

namespace {

// Sensors at 4 kHz and 1 kHz that cost nothing, and a link that takes everything.
struct EndlessBoard {
  std::uint64_t now_us = 0;
  std::uint64_t rows = 0;
  std::uint64_t forces = 0;
  std::uint64_t bytes = 0;
};

std::uint64_t clock_us(void* context) { return static_cast<EndlessBoard*>(context)->now_us; }

std::size_t read_imu(void* context, asp_imu_row* rows, std::size_t capacity) {
  auto& board = *static_cast<EndlessBoard*>(context);
  std::size_t count = 0;
  for (; count < capacity && board.rows * 250 <= board.now_us; ++count, ++board.rows) {
    rows[count] = {};
    rows[count].time_ns = board.rows * 250'000;
    rows[count].accel[0] = static_cast<std::int16_t>(board.rows * 31);
    rows[count].gyro[2] = static_cast<std::int16_t>(board.rows * 57);
  }
  return count;
}

bool read_force(void* context, asp_force_sample* sample) {
  auto& board = *static_cast<EndlessBoard*>(context);
  if (board.forces * 1000 > board.now_us) return false;
  *sample = {};
  sample->time_us = board.forces++ * 1000;
  return true;
}

std::size_t write(void* context, const std::uint8_t*, std::size_t count) {
  static_cast<EndlessBoard*>(context)->bytes += count;
  return count;
}

void probe_step(benchmark::State& state) {
  EndlessBoard endless;
  const asp_board board = {&endless, clock_us, read_imu, read_force, write, nullptr, nullptr};
  const asp_description description = {"bench", "1.0.0", 4000, -32768, 32767, 208.8, true, 939.6, 1, 1000, 1e-6};
  const auto probe = std::make_unique<asp_probe>();
  asp_probe_init(probe.get(), &board, &description, nullptr);
  for (auto _ : state) {
    endless.now_us += 1000;
    asp_probe_step(probe.get());
  }
  state.counters["per_row"] =
      benchmark::Counter(static_cast<double>(endless.rows), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["bytes_per_row"] = static_cast<double>(endless.bytes) / static_cast<double>(endless.rows);
}
BENCHMARK(probe_step);

void frame_bytes(benchmark::State& state) {
  std::vector<std::uint8_t> payload(static_cast<std::size_t>(state.range(0)));
  for (std::size_t i = 0; i < payload.size(); ++i) payload[i] = static_cast<std::uint8_t>(i * 37);
  std::vector<std::uint8_t> line(ASP_FRAME_BYTES(payload.size()));
  for (auto _ : state) {
    asp_frame_writer writer;
    asp_frame_begin(&writer, line.data(), line.size());
    asp_frame_put_bytes(&writer, payload.data(), payload.size());
    benchmark::DoNotOptimize(asp_frame_end(&writer));
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations()) * state.range(0));
}
BENCHMARK(frame_bytes)->Arg(228)->Arg(1052);

}  // namespace
