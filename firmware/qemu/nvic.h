#ifndef ASPERITY_FIRMWARE_QEMU_NVIC_H
#define ASPERITY_FIRMWARE_QEMU_NVIC_H

#include "registers.h"

// The interrupt controller of every Cortex-M; interrupts 0 to 31.
static inline void nvic_enable(uint32_t interrupt) { write_word(0xE000E100u, 1u << interrupt); }
static inline void nvic_set_pending(uint32_t interrupt) { write_word(0xE000E200u, 1u << interrupt); }

#endif
