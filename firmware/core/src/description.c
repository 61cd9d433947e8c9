#include "asperity_firmware/description.h"

#include "decimal.h"

typedef struct {
  uint8_t* out;
  size_t capacity;
  size_t used;
  bool bad;
} sink;

static void put(sink* s, uint8_t byte) {
  if (s->used < s->capacity) {
    s->out[s->used] = byte;
    ++s->used;
  } else {
    s->bad = true;
  }
}

static void put_text(sink* s, const char* text) {
  for (; *text != '\0'; ++text) {
    put(s, (uint8_t)*text);
  }
}

static void put_integer(sink* s, int64_t value) {
  uint8_t digits[20];
  size_t count = 0;
  if (value < 0) {
    put(s, '-');
    value = -value;
  }
  do {
    digits[count] = (uint8_t)('0' + value % 10);
    ++count;
    value /= 10;
  } while (value > 0);
  while (count > 0) {
    --count;
    put(s, digits[count]);
  }
}

// As mantissa and exponent, 208848e-3: JSON allows it, and it needs no printf.
static void put_number(sink* s, double value, double max) {
  asp_decimal number;
  if (!asp_to_decimal(value, max, &number)) {
    s->bad = true;
    return;
  }
  int64_t mantissa = (int64_t)number.digits;
  int32_t exponent = number.exponent;
  while (mantissa != 0 && mantissa % 10 == 0) {
    mantissa /= 10;
    ++exponent;
  }
  while (mantissa != 0 && exponent > 0 && exponent < 6) {
    mantissa *= 10;
    --exponent;
  }
  put_integer(s, mantissa);
  if (exponent != 0) {
    put(s, 'e');
    put_integer(s, exponent);
  }
}

// Length of the UTF-8 sequence at `text`, 0 if it is none: no overlong forms, no surrogates, nothing above
// U+10FFFF. A terminating zero ends the scan, as it is no continuation byte.
static size_t utf8_length(const uint8_t* text) {
  const uint8_t first = text[0];
  if (first < 0x80u) {
    return 1;
  }
  const size_t length = first >= 0xF0u ? 4 : first >= 0xE0u ? 3 : 2;
  if (first < 0xC2u || first > 0xF4u) {
    return 0;
  }
  for (size_t i = 1; i < length; ++i) {
    if ((text[i] & 0xC0u) != 0x80u) {
      return 0;
    }
  }
  const uint8_t second = text[1];
  if ((first == 0xE0u && second < 0xA0u) || (first == 0xEDu && second > 0x9Fu) || (first == 0xF0u && second < 0x90u) ||
      (first == 0xF4u && second > 0x8Fu)) {
    return 0;
  }
  return length;
}

static void put_string(sink* s, const char* text) {
  static const char kHex[] = "0123456789abcdef";
  const uint8_t* bytes = (const uint8_t*)text;
  size_t taken = 0;
  put(s, '"');
  while (bytes != NULL && bytes[taken] != 0) {
    const size_t length = utf8_length(bytes + taken);
    if (length == 0 || taken + length > ASP_TEXT_MAX) {
      s->bad = true;
      return;
    }
    const uint8_t first = bytes[taken];
    if (first < 0x20u || first == 0x7Fu) {
      put_text(s, "\\u00");
      put(s, (uint8_t)kHex[first >> 4]);
      put(s, (uint8_t)kHex[first & 15u]);
    } else {
      if (first == '"' || first == '\\') {
        put(s, '\\');
      }
      for (size_t i = 0; i < length; ++i) {
        put(s, bytes[taken + i]);
      }
    }
    taken += length;
  }
  put(s, '"');
}

size_t asp_write_description(const asp_description* d, uint8_t* out, size_t capacity) {
  const double max_rate_hz = 1e5;
  const double max_scale = 1e12;
  sink s = {out, capacity < ASP_DESCRIPTION_MAX ? capacity : ASP_DESCRIPTION_MAX, 0, false};
  put_text(&s, "{\"model\":\"open\",\"name\":");
  put_string(&s, d->name);
  put_text(&s, ",\"firmware\":");
  put_string(&s, d->firmware);
  put_text(&s, ",\"rate_hz\":");
  put_number(&s, d->rate_hz, max_rate_hz);
  put_text(&s, ",\"adc_min\":");
  put_integer(&s, d->adc_min);
  put_text(&s, ",\"adc_max\":");
  put_integer(&s, d->adc_max);
  put_text(&s, ",\"accel_counts_per_mps2\":");
  put_number(&s, d->accel_counts_per_mps2, max_scale);
  if (d->has_gyro) {
    put_text(&s, ",\"gyro_counts_per_radps\":");
    put_number(&s, d->gyro_counts_per_radps, max_scale);
  }
  put_text(&s, ",\"force_axes\":");
  put_integer(&s, d->force_axes);
  put_text(&s, ",\"force_rate_hz\":");
  put_number(&s, d->force_rate_hz, max_rate_hz);
  put_text(&s, ",\"force_newton_per_count\":");
  put_number(&s, d->force_newton_per_count, max_scale);
  put(&s, '}');
  const bool sound = !s.bad && (d->force_axes == 1 || d->force_axes == 3) && d->adc_min < d->adc_max;
  return sound ? s.used : 0;
}
