#ifndef ASPERITY_FIRMWARE_PROBE_INTERNAL_H
#define ASPERITY_FIRMWARE_PROBE_INTERNAL_H

#include "asperity_firmware/probe.h"

static inline const asp_queued_row* asp_row_at(const asp_probe* probe, uint32_t i) {
  return &probe->rows[(probe->rows_taken + i) % ASP_ROW_QUEUE];
}

static inline const asp_force_sample* asp_force_at(const asp_probe* probe, uint32_t i) {
  return &probe->forces[(probe->forces_taken + i) % ASP_FORCE_QUEUE];
}

// Puts the sample frame that is due at `now_us` into probe->line; false if none is.
bool asp_make_sample_frame(asp_probe* probe, uint64_t now_us);

// Puts the description into probe->line.
void asp_make_description_frame(asp_probe* probe);

#endif
