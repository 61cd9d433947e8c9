#ifndef ASPERITY_FIRMWARE_QEMU_MEASURE_H
#define ASPERITY_FIRMWARE_QEMU_MEASURE_H

#include <stdint.h>

// The time of pieces of the program, interrupts taken out. With qemu's -icount every instruction takes the same time,
// so that this counts instructions.
typedef struct {
  uint64_t ticks;
  uint32_t count;
  uint32_t longest;
} measured;

typedef struct {
  uint32_t ticks;
  uint32_t interrupted;
} measure_mark;

measure_mark measure_begin(void);
void measure_end(measured* sum, measure_mark begin);

// At the beginning and the end of an interrupt.
uint32_t measure_enter(void);
void measure_leave(uint32_t entered);

// What a measured piece with nothing in it measures of itself, and adds to one round it, in 1/64 ticks.
void measure_calibrate(void);
extern uint32_t measure_own_q6;
extern uint32_t measure_outer_q6;

#endif
