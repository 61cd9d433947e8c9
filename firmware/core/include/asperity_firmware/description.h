#ifndef ASPERITY_FIRMWARE_DESCRIPTION_H
#define ASPERITY_FIRMWARE_DESCRIPTION_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define ASP_DESCRIPTION_MAX 1024u  // bytes of JSON
#define ASP_TEXT_MAX 64u           // bytes of a text, before it is escaped

// What a probe says of itself. Figures are nominal: the calibration rules.
typedef struct {
  const char* name;      // of this very probe, UTF-8
  const char* firmware;  // its version
  double rate_hz;        // of the inertial sensor
  int32_t adc_min;       // of the inertial sensor, counts
  int32_t adc_max;
  double accel_counts_per_mps2;
  bool has_gyro;
  double gyro_counts_per_radps;  // with has_gyro
  int force_axes;                // 1 or 3
  double force_rate_hz;
  double force_newton_per_count;
} asp_description;

// Writes the JSON object of docs/probe-protocol.md into `out`, nine digits a figure, without a terminating
// zero. Returns its bytes; 0 if a text is longer than 64 bytes or not UTF-8, a figure is out of the document's
// range, or it would not fit.
size_t asp_write_description(const asp_description* description, uint8_t* out, size_t capacity);

#ifdef __cplusplus
}
#endif

#endif
