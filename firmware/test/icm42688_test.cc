#include "asperity_firmware/icm42688.h"

#include <gmock/gmock.h>
#include <cmath>

#include "asperity/base/random.h"
#include "fake_board.h"
#include "simulated_icm42688.h"

namespace asperity {
namespace {

struct Rig {
  explicit Rig(double period_us = 250.0) : sensor(period_us) {
    sensor.on_interrupt = [this](double now_us) {
      asp_edge_fire(&device.edge, static_cast<std::uint64_t>(now_us + delay_us()));
    };
  }
  asp_icm42688_status start() { return asp_icm42688_start(&device, sensor.spi()); }

  // Looks every `turn_us`, as the loop does, and takes what there is.
  void run(double us, double turn_us) {
    for (double done = 0.0; done < us; done += turn_us) {
      sensor.advance(turn_us);
      for (;;) {
        asp_imu_row read[ASP_ROWS_A_READ];
        const std::size_t count = asp_icm42688_read(&device, read, ASP_ROWS_A_READ);
        rows.insert(rows.end(), read, read + count);
        if (count < ASP_ROWS_A_READ) break;
      }
    }
  }

  std::function<double()> delay_us = [] { return 0.0; };
  SimulatedIcm42688 sensor;
  asp_icm42688 device{};
  std::vector<asp_imu_row> rows;
};

struct Account {
  std::uint64_t next = 0;
  std::uint64_t missing = 0;
  double worst_us = 0.0;
};

bool has_values_of(const asp_imu_row& row, std::uint64_t n) {
  const reference::Row truth = fake_row(n);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (row.accel[axis] != truth.accel[axis] || row.gyro[axis] != truth.gyro[axis]) return false;
  }
  return true;
}

// Every row is the one that its number, counted with the gaps told, says, and its time is near the truth.
Account check(const Rig& rig, std::size_t skip_times = 0) {
  Account out;
  if (rig.rows.size() < 3) return out;
  // Some rows have the values of others; three in a row have not.
  const auto begins_at = [&](std::uint64_t n) {
    return has_values_of(rig.rows[0], n) && has_values_of(rig.rows[1], n + 1) && has_values_of(rig.rows[2], n + 2);
  };
  while (!begins_at(out.next) && out.next < 1000) ++out.next;
  EXPECT_LT(out.next, 1000u);
  std::uint64_t last_ns = 0;
  for (std::size_t i = 0; i < rig.rows.size(); ++i) {
    const asp_imu_row& row = rig.rows[i];
    if (i > 0) {
      out.next += row.lost_before;
      out.missing += row.lost_before;
    }
    EXPECT_TRUE(has_values_of(row, out.next)) << i << ' ' << out.next;
    EXPECT_GT(row.time_ns, last_ns) << i;
    last_ns = row.time_ns;
    if (i >= skip_times) {
      const double off_us = static_cast<double>(row.time_ns) * 1e-3 - rig.sensor.row_time_us(out.next);
      out.worst_us = std::max(out.worst_us, std::abs(off_us));
    }
    ++out.next;
    if (testing::Test::HasFailure()) break;
  }
  return out;
}

TEST(Icm42688, IsConfiguredAsTheDatasheetSays) {
  Rig rig;
  ASSERT_EQ(rig.start(), ASP_ICM42688_OK);
  const auto& sensor = rig.sensor;
  EXPECT_EQ(sensor.reg(0, 0x4F) >> 5, 0);       // ±2000 °/s
  EXPECT_EQ(sensor.reg(0, 0x4F) & 0x0F, 4);     // 4 kHz
  EXPECT_EQ(sensor.reg(0, 0x50) >> 5, 0);       // ±16 g
  EXPECT_EQ(sensor.reg(0, 0x50) & 0x0F, 4);     // 4 kHz
  EXPECT_EQ(sensor.reg(0, 0x4E) & 0x0F, 0x0F);  // both in low-noise mode
  EXPECT_EQ(sensor.reg(0, 0x16) >> 6, 3);       // FIFO stops when full
  EXPECT_EQ(sensor.reg(0, 0x5F) & 0x33, 0x23);  // accelerometer, gyroscope, no 20 bits, edges above the watermark
  EXPECT_EQ(sensor.reg(0, 0x60), 16);
  EXPECT_EQ(sensor.reg(0, 0x61), 0);
  EXPECT_EQ(sensor.reg(0, 0x64) & 0x70, 0x60);  // as 4 kHz and more demand; not the asynchronous reset
  EXPECT_EQ(sensor.reg(0, 0x65), 0x04);
  EXPECT_EQ(sensor.reg(0, 0x4C), 0x73);
  const auto square = [](int low, int high) { return low | (high & 0x0F) << 8; };
  EXPECT_EQ(sensor.reg(1, 0x0C), 21);
  EXPECT_EQ(square(sensor.reg(1, 0x0D), sensor.reg(1, 0x0E)), 440);
  EXPECT_EQ(sensor.reg(1, 0x0E) >> 4, 6);
  EXPECT_EQ(sensor.reg(2, 0x03), 21 << 1);
  EXPECT_EQ(square(sensor.reg(2, 0x04), sensor.reg(2, 0x05)), 440);
  EXPECT_EQ(sensor.reg(2, 0x05) >> 4, 6);
}

TEST(Icm42688, SaysWhyItDoesNotStart) {
  Rig absent;
  absent.sensor.identity = 0xFF;
  EXPECT_EQ(absent.start(), ASP_ICM42688_NOT_FOUND);
  Rig cut;
  cut.sensor.bus_works = false;
  EXPECT_EQ(cut.start(), ASP_ICM42688_BUS_FAILED);
  Rig asleep;
  asleep.sensor.resets = false;
  EXPECT_EQ(asleep.start(), ASP_ICM42688_NO_RESET);
  for (const auto& [bank, address] : {std::pair{0, 0x50}, std::pair{1, 0x0D}, std::pair{2, 0x05}, std::pair{0, 0x4E}}) {
    Rig stuck;
    stuck.sensor.stuck_bank = bank;
    stuck.sensor.stuck_address = address;
    EXPECT_EQ(stuck.start(), ASP_ICM42688_NOT_AS_WRITTEN) << bank << ' ' << address;
  }
}

TEST(Icm42688, ParsesPacketsOf16And20Bytes) {
  const std::uint8_t packet[20] = {0x68, 0x12, 0x34, 0x80, 0x01, 0x7F, 0xFF, 0xFF, 0xFE, 0x00,
                                   0x00, 0x80, 0x00, 0x15, 0xAB, 0xCD, 0,    0,    0,    0};
  asp_imu_row row{};
  EXPECT_EQ(asp_icm42688_parse(packet, false, &row), ASP_PACKET_ROW);
  EXPECT_THAT(row.accel, testing::ElementsAre(0x1234, -32767, 32767));
  EXPECT_THAT(row.gyro, testing::ElementsAre(-2, 0, -32768));
  std::uint8_t hires[20];
  std::copy(std::begin(packet), std::end(packet), hires);
  hires[0] = 0x78;
  hires[17] = hires[18] = hires[19] = 0xFF;
  row = {};
  EXPECT_EQ(asp_icm42688_parse(hires, true, &row), ASP_PACKET_ROW);
  EXPECT_THAT(row.accel, testing::ElementsAre(0x1234, -32767, 32767));
  EXPECT_EQ(asp_icm42688_parse(hires, false, &row), ASP_PACKET_STRANGE);
  EXPECT_EQ(asp_icm42688_parse(packet, true, &row), ASP_PACKET_STRANGE);
}

TEST(Icm42688, KnowsEmptyInvalidAndStrangePackets) {
  std::uint8_t packet[16] = {0x6B, 0x80, 0x00, 0x80, 0x00, 0x80, 0x00, 0, 1, 0, 2, 0, 3};
  asp_imu_row row{};
  EXPECT_EQ(asp_icm42688_parse(packet, false, &row), ASP_PACKET_INVALID);  // the accelerometer's
  packet[6] = 0x01;
  EXPECT_EQ(asp_icm42688_parse(packet, false, &row), ASP_PACKET_ROW);
  for (int i = 7; i < 13; ++i) packet[i] = i % 2 == 1 ? 0x80 : 0x00;
  EXPECT_EQ(asp_icm42688_parse(packet, false, &row), ASP_PACKET_INVALID);  // the gyroscope's
  for (int header = 0; header < 256; ++header) {
    packet[0] = static_cast<std::uint8_t>(header);
    packet[12] = 1;
    const asp_packet_kind expected = header >= 0x80          ? ASP_PACKET_EMPTY
                                     : (header >> 2) == 0x1A ? ASP_PACKET_ROW
                                                             : ASP_PACKET_STRANGE;
    EXPECT_EQ(asp_icm42688_parse(packet, false, &row), expected) << header;
  }
}

TEST(Icm42688, GivesEveryRowAtItsTime) {
  for (const double period_us : {245.0, 250.0, 252.6}) {
    for (const double turn_us : {37.0, 500.0, 3000.0}) {
      Rig rig(period_us);
      ASSERT_EQ(rig.start(), ASP_ICM42688_OK);
      rig.run(4e6, turn_us);
      const Account account = check(rig, 16 * 32);
      EXPECT_EQ(account.missing, 0u);
      EXPECT_LE(rig.sensor.rows_made() - account.next, 16u + static_cast<unsigned>(turn_us / period_us) + 1u);
      EXPECT_LT(account.worst_us, 3.0) << period_us << ' ' << turn_us;
      EXPECT_EQ(rig.device.statistics.coasted_reads, 0u) << period_us << ' ' << turn_us;
    }
  }
}

TEST(Icm42688, GivesEveryRowWhereTheLoopIsLate) {
  Random random(3);
  Rig rig(251.0);
  rig.delay_us = [&] { return 10.0 * random.uniform(); };
  ASSERT_EQ(rig.start(), ASP_ICM42688_OK);
  rig.run(2e6, 500.0);
  for (int i = 0; i < 50; ++i) {
    rig.run(25e3, 25e3);  // 100 rows: near to what the FIFO holds
    rig.run(40e3, 500.0);
  }
  const Account account = check(rig, 16 * 32);
  EXPECT_EQ(account.missing, 0u);
  EXPECT_GT(rig.device.statistics.coasted_reads, 100u);
  EXPECT_LT(account.worst_us, 30.0);
}

TEST(Icm42688, CountsByTimeWhatAnOverflowCost) {
  Rig rig(251.0);
  ASSERT_EQ(rig.start(), ASP_ICM42688_OK);
  for (const double pause_us : {33e3, 40e3, 100e3, 2.5e6}) {
    rig.run(500e3, 500.0);
    rig.run(pause_us, pause_us);
  }
  rig.run(500e3, 500.0);
  const Account account = check(rig);  // which compares each row's values with its number
  EXPECT_GT(account.missing, 10000u);
  EXPECT_EQ(rig.device.statistics.overflows, 4u);
  EXPECT_LE(rig.sensor.rows_made() - account.next, 20u);
}

TEST(Icm42688, CountsByTimeWhatLostStepCost) {
  Rig rig(249.0);
  ASSERT_EQ(rig.start(), ASP_ICM42688_OK);
  for (int i = 0; i < 5; ++i) {
    rig.run(300e3, 500.0);
    rig.sensor.lose_a_byte();
  }
  rig.run(300e3, 500.0);
  const Account account = check(rig);
  EXPECT_EQ(rig.device.statistics.lost_sync, 5u);
  EXPECT_GT(account.missing, 5u);
  EXPECT_LE(account.missing, 5u * 56u);
}

TEST(Icm42688, CountsInvalidRowsAsLost) {
  Rig rig;
  ASSERT_EQ(rig.start(), ASP_ICM42688_OK);
  rig.run(500e3, 500.0);
  rig.sensor.invalid_from = rig.sensor.rows_made() + 5;
  rig.sensor.invalid_to = rig.sensor.invalid_from + 40;
  rig.run(500e3, 500.0);
  const Account account = check(rig);
  EXPECT_EQ(account.missing, 40u);
  EXPECT_EQ(rig.device.statistics.invalid_rows, 40u);
}

TEST(Icm42688, GoesOnAfterTheBusFailed) {
  Rig rig(250.7);
  ASSERT_EQ(rig.start(), ASP_ICM42688_OK);
  rig.run(500e3, 500.0);
  rig.sensor.bus_works = false;
  rig.run(50e3, 500.0);
  rig.sensor.bus_works = true;
  rig.run(500e3, 500.0);
  const Account account = check(rig);
  EXPECT_GT(account.missing, 150u);
  EXPECT_LE(rig.sensor.rows_made() - account.next, 20u);
  EXPECT_GT(rig.device.statistics.bus_failures, 10u);
}

// A broken wire gives anything: nothing is written outside, and times still rise.
TEST(Icm42688, SurvivesAnyBytesOfTheBus) {
  Random random(11);
  const asp_spi noise = {&random,
                         [](void* context, const std::uint8_t*, std::uint8_t* in, std::size_t count) {
                           auto& bits = *static_cast<Random*>(context);
                           for (std::size_t k = 0; k < count; ++k) in[k] = static_cast<std::uint8_t>(bits.bits());
                           // Often as they should be, so that more is reached.
                           if (bits.chance(0.9) && count == 4) in[1] = in[2] = 0;
                           const bool in_step = count > 4 && bits.chance(0.9);
                           for (std::size_t k = 1; in_step && k < count; k += 16) in[k] = 0x68;
                           return !bits.chance(0.01);
                         },
                         [](void*, std::uint32_t) {}};
  asp_icm42688 device{};
  device.spi = &noise;
  asp_row_clock_init(&device.clock, ASP_ICM42688_PERIOD_NS);
  device.edge.state = ASP_EDGE_ARMED;
  std::uint64_t last_ns = 0;
  std::uint64_t now_us = 0;
  std::size_t rows_given = 0;
  for (int i = 0; i < 200000; ++i) {
    now_us += static_cast<std::uint64_t>(random.uniform() * 8000.0);
    if (random.chance(0.7)) asp_edge_fire(&device.edge, now_us);
    asp_imu_row rows[ASP_ROWS_A_READ];
    const std::size_t count = asp_icm42688_read(&device, rows, ASP_ROWS_A_READ);
    ASSERT_LE(count, ASP_ROWS_A_READ);
    for (std::size_t k = 0; k < count; ++k) {
      ASSERT_GT(rows[k].time_ns, last_ns);
      last_ns = rows[k].time_ns;
    }
    rows_given += count;
  }
  EXPECT_GT(rows_given, 1000u);
}

}  // namespace
}  // namespace asperity
