#ifndef ASPERITY_FIRMWARE_QEMU_START_H
#define ASPERITY_FIRMWARE_QEMU_START_H

#include <stdint.h>

// Bytes of the stack that have ever been written to, and those that there are.
uint32_t start_stack_used(void);
uint32_t start_stack_size(void);

#endif
