#include "semihost.h"

enum { kWrite0 = 0x04, kArguments = 0x15, kExitExtended = 0x20, kApplicationExit = 0x20026 };

static intptr_t call(uint32_t operation, const void* parameter) {
  register intptr_t r0 __asm("r0") = (intptr_t)operation;
  register const void* r1 __asm("r1") = parameter;
  __asm volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
  return r0;
}

void semihost_write(const char* text) { call(kWrite0, text); }

void semihost_write_number(const char* name, uint64_t value) {
  char digits[22];
  size_t at = sizeof digits - 1;
  digits[at] = '\0';
  digits[--at] = '\n';
  do {
    digits[--at] = (char)('0' + value % 10u);
    value /= 10u;
  } while (value > 0);
  semihost_write(name);
  semihost_write("=");
  semihost_write(digits + at);
}

void semihost_exit(int code) {
  const uintptr_t parameters[2] = {kApplicationExit, (uintptr_t)code};
  call(kExitExtended, parameters);
  for (;;) {
  }
}

void semihost_arguments(char* text, size_t capacity) {
  uintptr_t parameters[2] = {(uintptr_t)text, capacity};
  if (call(kArguments, parameters) != 0) {
    text[0] = '\0';
  }
}
