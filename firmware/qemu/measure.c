#include "measure.h"

#include "machine.h"

uint32_t measure_own_q6;
uint32_t measure_outer_q6;
static volatile uint32_t s_interrupted;

measure_mark measure_begin(void) {
  const uint32_t before = machine_lock();
  const measure_mark mark = {machine_ticks(), s_interrupted};
  machine_unlock(before);
  return mark;
}

void measure_end(measured* sum, measure_mark begin) {
  const measure_mark end = measure_begin();
  const uint32_t ticks = (end.ticks - begin.ticks) - (end.interrupted - begin.interrupted);
  sum->ticks += ticks;
  ++sum->count;
  sum->longest = ticks > sum->longest ? ticks : sum->longest;
}

uint32_t measure_enter(void) { return machine_ticks(); }

void measure_leave(uint32_t entered) { s_interrupted += machine_ticks() - entered; }

void measure_calibrate(void) {
  measured outer = {0};
  measured inner = {0};
  const measure_mark begin = measure_begin();
  for (uint32_t i = 0; i < 64; ++i) {
    measure_end(&inner, measure_begin());
  }
  measure_end(&outer, begin);
  measure_own_q6 = (uint32_t)inner.ticks;
  measure_outer_q6 = (uint32_t)outer.ticks;
}
