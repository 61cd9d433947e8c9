#ifndef ASPERITY_FIRMWARE_CLOCK_H
#define ASPERITY_FIRMWARE_CLOCK_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// Makes a clock that never steps out of a 32-bit counter that wraps. Start with zeros.
typedef struct {
  uint32_t last;
  uint32_t wraps;
} asp_clock64;

// To be called at least once a wrap: every 71 minutes of a counter of µs.
uint64_t asp_clock64_extend(asp_clock64* clock, uint32_t counter);

// Says when each row of a sensor with a clock of its own was taken, from the times, on the board's clock, at which
// every few rows an interrupt came: a straight line through these, with a memory that grows to 31 interrupts and then
// forgets the oldest. The interrupts' jitter is averaged away and the rows are evenly spaced.
typedef struct {
  uint64_t last_ns;      // of the newest row
  int64_t period_q8_ns;  // between two rows, in 1/256 ns
  uint32_t count;        // of interrupts in memory
} asp_row_clock;

void asp_row_clock_init(asp_row_clock* clock, uint32_t nominal_period_ns);

typedef struct {
  uint64_t first_ns;  // of the first of these rows
  uint32_t step_ns;   // from one to the next
} asp_row_times;

// `rows`, at least one, more were taken, and the interrupt at `edge_us` came with the last. Times rise over all
// rows. An edge that is off the line by more than a quarter of what it has to predict begins a new line.
asp_row_times asp_row_clock_advance(asp_row_clock* clock, uint32_t rows, uint64_t edge_us);

// The same where no interrupt was seen: the rows go on along the line, which must have begun (count > 0).
asp_row_times asp_row_clock_coast(asp_row_clock* clock, uint32_t rows);

// Forgets where the line was, but not its slope: rows were lost, how many is not known. The next advance begins anew.
void asp_row_clock_restart(asp_row_clock* clock);

#ifdef __cplusplus
}
#endif

#endif
