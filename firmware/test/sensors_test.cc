// Both sensors behind the board: faults that the bus cannot report are found, counted and ended.

#include "asperity_firmware/sensors.h"

#include <gmock/gmock.h>
#include <vector>

#include "asperity_firmware/ads1220_model.h"
#include "fake_board.h"
#include "simulated_icm42688.h"

namespace asperity {
namespace {

class Sensors {
 public:
  Sensors() {
    imu.on_interrupt = [this](double now_us) { asp_edge_fire(&sensors.imu.edge, static_cast<std::uint64_t>(now_us)); };
    asp_ads1220_model_init(&force);
    force_spi_ = {&force,
                  [](void* model, const std::uint8_t* out, std::uint8_t* in, std::size_t count) {
                    return asp_ads1220_model_transfer(static_cast<asp_ads1220_model*>(model), out, in, count);
                  },
                  [](void*, std::uint32_t) {}};
  }
  Sensors(const Sensors&) = delete;
  Sensors& operator=(const Sensors&) = delete;

  void start() { asp_sensors_start(&sensors, imu.spi(), &force_spi_, ASP_ADS1220_1200_SPS, now_us()); }

  // A turn each millisecond, with a conversion.
  void run_ms(int ms) {
    for (int i = 0; i < ms; ++i) {
      imu.advance(1000.0);
      if (asp_ads1220_model_finish(&force, i)) asp_edge_fire(&sensors.force.edge, now_us());
      asp_imu_row rows[ASP_ROWS_A_READ];
      for (std::size_t count = 1; count > 0;) {
        count = asp_sensors_read_imu(&sensors, now_us(), rows, ASP_ROWS_A_READ);
        for (std::size_t row = 0; row < count; ++row) {
          lost += rows[row].lost_before;
          ++read;
          newest_ns = rows[row].time_ns;
        }
      }
      asp_force_sample sample;
      while (asp_sensors_read_force(&sensors, now_us(), &sample)) ++forces;
    }
  }

  asp_faults faults() const {
    asp_faults out;
    asp_sensors_read_faults(&sensors, &out);
    return out;
  }
  std::uint64_t now_us() const { return static_cast<std::uint64_t>(imu.now_us()); }

  SimulatedIcm42688 imu;
  asp_ads1220_model force{};
  asp_sensors sensors{};
  std::uint64_t read = 0;
  std::uint64_t lost = 0;
  std::uint64_t forces = 0;
  std::uint64_t newest_ns = 0;

 private:
  asp_spi force_spi_{};
};

TEST(FirmwareSensors, ReportNothingWhileAllIsWell) {
  Sensors board;
  board.start();
  board.run_ms(5000);
  EXPECT_GT(board.read, 19'900u);
  EXPECT_EQ(board.lost, 0u);
  EXPECT_EQ(board.forces, 5000u);
  const asp_faults faults = board.faults();
  EXPECT_EQ(faults.imu_state, ASP_SENSOR_WORKS);
  EXPECT_EQ(faults.force_state, ASP_SENSOR_WORKS);
  for (const std::uint32_t count : faults.counts) EXPECT_EQ(count, 0u);
}

TEST(FirmwareSensors, AreTriedAgainUntilTheyAnswer) {
  Sensors board;
  board.imu.identity = 0x48;
  board.force.present = false;
  board.start();
  board.run_ms(2500);
  EXPECT_EQ(board.read + board.forces, 0u);
  EXPECT_EQ(board.faults().imu_state, ASP_SENSOR_NOT_FOUND);
  EXPECT_EQ(board.faults().force_state, ASP_SENSOR_NOT_AS_WRITTEN);
  EXPECT_GE(board.faults().counts[ASP_FAULTS_IMU_RESTARTS], 4u);
  board.imu.identity = 0x47;
  board.force.present = true;
  board.run_ms(2500);
  EXPECT_EQ(board.faults().imu_state, ASP_SENSOR_WORKS);
  EXPECT_EQ(board.faults().force_state, ASP_SENSOR_WORKS);
  EXPECT_GT(board.read, 5000u);
  EXPECT_GT(board.forces, 1000u);
}

// Low, the FIFO looks empty for ever; high, it looks full. In neither case has a transfer failed.
TEST(FirmwareSensors, AStuckLineIsFoundAndItsRowsAreCounted) {
  for (const asp_model_line line : {ASP_MODEL_LINE_LOW, ASP_MODEL_LINE_HIGH}) {
    Sensors board;
    board.start();
    board.run_ms(2000);
    const std::uint64_t before_ns = board.newest_ns;
    const std::uint64_t read = board.read;
    board.imu.line = line;
    board.run_ms(1500);
    EXPECT_EQ(board.faults().imu_state, ASP_SENSOR_NOT_FOUND);
    board.imu.line = ASP_MODEL_LINE_WORKS;
    board.run_ms(2000);
    EXPECT_EQ(board.faults().imu_state, ASP_SENSOR_WORKS);
    EXPECT_GE(board.faults().counts[ASP_FAULTS_IMU_RESTARTS], 2u);
    EXPECT_EQ(board.faults().counts[ASP_FAULTS_IMU_OVERFLOWS] > 0, line == ASP_MODEL_LINE_HIGH);
    // The sensor began anew, so its own numbers say nothing: time does. Each period's row was read or counted as lost.
    const double periods = static_cast<double>(board.newest_ns - before_ns) / 250e3;
    EXPECT_NEAR(static_cast<double>(board.read - read + board.lost), periods, 2.0);
    EXPECT_GT(board.lost, 6000u);
  }
}

TEST(FirmwareSensors, ALostSupplyCostsTheRowsThatTimeSays) {
  Sensors board;
  board.start();
  board.run_ms(2000);
  const std::uint64_t first_ns = board.newest_ns;
  const std::uint64_t read = board.read;
  board.imu.power_cycle();
  board.run_ms(3000);
  EXPECT_EQ(board.faults().imu_state, ASP_SENSOR_WORKS);
  EXPECT_EQ(board.faults().counts[ASP_FAULTS_IMU_RESTARTS], 1u);
  const double periods = static_cast<double>(board.newest_ns - first_ns) / 250e3;
  EXPECT_NEAR(static_cast<double>(board.read - read + board.lost), periods, 2.0);
  EXPECT_GT(board.lost, 800u);
}

// Without INT1 the rows have no time: none is given.
TEST(FirmwareSensors, AMissingInterruptIsReported) {
  Sensors board;
  board.imu.on_interrupt = nullptr;
  board.start();
  board.run_ms(3000);
  EXPECT_EQ(board.read, 0u);
  EXPECT_EQ(board.faults().imu_state, ASP_SENSOR_NO_SAMPLES);
  EXPECT_GE(board.faults().counts[ASP_FAULTS_IMU_RESTARTS], 4u);
}

TEST(FirmwareSensors, AConverterThatStopsIsStartedAgain) {
  Sensors board;
  board.start();
  board.run_ms(500);
  board.force.converting = false;
  const std::uint64_t stopped_us = board.now_us();
  board.run_ms(1000);
  const double turn_us = static_cast<double>(board.now_us() - stopped_us) / 1000.0;  // with the bus's own time
  EXPECT_EQ(board.faults().counts[ASP_FAULTS_FORCE_RESTARTS], 1u);
  EXPECT_EQ(board.faults().force_state, ASP_SENSOR_WORKS);
  EXPECT_NEAR((1500.0 - static_cast<double>(board.forces)) * turn_us, ASP_FORCE_SILENCE_US, 3.0 * turn_us);
}

}  // namespace
}  // namespace asperity
