// Simulated sensors, the drivers, the core, a serial line and the host's decoder, in one piece.

#include <gmock/gmock.h>
#include <algorithm>
#include <cmath>
#include <deque>
#include <memory>

#include "asperity/link/probe_decoder.h"
#include "asperity_firmware/icm42688.h"
#include "asperity_firmware/probe.h"
#include "fake_board.h"
#include "simulated_icm42688.h"

namespace asperity {
namespace {

class Chain {
 public:
  Chain() : sensor(252.1) {
    sensor.on_interrupt = [this](double now_us) { asp_edge_fire(&imu.edge, static_cast<std::uint64_t>(now_us) + 4); };
    EXPECT_EQ(asp_icm42688_start(&imu, sensor.spi()), ASP_ICM42688_OK);
    const asp_description description = {"chain", "1", 4000, -32768, 32767, 208.8, true, 939.6, 1, 0, 1e-6};
    EXPECT_TRUE(asp_probe_init(&*probe, &board_, &description, nullptr));
  }

  // A turn each millisecond; the line carries 92 bytes in it.
  void run_ms(int ms) {
    for (int i = 0; i < ms; ++i) {
      sensor.advance(1000.0);
      asp_probe_step(probe.get());
      const std::size_t count = std::min<std::size_t>(line_.size(), 92);
      const std::vector<std::uint8_t> bytes(line_.begin(), line_.begin() + static_cast<std::ptrdiff_t>(count));
      line_.erase(line_.begin(), line_.begin() + static_cast<std::ptrdiff_t>(count));
      decoder->push(bytes, static_cast<std::int64_t>(sensor.now_us() * 1e3), samples);
    }
  }

  SimulatedIcm42688 sensor;
  asp_icm42688 imu{};
  std::unique_ptr<asp_probe> probe = std::make_unique<asp_probe>();
  std::unique_ptr<ProbeDecoder> decoder = make_probe_decoder(ProbeProtocol::kOpen);
  std::vector<ProbeSample> samples;

 private:
  static Chain& of(void* context) { return *static_cast<Chain*>(context); }

  std::deque<std::uint8_t> line_;
  asp_board board_ = {this,
                      [](void* context) { return static_cast<std::uint64_t>(of(context).sensor.now_us()); },
                      [](void* context, asp_imu_row* rows, std::size_t capacity) {
                        return asp_icm42688_read(&of(context).imu, rows, capacity);
                      },
                      nullptr,
                      [](void* context, const std::uint8_t* bytes, std::size_t count) {
                        auto& line = of(context).line_;
                        const std::size_t taken = std::min(count, 4096 - std::min<std::size_t>(line.size(), 4096));
                        line.insert(line.end(), bytes, bytes + taken);
                        return taken;
                      },
                      nullptr,
                      nullptr};
};

bool is_row(const ProbeSample& sample, std::uint64_t n) {
  const reference::Row row = fake_row(n);
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    if (sample.accel_counts[axis] != row.accel[i] || sample.gyro_counts[axis] != row.gyro[i]) return false;
  }
  return true;
}

TEST(FirmwareChain, BringsEveryRowToTheHostAtItsTime) {
  Chain chain;
  chain.run_ms(20'000);
  const LinkStatistics& statistics = chain.decoder->statistics();
  EXPECT_EQ(statistics.lost_samples + statistics.damaged_frames + statistics.lost_frames, 0u);
  ASSERT_GT(chain.samples.size(), 79'000u);
  std::uint64_t first = 0;
  while (first < 1000 && !(is_row(chain.samples[0], first) && is_row(chain.samples[1], first + 1))) ++first;
  double least_us = 1e12;
  double most_us = -1e12;
  for (std::size_t i = 0; i < chain.samples.size(); ++i) {
    ASSERT_TRUE(is_row(chain.samples[i], first + i)) << i;
    if (i < chain.samples.size() / 2) continue;
    const double late_us = static_cast<double>(chain.samples[i].t_ns) * 1e-3 - chain.sensor.row_time_us(first + i);
    least_us = std::min(least_us, late_us);
    most_us = std::max(most_us, late_us);
  }
  // The delay that all frames have is not to be seen; what varies is.
  EXPECT_LT(most_us - least_us, 150.0);
  EXPECT_LT(most_us, 10e3);
}

TEST(FirmwareChain, TellsTheHostHowManyRowsTheSensorsOverflowCost) {
  Chain chain;
  chain.run_ms(2000);
  const std::uint64_t before = chain.sensor.rows_made();
  chain.sensor.advance(200e3);  // the loop stood still
  chain.run_ms(2000);
  const std::uint64_t lost = chain.decoder->statistics().lost_samples;
  EXPECT_GT(lost, 700u);
  EXPECT_EQ(chain.decoder->statistics().overruns, 1u);
  // All that were made have come, are lost, or are on the way.
  std::uint64_t first = 0;
  while (first < 1000 && !(is_row(chain.samples[0], first) && is_row(chain.samples[1], first + 1))) ++first;
  EXPECT_TRUE(is_row(chain.samples.back(), first + chain.samples.size() - 1 + lost));
  EXPECT_GT(chain.sensor.rows_made(), before);
}

}  // namespace
}  // namespace asperity
