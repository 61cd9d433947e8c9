#ifndef ASPERITY_FIRMWARE_QEMU_SEMIHOST_H
#define ASPERITY_FIRMWARE_QEMU_SEMIHOST_H

#include <stddef.h>
#include <stdint.h>

// Calls of the emulator's host (Arm's semihosting).
void semihost_write(const char* text);
void semihost_write_number(const char* name, uint64_t value);  // "name=value" and a line's end
void semihost_exit(int code) __attribute__((noreturn));

// The program's arguments, separated by spaces; empty if they do not fit.
void semihost_arguments(char* text, size_t capacity);

#endif
