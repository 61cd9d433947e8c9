#include "decimal.h"

#include <string.h>

enum { kFractionBits = 52, kBias = 1075 };

static uint64_t bits_of(double value) {
  uint64_t bits = 0;
  memcpy(&bits, &value, sizeof bits);
  return bits;
}

// Brings mantissa · 2^exponent2 to a power of ten. The mantissa keeps 60 bits: each of at most 1100 steps rounds by
// less than 2^-60 of it.
static asp_decimal without_powers_of_two(uint64_t mantissa, int32_t exponent2) {
  asp_decimal out = {mantissa, 0};
  for (; exponent2 < 0; ++exponent2) {
    if (out.digits < UINT64_C(1) << 61) {
      out.digits *= 5u;
      --out.exponent;
    } else {
      out.digits = (out.digits + 1u) >> 1;
    }
  }
  while (exponent2 > 0) {
    if (out.digits < UINT64_C(1) << 62) {
      out.digits <<= 1;
      --exponent2;
    } else {
      out.digits = (out.digits + 5u) / 10u;
      ++out.exponent;
    }
  }
  return out;
}

static asp_decimal to_nine_digits(asp_decimal number) {
  while (number.digits >= UINT64_C(10000000000)) {
    number.digits /= 10u;
    ++number.exponent;
  }
  if (number.digits >= 1000000000u) {
    number.digits = (number.digits + 5u) / 10u;
    ++number.exponent;
  }
  return number;
}

// Numbers that are not negative are in the order of their bits; infinity and what is no number come after all of them.
bool asp_to_decimal(double value, double max, asp_decimal* out) {
  const uint64_t sign = UINT64_C(1) << 63;
  const uint64_t bits = bits_of(value) == sign ? 0 : bits_of(value);
  *out = (asp_decimal){0, 0};
  if (bits > bits_of(max)) {
    return false;
  }
  const uint32_t field = (uint32_t)(bits >> kFractionBits);
  const uint64_t fraction = bits & ((UINT64_C(1) << kFractionBits) - 1u);
  const uint64_t mantissa = field == 0 ? fraction : fraction | UINT64_C(1) << kFractionBits;
  if (mantissa != 0) {
    *out = to_nine_digits(without_powers_of_two(mantissa, (int32_t)(field == 0 ? 1u : field) - kBias));
  }
  return true;
}
