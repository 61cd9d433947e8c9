#include "asperity_firmware/clock.h"

enum { kMemory = 30 };

uint64_t asp_clock64_extend(asp_clock64* clock, uint32_t counter) {
  if (counter < clock->last) {
    ++clock->wraps;
  }
  clock->last = counter;
  return ((uint64_t)clock->wraps << 32) | counter;
}

void asp_row_clock_init(asp_row_clock* clock, uint32_t nominal_period_ns) {
  clock->last_ns = 0;
  clock->period_q8_ns = (int64_t)nominal_period_ns * 256;
  clock->count = 0;
}

void asp_row_clock_restart(asp_row_clock* clock) { clock->count = 0; }

static asp_row_times begin_line(asp_row_clock* clock, int64_t span_ns, uint32_t rows, uint64_t edge_ns) {
  const uint64_t earliest_ns = clock->last_ns == 0 ? 0 : clock->last_ns + (uint64_t)span_ns;
  const uint64_t step_ns = (uint64_t)clock->period_q8_ns / 256u;
  clock->last_ns = edge_ns > earliest_ns ? edge_ns : earliest_ns;
  clock->count = 1;
  return (asp_row_times){clock->last_ns - (rows - 1u) * step_ns, (uint32_t)step_ns};
}

asp_row_times asp_row_clock_advance(asp_row_clock* clock, uint32_t rows, uint64_t edge_us) {
  const uint64_t edge_ns = edge_us * 1000u;
  const int64_t span_ns = clock->period_q8_ns * (int64_t)rows / 256;
  const uint64_t before_ns = clock->last_ns;
  const int64_t error_ns = (int64_t)(edge_ns - before_ns) - span_ns;
  if (clock->count == 0 || error_ns > span_ns / 4 || error_ns < -span_ns / 4) {
    return begin_line(clock, span_ns, rows, edge_ns);
  }
  // The gains of the growing-memory least-squares line (Brookner, Tracking and Kalman Filtering, 1998, §1.2.10).
  const int64_t n = clock->count;
  const int64_t weight = (n + 1) * (n + 2);
  const uint64_t advance_ns = (uint64_t)(span_ns + error_ns * 2 * (2 * n + 1) / weight);
  clock->last_ns = before_ns + advance_ns;
  clock->period_q8_ns += error_ns * 6 * 256 / (weight * (int64_t)rows);
  if (clock->count < kMemory) {
    ++clock->count;
  }
  const uint64_t step_ns = advance_ns / rows;
  return (asp_row_times){clock->last_ns - (rows - 1u) * step_ns, (uint32_t)step_ns};
}

asp_row_times asp_row_clock_coast(asp_row_clock* clock, uint32_t rows) {
  const uint64_t step_ns = (uint64_t)clock->period_q8_ns / 256u;
  clock->last_ns += rows * step_ns;
  return (asp_row_times){clock->last_ns - (rows - 1u) * step_ns, (uint32_t)step_ns};
}
