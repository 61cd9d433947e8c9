// qemu's "microbit": an nRF51822, Cortex-M0 at 16 MHz, 256 KiB of flash, 16 KiB of RAM.
#include "machine.h"
#include "nvic.h"
#include "registers.h"

enum {
  kUart = 0x40002000,
  kUartStartRx = 0x000,
  kUartStartTx = 0x008,
  kUartRxReady = 0x108,
  kUartTxReady = 0x11C,
  kUartEnable = 0x500,
  kUartRx = 0x518,
  kUartTx = 0x51C,
  kUartBaud = 0x524,

  kClock = 0x40008000,    // TIMER0: 1 MHz, the clock and the alarm
  kMeasure = 0x40009000,  // TIMER1: 16 MHz; qemu's has 32 bits, the part's has 16
  kTimerStart = 0x000,
  kTimerCapture1 = 0x044,
  kTimerCompare0 = 0x140,
  kTimerIntEnable = 0x304,
  kTimerBits = 0x508,
  kTimerPrescaler = 0x510,
  kTimerCc0 = 0x540,
  kTimerCc1 = 0x544,
  kClockInterrupt = 8
};

const uint32_t machine_tick_ps = 62500;
static bool s_tx_busy;

static void start_timer(uintptr_t base, uint32_t prescaler) {
  write_word(base + kTimerBits, 3);  // 32 bits
  write_word(base + kTimerPrescaler, prescaler);
  write_word(base + kTimerStart, 1);
}

void machine_init(void) {
  start_timer(kClock, 4);
  start_timer(kMeasure, 0);
  write_word(kClock + kTimerIntEnable, 1u << 16);
  nvic_enable(kClockInterrupt);
  write_word(kUart + kUartBaud, 0x0EBEDFA4u);  // 921,600 bps
  write_word(kUart + kUartEnable, 4);
  write_word(kUart + kUartStartTx, 1);
  write_word(kUart + kUartStartRx, 1);
}

uint32_t machine_us(void) {
  write_word(kClock + kTimerCapture1, 1);
  return read_word(kClock + kTimerCc1);
}

uint32_t machine_ticks(void) {
  write_word(kMeasure + kTimerCapture1, 1);
  return read_word(kMeasure + kTimerCc1);
}

void machine_set_alarm(uint32_t us) {
  write_word(kClock + kTimerCompare0, 0);
  write_word(kClock + kTimerCc0, us);
  if ((int32_t)(us - machine_us()) <= 0) {
    nvic_set_pending(kClockInterrupt);
  }
}

void machine_timer_handler(void) {
  write_word(kClock + kTimerCompare0, 0);
  machine_on_alarm();
}

bool machine_uart_put(uint8_t byte) {
  if (s_tx_busy && read_word(kUart + kUartTxReady) == 0) {
    return false;
  }
  write_word(kUart + kUartTxReady, 0);
  write_word(kUart + kUartTx, byte);
  s_tx_busy = true;
  return true;
}

bool machine_uart_get(uint8_t* byte) {
  if (read_word(kUart + kUartRxReady) == 0) {
    return false;
  }
  write_word(kUart + kUartRxReady, 0);
  *byte = (uint8_t)read_word(kUart + kUartRx);
  return true;
}
