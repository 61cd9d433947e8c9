#include "asperity_firmware/ads1220.h"

enum {
  kReset = 0x06,
  kStart = 0x08,
  kReadData = 0x10,
  kReadRegisters = 0x20,  // all four: count − 1 in the lowest bits
  kWriteRegisters = 0x40,
  kAllRegisters = 0x03
};

uint32_t asp_ads1220_rate_sps(asp_ads1220_rate rate) {
  static const uint32_t kRates[] = {350, 660, 1200, 2000};
  return kRates[rate];
}

int32_t asp_ads1220_counts(const uint8_t* bytes) {
  const uint32_t value = ((uint32_t)bytes[0] << 16) | ((uint32_t)bytes[1] << 8) | bytes[2];
  return value < 0x800000u ? (int32_t)value : (int32_t)value - 0x1000000;
}

static bool transfer(asp_ads1220* device, uint8_t* bytes, size_t count) {
  return device->spi->transfer(device->spi->context, bytes, bytes, count);
}

asp_ads1220_status asp_ads1220_start(asp_ads1220* device, const asp_spi* spi, asp_ads1220_rate rate) {
  *device = (asp_ads1220){.spi = spi, .period_us = 1000000u / asp_ads1220_rate_sps(rate)};
  const uint8_t settings[4] = {
      0x0E,                                           // AIN0 − AIN1, gain 128, amplifier on
      (uint8_t)(((uint32_t)rate + 3u) << 5 | 0x14u),  // rate, turbo mode, continuous
      0xC0,  // reference: the analogue supply; no mains filter, no current sources
      0x00,  // DRDY only on its own pin
  };
  uint8_t reset = kReset;
  if (!transfer(device, &reset, 1)) {
    return ASP_ADS1220_BUS_FAILED;
  }
  spi->wait_us(spi->context, 200);  // 50 µs and 32 of its clock's
  uint8_t write[5] = {kWriteRegisters | kAllRegisters, settings[0], settings[1], settings[2], settings[3]};
  uint8_t read[5] = {kReadRegisters | kAllRegisters, 0, 0, 0, 0};
  if (!transfer(device, write, sizeof write) || !transfer(device, read, sizeof read)) {
    return ASP_ADS1220_BUS_FAILED;
  }
  for (unsigned i = 0; i < 4; ++i) {
    if (read[1 + i] != settings[i]) {
      return ASP_ADS1220_NOT_AS_WRITTEN;
    }
  }
  device->edge.state = ASP_EDGE_ARMED;
  uint8_t start = kStart;
  return transfer(device, &start, 1) ? ASP_ADS1220_OK : ASP_ADS1220_BUS_FAILED;
}

bool asp_ads1220_read(asp_ads1220* device, asp_force_sample* sample) {
  if (device->edge.state != ASP_EDGE_SEEN) {
    return false;
  }
  uint32_t more = 0;
  uint64_t edge_us = 0;
  // An interrupt may come between the two halves of the time.
  do {
    more = device->edge.more;
    edge_us = device->edge.latest_us;
  } while (more != device->edge.more);
  device->edge.state = ASP_EDGE_ARMED;
  device->skipped += more;
  uint8_t bytes[4] = {kReadData, 0, 0, 0};
  if (!transfer(device, bytes, sizeof bytes)) {
    ++device->bus_failures;
    return false;
  }
  // The next was ready meanwhile: which of the two was read is not known.
  if (device->edge.state == ASP_EDGE_SEEN || device->edge.more != more) {
    ++device->skipped;
    return false;
  }
  *sample = (asp_force_sample){.time_us = edge_us - device->period_us / 2u};
  sample->counts[0] = asp_ads1220_counts(bytes + 1);
  return true;
}
