#ifndef ASPERITY_FIRMWARE_QEMU_SCENARIO_H
#define ASPERITY_FIRMWARE_QEMU_SCENARIO_H

#include "world.h"

// What goes wrong when.

typedef struct {
  world_scenario scenario;
  uint64_t began_us;
  uint32_t next;  // of the list
} scenario_state;

typedef struct {
  uint32_t stall_us;
  uint32_t damaged_bytes;
} scenario_effects;

// Called before the sensors are started.
void scenario_begin(scenario_state* state, world_scenario scenario, uint64_t now_us, asp_icm42688_model* imu);

// Puts what is due by now into the models; what concerns the loop is returned.
scenario_effects scenario_advance(scenario_state* state, uint64_t now_us, asp_icm42688_model* imu,
                                  asp_ads1220_model* force);

#endif
