#ifndef ASPERITY_FIRMWARE_DECIMAL_H
#define ASPERITY_FIRMWARE_DECIMAL_H

#include <stdbool.h>
#include <stdint.h>

// digits · 10^exponent
typedef struct {
  uint64_t digits;
  int32_t exponent;
} asp_decimal;

// `value` to nine digits, by integers alone: a processor without double arithmetic would need 7 kB of library for it.
// False if it is not between 0 and `max`, which is finite.
bool asp_to_decimal(double value, double max, asp_decimal* out);

#endif
