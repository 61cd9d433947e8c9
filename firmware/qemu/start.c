// From reset to main(): vectors, initialised data, painted stack.
#include <stdint.h>

#include "machine.h"
#include "semihost.h"
#include "start.h"

enum { kPaint = 0x5AA5C33C };

extern uint32_t linker_stack_top[];
extern uint32_t linker_stack_end[];
extern uint32_t linker_data_start[];
extern uint32_t linker_data_end[];
extern const uint32_t linker_data_load[];
extern uint32_t linker_bss_start[];
extern uint32_t linker_bss_end[];

int main(void);

uint32_t start_stack_used(void) {
  const uint32_t* lowest = linker_stack_end;
  while (lowest < linker_stack_top && *lowest == (uint32_t)kPaint) {
    ++lowest;
  }
  return (uint32_t)((uintptr_t)linker_stack_top - (uintptr_t)lowest);
}

uint32_t start_stack_size(void) { return (uint32_t)((uintptr_t)linker_stack_top - (uintptr_t)linker_stack_end); }

static void on_fault(void) {
  semihost_write("fault: the processor stopped\n");
  semihost_exit(1);
}

static void start(void) {
  for (uint32_t* to = linker_data_start; to < linker_data_end; ++to) {
    *to = linker_data_load[to - linker_data_start];
  }
  for (uint32_t* to = linker_bss_start; to < linker_bss_end; ++to) {
    *to = 0;
  }
  // What lies below the stack's pointer; this function's own few words are used anyway.
  uint32_t* const here = __builtin_frame_address(0);
  for (uint32_t* to = linker_stack_end; to < here - 16; ++to) {
    *to = (uint32_t)kPaint;
  }
  semihost_exit(main());
}

typedef void (*vector)(void);

__attribute__((section(".vectors"), used)) static const vector kVectors[16 + 32] = {
    [0] = (vector)(uintptr_t)linker_stack_top,
    [1] = start,
    [2] = on_fault,
    [3] = on_fault,
    [4] = on_fault,
    [5] = on_fault,
    [6] = on_fault,
    [16 ... 47] = machine_timer_handler,  // the only interrupt that is enabled
};
