#ifndef ASPERITY_FIRMWARE_QEMU_MACHINE_H
#define ASPERITY_FIRMWARE_QEMU_MACHINE_H

#include <stdbool.h>
#include <stdint.h>

// What the program needs of an emulated board: microbit.c, mps2_an386.c.

void machine_init(void);
void machine_timer_handler(void);  // the alarm's interrupt

// A counter of µs that wraps.
uint32_t machine_us(void);

// A free-running counter for measuring, and how long a tick is.
uint32_t machine_ticks(void);
extern const uint32_t machine_tick_ps;

// Has machine_on_alarm() called in an interrupt once machine_us() reaches `us`, at once if it is past. One at a time.
void machine_set_alarm(uint32_t us);
void machine_on_alarm(void);  // the program's

// False: the line takes nothing now, or has nothing.
bool machine_uart_put(uint8_t byte);
bool machine_uart_get(uint8_t* byte);

// Interrupts off; returns what machine_unlock() wants.
static inline uint32_t machine_lock(void) {
  uint32_t before = 0;
  __asm volatile("mrs %0, primask\n\tcpsid i" : "=r"(before)::"memory");
  return before;
}

static inline void machine_unlock(uint32_t before) { __asm volatile("msr primask, %0" ::"r"(before) : "memory"); }

#endif
