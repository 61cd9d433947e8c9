#ifndef ASPERITY_FIRMWARE_FAULTS_FRAME_H
#define ASPERITY_FIRMWARE_FAULTS_FRAME_H

#include "asperity_firmware/probe_state.h"

// Puts a frame of faults on the line if one is due: a value has changed since the last one, or there are faults and
// that was a description's period ago. Asks the board ten times a second at most. False if none is due.
bool asp_make_faults_frame(asp_probe* probe, uint64_t now_us);

#endif
