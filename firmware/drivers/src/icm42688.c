#include "asperity_firmware/icm42688.h"

_Static_assert(ASP_ICM42688_WATERMARK <= ASP_ROWS_A_READ, "the core asks for so many rows at a time");

enum {
  kDeviceConfig = 0x11,
  kIntConfig = 0x14,
  kFifoConfig = 0x16,
  kIntStatus = 0x2D,  // followed by FIFO_COUNTH and FIFO_COUNTL
  kFifoData = 0x30,
  kSignalPathReset = 0x4B,
  kIntfConfig0 = 0x4C,
  kPwrMgmt0 = 0x4E,
  kGyroConfig0 = 0x4F,
  kAccelConfig0 = 0x50,
  kGyroAccelConfig0 = 0x52,
  kTmstConfig = 0x54,
  kFifoConfig1 = 0x5F,
  kFifoConfig2 = 0x60,
  kFifoConfig3 = 0x61,
  kIntConfig0 = 0x63,
  kIntConfig1 = 0x64,
  kIntSource0 = 0x65,
  kWhoAmI = 0x75,
  kBankSel = 0x76,

  kRead = 0x80,
  kIdentity = 0x47,
  kResetDone = 0x10,
  kFifoFull = 0x02,
  kFifoFlush = 0x02,
  kHeaderMessage = 0x80,
  kHeaderKind = 0xFC,  // message, accelerometer, gyroscope, 20 bits, two bits of the time stamp
  kHeaderRow = 0x68,
  kHeaderHiresRow = 0x78,
  kInvalid = -32768
};

typedef struct {
  uint8_t bank;
  uint8_t address;
  uint8_t value;
} setting;

// The anti-alias filters' codes for 997 Hz: DELT 21, DELTSQR 440, BITSHIFT 6 (datasheet, section 5.3).
static const setting kSettings[] = {
    {1, 0x0C, 21},                     // gyroscope: DELT
    {1, 0x0D, 440 & 0xFF},             // DELTSQR, low
    {1, 0x0E, (6 << 4) | (440 >> 8)},  // BITSHIFT, DELTSQR high
    {2, 0x03, 21 << 1},                // accelerometer: DELT, filter not disabled
    {2, 0x04, 440 & 0xFF},             //
    {2, 0x05, (6 << 4) | (440 >> 8)},  //
    {0, kIntfConfig0, 0x73},           // FIFO counted in packets, big-endian, I2C off, invalid values marked
    {0, kIntConfig, 0x03},             // INT1: pulse, push-pull, active high
    {0, kIntConfig0, 0x08},            // the threshold's status bit is cleared by reading the FIFO
    {0, kIntConfig1, 0x60},            // pulses of 8 µs without the pause that 4 kHz has no time for
    {0, kGyroConfig0, 0x04},           // ±2000 °/s, 4 kHz
    {0, kAccelConfig0, 0x04},          // ±16 g, 4 kHz
    {0, kGyroAccelConfig0, 0x00},      // UI filters at half the rate: the anti-alias filters are narrower
    {0, kTmstConfig, 0x21},            // time stamps of 1 µs
    {0, kFifoConfig2, ASP_ICM42688_WATERMARK},
    {0, kFifoConfig3, 0},
    {0, kFifoConfig1, 0x27},  // accelerometer, gyroscope, temperature; a pulse for each row from the watermark on
    {0, kFifoConfig, 0xC0},   // stops when full: what it holds stays in step
    {0, kIntSource0, 0x04},   // the FIFO's threshold to INT1
    {0, kPwrMgmt0, 0x0F},     // both sensors on, low noise
};

static bool write_register(asp_icm42688* device, uint8_t address, uint8_t value) {
  uint8_t bytes[2] = {address, value};
  return device->spi->transfer(device->spi->context, bytes, bytes, sizeof bytes);
}

static bool read_register(asp_icm42688* device, uint8_t address, uint8_t* value) {
  uint8_t bytes[2] = {(uint8_t)(kRead | address), 0};
  const bool sound = device->spi->transfer(device->spi->context, bytes, bytes, sizeof bytes);
  *value = bytes[1];
  return sound;
}

static void wait_us(asp_icm42688* device, uint32_t us) { device->spi->wait_us(device->spi->context, us); }

static asp_icm42688_status apply(asp_icm42688* device) {
  const size_t count = sizeof kSettings / sizeof kSettings[0];
  for (size_t i = 0; i < count; ++i) {
    const setting* s = &kSettings[i];
    uint8_t value = 0;
    if (!write_register(device, kBankSel, s->bank) || !write_register(device, s->address, s->value)) {
      return ASP_ICM42688_BUS_FAILED;
    }
    if (s->bank == 0 && s->address == kPwrMgmt0) {
      wait_us(device, 300);  // it takes no command for 200 µs after it has been woken
    }
    if (!read_register(device, s->address, &value)) {
      return ASP_ICM42688_BUS_FAILED;
    }
    if (value != s->value) {
      return ASP_ICM42688_NOT_AS_WRITTEN;
    }
  }
  return write_register(device, kBankSel, 0) ? ASP_ICM42688_OK : ASP_ICM42688_BUS_FAILED;
}

// What is in the FIFO is worth nothing without its place in time.
static void throw_away(asp_icm42688* device) {
  device->edge.state = ASP_EDGE_OFF;
  if (!write_register(device, kSignalPathReset, kFifoFlush)) {
    ++device->statistics.bus_failures;
  }
  device->recovering = true;
  asp_row_clock_restart(&device->clock);
  device->edge.state = ASP_EDGE_ARMED;
}

asp_icm42688_status asp_icm42688_start(asp_icm42688* device, const asp_spi* spi) {
  *device = (asp_icm42688){.spi = spi};
  asp_row_clock_init(&device->clock, ASP_ICM42688_PERIOD_NS);
  uint8_t value = 0;
  if (!write_register(device, kBankSel, 0) || !read_register(device, kWhoAmI, &value)) {
    return ASP_ICM42688_BUS_FAILED;
  }
  if (value != kIdentity) {
    return ASP_ICM42688_NOT_FOUND;
  }
  if (!write_register(device, kDeviceConfig, 0x01)) {
    return ASP_ICM42688_BUS_FAILED;
  }
  wait_us(device, 2000);
  if (!read_register(device, kIntStatus, &value)) {
    return ASP_ICM42688_BUS_FAILED;
  }
  if ((value & kResetDone) == 0) {
    return ASP_ICM42688_NO_RESET;
  }
  const asp_icm42688_status status = apply(device);
  if (status != ASP_ICM42688_OK) {
    return status;
  }
  wait_us(device, 50000);  // the gyroscope needs 45 ms
  throw_away(device);
  // It has been full meanwhile, which reading clears.
  return read_register(device, kIntStatus, &value) ? ASP_ICM42688_OK : ASP_ICM42688_BUS_FAILED;
}

void asp_icm42688_continue(asp_icm42688* device, const asp_icm42688* before) {
  device->clock = before->clock;
  asp_row_clock_restart(&device->clock);
  device->found_row = before->found_row;
  device->lost_rows = before->lost_rows;
  device->recovering = true;
}

static int16_t big_endian(const uint8_t* bytes) {
  const uint32_t value = ((uint32_t)bytes[0] << 8) | bytes[1];
  return (int16_t)(value < 0x8000u ? (int32_t)value : (int32_t)value - 0x10000);
}

static bool is_valid(const int16_t* values) {
  return values[0] != kInvalid || values[1] != kInvalid || values[2] != kInvalid;
}

asp_packet_kind asp_icm42688_parse(const uint8_t* packet, bool hires, asp_imu_row* row) {
  if ((packet[0] & kHeaderMessage) != 0) {
    return ASP_PACKET_EMPTY;
  }
  if ((packet[0] & kHeaderKind) != (hires ? kHeaderHiresRow : kHeaderRow)) {
    return ASP_PACKET_STRANGE;
  }
  for (unsigned axis = 0; axis < 3; ++axis) {
    row->accel[axis] = big_endian(packet + 1 + 2 * axis);
    row->gyro[axis] = big_endian(packet + 7 + 2 * axis);
  }
  return is_valid(row->accel) && is_valid(row->gyro) ? ASP_PACKET_ROW : ASP_PACKET_INVALID;
}

// Packets waiting; false after an overflow or where the bus failed.
static bool count_packets(asp_icm42688* device, uint32_t* count) {
  uint8_t bytes[4] = {kRead | kIntStatus, 0, 0, 0};
  if (!device->spi->transfer(device->spi->context, bytes, bytes, sizeof bytes)) {
    ++device->statistics.bus_failures;
    return false;
  }
  *count = ((uint32_t)bytes[2] << 8) | bytes[3];
  if ((bytes[1] & kFifoFull) != 0 || *count >= ASP_ICM42688_FIFO_ROWS) {
    ++device->statistics.overflows;
    return false;
  }
  return true;
}

// The edge is of the row that made the watermark, the last of those read, if the loop had armed it while fewer waited.
// After a late turn more than the watermark is left, and the next edge would be of any row: those rows coast.
static bool next_times(asp_icm42688* device, asp_row_times* times) {
  if (device->edge.state == ASP_EDGE_SEEN) {
    *times = asp_row_clock_advance(&device->clock, ASP_ICM42688_WATERMARK, device->edge.time_us);
    return true;
  }
  if (device->clock.count == 0) {
    return false;
  }
  ++device->statistics.coasted_reads;
  *times = asp_row_clock_coast(&device->clock, ASP_ICM42688_WATERMARK);
  return true;
}

static void count_lost_by_time(asp_icm42688* device, uint64_t last_ns, const asp_row_times* times) {
  if (device->recovering && device->found_row && times->first_ns > last_ns) {
    const uint64_t periods = (times->first_ns - last_ns + times->step_ns / 2u) / times->step_ns;
    device->lost_rows += periods > 1u ? (uint32_t)(periods - 1u) : 0u;
  }
  device->recovering = false;
}

static void arm(asp_icm42688* device) {
  device->edge.state = ASP_EDGE_ARMED;
  uint32_t left = 0;
  if (!count_packets(device, &left)) {
    throw_away(device);
  } else if (left >= ASP_ICM42688_WATERMARK) {
    device->edge.state = ASP_EDGE_OFF;
  }
}

// Out of step, one packet in 64 looks sound: none of a read is believed if one is strange.
static bool is_in_step(const uint8_t* packets) {
  for (uint32_t i = 0; i < ASP_ICM42688_WATERMARK; ++i) {
    if ((packets[i * ASP_PACKET_BYTES] & kHeaderKind) != kHeaderRow) {
      return false;
    }
  }
  return true;
}

static size_t give_rows(asp_icm42688* device, const uint8_t* packets, const asp_row_times* times, asp_imu_row* rows) {
  size_t count = 0;
  for (uint32_t i = 0; i < ASP_ICM42688_WATERMARK; ++i) {
    asp_imu_row* row = &rows[count];
    if (asp_icm42688_parse(packets + i * ASP_PACKET_BYTES, false, row) != ASP_PACKET_ROW) {
      device->lost_rows += device->found_row ? 1u : 0u;
      ++device->statistics.invalid_rows;
      continue;
    }
    row->time_ns = times->first_ns + (uint64_t)i * times->step_ns;
    row->lost_before = device->lost_rows;
    device->lost_rows = 0;
    device->found_row = true;
    ++count;
  }
  return count;
}

static bool read_packets(asp_icm42688* device, uint8_t* bytes, size_t count) {
  bytes[0] = kRead | kFifoData;
  if (!device->spi->transfer(device->spi->context, bytes, bytes, count)) {
    ++device->statistics.bus_failures;
    return false;
  }
  if (!is_in_step(bytes + 1)) {
    ++device->statistics.lost_sync;
    return false;
  }
  return true;
}

size_t asp_icm42688_read(asp_icm42688* device, asp_imu_row* rows, size_t capacity) {
  uint32_t waiting = 0;
  if (!count_packets(device, &waiting)) {
    throw_away(device);
    return 0;
  }
  if (waiting < ASP_ICM42688_WATERMARK || capacity < ASP_ICM42688_WATERMARK) {
    if (device->recovering && device->edge.state == ASP_EDGE_SEEN) {
      device->edge.state = ASP_EDGE_ARMED;  // a pulse from before the FIFO was emptied
    }
    return 0;
  }
  uint8_t bytes[1 + ASP_ICM42688_WATERMARK * ASP_PACKET_BYTES] = {0};
  const uint64_t last_ns = device->clock.last_ns;
  asp_row_times times = {0, 0};
  if (!read_packets(device, bytes, sizeof bytes) || !next_times(device, &times)) {
    throw_away(device);
    return 0;
  }
  count_lost_by_time(device, last_ns, &times);
  const size_t count = give_rows(device, bytes + 1, &times, rows);
  arm(device);
  return count;
}
