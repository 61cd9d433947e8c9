#ifndef ASPERITY_FIRMWARE_PROBE_H
#define ASPERITY_FIRMWARE_PROBE_H

#include <stdbool.h>

#include "asperity_firmware/board.h"
#include "asperity_firmware/description.h"
#include "asperity_firmware/probe_state.h"

#ifdef __cplusplus
extern "C" {
#endif

// 16 rows, 10 ms, 1 s. At 4 kHz with gyroscope and 1 kHz of force: 65 kB/s of the 92 that 921,600 bps carry.
extern const asp_probe_config asp_default_config;

// Begins: index and sequence at zero, `start` set in the first sample frame. `board` is kept, `description` copied.
// `config` NULL: the defaults. False, and nothing may be done with the probe, if a figure of the configuration or the
// description is out of its range.
bool asp_probe_init(asp_probe* probe, const asp_board* board, const asp_description* description,
                    const asp_probe_config* config);

// One turn: takes what the sensors and the host have, makes the frames that are due and writes them as far as the link
// takes them. Never waits; bounded: at most a queue's length of samples and 64 bytes of the host. To be called again
// and again, more often than the queues fill. Returns whether there was anything to do.
bool asp_probe_step(asp_probe* probe);

#ifdef __cplusplus
}
#endif

#endif
