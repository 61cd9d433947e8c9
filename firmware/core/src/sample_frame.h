#ifndef ASPERITY_FIRMWARE_SAMPLE_FRAME_H
#define ASPERITY_FIRMWARE_SAMPLE_FRAME_H

#include "asperity_firmware/probe_state.h"

// Puts the sample frame that is due at `now_us` into probe->line; false if none is.
bool asp_make_sample_frame(asp_probe* probe, uint64_t now_us);

// Puts the description into probe->line.
void asp_make_description_frame(asp_probe* probe);

#endif
