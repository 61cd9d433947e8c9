#pragma once

// An ESP32-DevKitC (WROOM-32); docs/build-a-probe.md has the wiring. None of these decides how the chip boots but
// GPIO5, which the sensor's chip-select rightly holds high.
enum {
  kPinClock = 18,
  kPinMiso = 19,
  kPinMosi = 23,
  kPinImuSelect = 5,
  kPinImuInterrupt = 26,
  kPinAdcSelect = 25,
  kPinAdcReady = 27,
  kPinLed = 2
};
