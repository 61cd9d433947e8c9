#ifndef ASPERITY_FIRMWARE_QEMU_REGISTERS_H
#define ASPERITY_FIRMWARE_QEMU_REGISTERS_H

#include <stdint.h>

static inline void write_word(uintptr_t address, uint32_t value) { *(volatile uint32_t*)address = value; }
static inline uint32_t read_word(uintptr_t address) { return *(volatile uint32_t*)address; }

#endif
