// qemu's "mps2-an386": a Cortex-M4 at 25 MHz on ARM's MPS2 board, 4 MiB of each memory.
#include "machine.h"
#include "nvic.h"
#include "registers.h"

enum {
  kDualTimer = 0x40002000,  // 25 MHz; the first one measures, the second one is the alarm
  kTimerLoad = 0x00,
  kTimerValue = 0x04,
  kTimerControl = 0x08,
  kTimerClear = 0x0C,
  kTimerSecond = 0x20,
  kTimerInterrupt = 10,

  kUart = 0x40004000,
  kUartData = 0x00,
  kUartState = 0x04,
  kUartControl = 0x08,
  kUartBaud = 0x10,

  kFpgaCounter = 0x40028018,
  kFpgaPrescale = 0x4002801C,
  kClock_MHz = 25
};

const uint32_t machine_tick_ps = 40000;

void machine_init(void) {
  write_word(kFpgaPrescale, kClock_MHz - 1);
  write_word(kDualTimer + kTimerLoad, 0xFFFFFFFFu);
  write_word(kDualTimer + kTimerControl, 0x82);  // on, 32 bits, wraps
  nvic_enable(kTimerInterrupt);
  write_word(kUart + kUartBaud, 27);  // 925,926 bps, 0.5 % above 921,600
  write_word(kUart + kUartControl, 3);
}

uint32_t machine_us(void) { return read_word(kFpgaCounter); }

uint32_t machine_ticks(void) { return ~read_word(kDualTimer + kTimerValue); }

void machine_set_alarm(uint32_t us) {
  const int32_t in_us = (int32_t)(us - machine_us());
  write_word(kDualTimer + kTimerSecond + kTimerControl, 0x22);  // off
  write_word(kDualTimer + kTimerSecond + kTimerLoad, in_us > 0 ? (uint32_t)in_us * kClock_MHz : 1u);
  write_word(kDualTimer + kTimerSecond + kTimerControl, 0xA3);  // on, with interrupt, 32 bits, once
}

void machine_timer_handler(void) {
  write_word(kDualTimer + kTimerSecond + kTimerClear, 1);
  machine_on_alarm();
}

bool machine_uart_put(uint8_t byte) {
  if ((read_word(kUart + kUartState) & 1u) != 0) {
    return false;
  }
  write_word(kUart + kUartData, byte);
  return true;
}

bool machine_uart_get(uint8_t* byte) {
  if ((read_word(kUart + kUartState) & 2u) == 0) {
    return false;
  }
  *byte = (uint8_t)read_word(kUart + kUartData);
  return true;
}
